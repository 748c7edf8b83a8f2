#include "senders/paper_lines.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "base/random.h"
#include "senders/paper_vertex.h"

namespace radfarm {
namespace {

/// The first surfaces between two points.
struct Line {
  bool is_hidden = false;
  float receiver = 0, occluder = 0;  // distances of the receiver's surface and of what hides it
};

/// The paper's rule for a line from a point in free space: its first hit may be the receiver itself, and the second its back
/// side where it is closed; what is met after that hides it. From a surface the first hit does. (paper.2)
Line follow(const VertexContext& context, const ReceiverPoint& from, const Vec3& to, std::uint64_t key) {
  const Vec3 way = normalize(to - from.position);
  const float length_of_line = length(to - from.position);
  const bool is_free = from.normal == Vec3(0, 0, 0);
  Line line;
  Vec3 origin = from.position;
  std::uint32_t allowed = 0;
  for (std::uint32_t hits = 0; hits < 3; ++hits) {
    const float gone = dot(origin - from.position, way);
    const auto hit = context.world.caster.closest({origin, way}, combine(key, hits), length_of_line - gone);
    if (!hit) return line;
    if (is_free && hits == 0) line.receiver = hit->distance, allowed = context.paper->closed.is_closed(*hit) ? 2 : 1;
    line.occluder = gone + hit->distance;
    line.is_hidden = hits >= allowed;
    if (line.is_hidden) return line;
    origin = leave(context.world.surfaces.at(*hit), way);
  }
  return line;
}

/// Sums over the lines to one sender.
struct Sums {
  double kernel = 0, passed = 0, penumbra = 0;
  std::uint32_t hidden = 0;
  Vec3d vector{0, 0, 0};  // of k, without the receiver's cosine
};

/// One line: its kernel with the receiver's cosine, where that has one.
float add_line(const VertexContext& context, const ReceiverPoint& x, const SenderSample& y, float width, std::uint64_t key,
               Sums& sums) {
  const Vec3 offset = y.position - x.position;
  const float squared = dot(offset, offset);
  if (!(squared > 0)) return 0;
  const float cosine_y = std::max(0.0F, -dot(y.normal, offset));  // times the distance
  const float plain = std::min(cosine_y / (kPi * squared * std::sqrt(squared)), 2 / context.tree.patches[y.patch].area);
  const Vec3 way = normalize(offset);
  const float k = x.normal == Vec3(0, 0, 0) ? plain : plain * std::max(0.0F, dot(x.normal, way));
  if (!(k > 0)) return 0;
  sums.kernel += static_cast<double>(k);
  sums.vector += to_double(way) * static_cast<double>(plain);
  const Line line = follow(context, x, y.leave(), key);
  if (!line.is_hidden) {
    sums.passed += static_cast<double>(k);
    return k;
  }
  const float to_sender = std::max(std::sqrt(squared) - line.occluder, 1e-6F * std::sqrt(squared));
  sums.penumbra += static_cast<double>(width * (line.occluder - line.receiver) / to_sender);
  ++sums.hidden;
  return k;
}

}  // namespace

Observation observe(const VertexContext& context, const Surroundings& around, std::uint32_t sender, std::uint32_t samples,
                    std::uint64_t key) {
  const SenderNode& node = context.tree.nodes[sender];
  const float width = length(node.bounds.size());
  Observation seen;
  seen.kernel_min = std::numeric_limits<float>::infinity();
  Sums sums;
  for (std::uint32_t i = 0; i < samples; ++i) {
    const ReceiverPoint x = random_receiver(context, around, combine(key, i));
    const float k = add_line(context, x, fixed_sample(context.tree, sender, i), width, combine(key, i, 1), sums);
    seen.kernel_min = std::min(seen.kernel_min, k), seen.kernel_max = std::max(seen.kernel_max, k);
  }
  if (!(sums.kernel > 0)) return {};
  const float most = node.max_radiosity / node.power;
  seen.kernel = std::min(static_cast<float>(sums.kernel / samples), most);
  seen.strength = around.is_on_surface() ? std::min(static_cast<float>(length(sums.vector) / samples), most) : seen.kernel;
  seen.visibility = static_cast<float>(sums.passed / sums.kernel);
  seen.penumbra = sums.hidden > 0 ? static_cast<float>(sums.penumbra / sums.hidden) : 0;
  seen.direction = to_float(normalize(sums.vector));
  return seen;
}

}  // namespace radfarm
