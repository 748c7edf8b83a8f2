#include "senders/reflector_lookup.h"

#include <algorithm>
#include <cmath>
#include <numeric>

#include "radiosity/hierarchy.h"

namespace radfarm {
namespace {

constexpr std::uint32_t kDepth = 15;  // levels of a quadtree over a triangle that a code tells apart

/// Barycentric coordinates of a position in a triangle's plane, of vertices 1 and 2.
std::pair<double, double> weights_in(const TriangleVertices& v, const Vec3& position) {
  const Vec3d e1 = to_double(v[1]) - to_double(v[0]), e2 = to_double(v[2]) - to_double(v[0]);
  const Vec3d d = to_double(position) - to_double(v[0]), normal = cross(e1, e2);
  const double area = dot(normal, normal);
  return {dot(cross(d, e2), normal) / area, dot(cross(e1, d), normal) / area};
}

/// The path down the quadtree to a point: two bits a level, the first level's highest.
std::uint32_t code_of(const TriangleVertices& whole, const Vec3& position) {
  auto [b, c] = weights_in(whole, position);
  std::uint32_t code = 0;
  for (std::uint32_t level = 0; level < kDepth; ++level) {
    const PartPoint part = enter_part(b, c);
    code = code << 2 | part.part;
    b = part.b, c = part.c;
  }
  return code;
}

/// How many codes lie in a part: a quarter of the whole's at each level.
std::uint32_t codes_of_part(const TriangleVertices& whole, const TriangleVertices& part) {
  const float levels = std::round(std::log2(area_of(whole) / area_of(part)) / 2);
  return 1U << 2 * (kDepth - static_cast<std::uint32_t>(std::clamp(levels, 0.0F, static_cast<float>(kDepth))));
}

}  // namespace

ReflectorLookup::ReflectorLookup(const World& world, const SenderTree& tree) : world_(&world), tree_(&tree), sides_(world.scene) {
  places_.reserve(tree.reflectors.size());
  for (std::uint32_t i = 0; i < tree.reflectors.size(); ++i) {
    const Reflector& r = tree.reflectors[i];
    const TriangleVertices whole = world.surfaces.triangle(r.instance, r.triangle);
    const std::uint32_t codes = codes_of_part(whole, r.vertices);
    const Vec3 middle = (r.vertices[0] + r.vertices[1] + r.vertices[2]) / 3.0F;
    const std::uint32_t first = codes == kAllCodes ? 0 : code_of(whole, middle) & ~(codes - 1);
    places_.push_back({sides_.of(r.instance, r.triangle, r.is_front != 0), first, codes, i});
  }
  std::sort(places_.begin(), places_.end(), [](const Place& a, const Place& b) {
    return a.side != b.side ? a.side < b.side : a.first_code < b.first_code;
  });
}

std::uint32_t ReflectorLookup::find(const Hit& hit, const SurfacePoint& point) const {
  const std::uint32_t side = sides_.of(hit.instance, hit.triangle, point.is_front);
  const auto before = [](const Place& place, std::uint32_t wanted) { return place.side < wanted; };
  auto at = std::lower_bound(places_.begin(), places_.end(), side, before);
  if (at == places_.end() || at->side != side) return kNone;
  if (at->codes == kAllCodes) return at->reflector;
  const std::uint32_t code = code_of(world_->surfaces.triangle(hit.instance, hit.triangle), point.position);
  const auto end = std::lower_bound(at, places_.end(), side + 1, before);
  at = std::upper_bound(at, end, code, [](std::uint32_t wanted, const Place& place) { return wanted < place.first_code; });
  --at;  // the one before may be another side's, or another part's: then nothing is sent from here
  return at->side == side && code - at->first_code < at->codes ? at->reflector : kNone;
}

}  // namespace radfarm
