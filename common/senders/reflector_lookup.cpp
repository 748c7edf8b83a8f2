#include "senders/reflector_lookup.h"

#include <algorithm>
#include <numeric>

namespace radfarm {
namespace {

/// How far inside a point of its plane lies: the least of its three weights, below 0 outside.
double depth_inside(const TriangleVertices& v, const Vec3& position) {
  const Vec3d e1 = to_double(v[1]) - to_double(v[0]), e2 = to_double(v[2]) - to_double(v[0]);
  const Vec3d d = to_double(position) - to_double(v[0]), normal = cross(e1, e2);
  const double area = dot(normal, normal);
  const double b = dot(cross(d, e2), normal) / area, c = dot(cross(e1, d), normal) / area;
  return std::min({b, c, 1 - b - c});
}

}  // namespace

ReflectorLookup::ReflectorLookup(const World& world, const SenderTree& tree) : tree_(&tree) {
  std::uint64_t triangles = 0;
  for (const Instance& instance : world.scene.instances) {
    first_triangle_.push_back(triangles);
    triangles += world.scene.meshes[instance.mesh].triangles.size();
  }
  const auto key = [&](std::uint32_t i) {
    const Reflector& patch = tree.reflectors[i];
    return key_of(patch.instance, patch.triangle, patch.is_front != 0);
  };
  order_.resize(tree.reflectors.size());
  std::iota(order_.begin(), order_.end(), 0U);
  std::stable_sort(order_.begin(), order_.end(), [&](auto a, auto b) { return key(a) < key(b); });
  for (const std::uint32_t i : order_) keys_.push_back(key(i));
}

std::uint64_t ReflectorLookup::key_of(std::uint32_t instance, std::uint32_t triangle, bool is_front) const {
  return 2 * (first_triangle_[instance] + triangle) + (is_front ? 0 : 1);
}

std::uint32_t ReflectorLookup::find(const Hit& hit, const SurfacePoint& point) const {
  const auto [begin, end] =
      std::equal_range(keys_.begin(), keys_.end(), key_of(hit.instance, hit.triangle, point.is_front));
  if (begin == end) return kNone;
  const auto first = static_cast<std::size_t>(begin - keys_.begin()), count = static_cast<std::size_t>(end - begin);
  // Parts of one patch; those that send nothing are not here. A point on a shared edge belongs to the first.
  std::uint32_t best = kNone;
  double deepest = -1e-4;  // of a weight: rounding at the edges
  for (std::size_t i = first; i < first + count; ++i) {
    const double depth = depth_inside(tree_->reflectors[order_[i]].vertices, point.position);
    if (depth > deepest) deepest = depth, best = order_[i];
  }
  return best;
}

}  // namespace radfarm
