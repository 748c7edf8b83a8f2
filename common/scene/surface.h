#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include "math/spectrum.h"
#include "math/vec.h"
#include "matter/bsdf.h"
#include "scene/camera.h"
#include "scene/footprint.h"
#include "scene/scene.h"
#include "scene/texture_pyramid.h"

namespace radfarm {

/// Where a ray met the scene: a point of one triangle of one instance. (u, v) are the weights of its vertices 1 and 2.
struct Hit {
  std::uint32_t instance = kNone;
  std::uint32_t triangle = kNone;
  float u = 0;
  float v = 0;
  float distance = 0;  // along the ray, in lengths of its direction
  Spectrum weight{1.0F};  // of the ray where it ends: its colour after panes, over the probability that it came so far
};

/// What the integrators need to know of a surface point. All normals are unit and agree in their hemisphere.
struct SurfacePoint {
  Vec3 position;
  Vec3 geometric_normal;  // towards the front side, until face() turns it
  Vec3 shading_normal;
  Vec3 tangent{0, 0, 0};  // unit, along u of the normal map; the zero vector where no material asks for it
  float offset = 0;       // how far off the surface a ray must start to miss the triangle it leaves, m
  std::uint32_t material = 0;
  bool is_front = true;   // face(): the side looked at is the front
  std::array<Vec2, 2> uv{Vec2(0, 0), Vec2(0, 0)};
  std::array<float, 4> color{1, 1, 1, 1};
  RayCone cone = {};                          // of the ray that met it, here
  std::array<UvFootprint, 2> footprint = {};  // what look-ups stand for, by UV set; left out where nothing is textured
};

using TriangleVertices = std::array<Vec3, 3>;

/// The scene's triangles in world space, with what Scene leaves to be derived. Borrows the scene, which must outlive it.
/// Every float that the ray caster sees comes from here, so all stages agree on where a surface is. Thread-safe.
class Surfaces {
 public:
  explicit Surfaces(const Scene& scene);

  const Scene& scene() const { return *scene_; }
  /// Counter-clockwise seen from the front; O(1).
  TriangleVertices triangle(std::uint32_t instance, std::uint32_t triangle) const;
  /// All the geometry at a hit. About 50 ns.
  SurfacePoint at(const Hit& hit) const;
  /// The same with the footprint of the ray's cone, turned towards where the ray comes from: face()d.
  SurfacePoint met(const Hit& hit, const Ray& ray) const;
  /// The same with the footprint of a part of the triangle: its edges, `share` as long.
  SurfacePoint at_part(const Hit& hit, float share) const;
  /// The hit that lies at a position of the triangle's plane; clamped to the triangle.
  Hit hit_at(std::uint32_t instance, std::uint32_t triangle, const Vec3& position) const;
  /// The material there, textures and vertex colours included. Over the point's footprint go what light is proportional to:
  /// base colour, the layers' weights and colours, emission. What shapes a lobe or decides by chance is the point's own
  /// (docs/materials.md).
  Matter matter(const SurfacePoint& point) const;
  /// What a volume leaves of a ray that went `distance` through it to its inner side at `point`; 1 elsewhere. Requires: face()d.
  Spectrum absorption(const SurfacePoint& point, float distance) const;
  /// What the surface reflects of light from all around evenly, [0, 1], with gloss where it is folded: rho of radiosity.
  Spectrum reflectance(const SurfacePoint& point) const;
  /// The same of light at a cosine to the normal.
  Spectrum reflectance(const SurfacePoint& point, float cosine) const;
  /// Radiance emitted from the side that `point` shows, cd/m^2; black from the back of a single-sided emitter.
  Spectrum emission(const SurfacePoint& point) const;
  /// The share of light that the surface stops at a hit, in [0, 1] (DESIGN 7: alpha is coverage).
  float coverage(const Hit& hit) const;
  /// What goes straight on at a hit of a ray in unit `direction`: through holes, and through panes by colour.
  Spectrum passage(const Hit& hit, const Vec3& direction) const;
  /// Whether passage() can be above 0 anywhere on the mesh: it has holes or is a pane.
  bool lets_through(std::uint32_t mesh) const { return mesh_lets_through_[mesh]; }
  bool is_pane(std::uint32_t mesh) const { return mesh_is_pane_[mesh]; }
  /// Whether the instance's transform turns left into right.
  bool is_mirrored(std::uint32_t instance) const { return placements_[instance].is_mirrored; }

 private:
  void bend(const Hit& hit, const TriangleVertices& p, SurfacePoint& point) const;

  SurfacePoint place(const Hit& hit, const Ray* ray) const;
  Vec4 look_up_footprint(const TextureUse& use, const SurfacePoint& point) const;

  struct Placement {
    Matrix4 normal_to_world;  // inverse transpose
    bool is_mirrored = false;
  };
  const Scene* scene_;
  std::vector<Placement> placements_;
  std::vector<bool> mesh_lets_through_;
  std::vector<bool> mesh_is_pane_;
  std::vector<TexturePyramid> pyramids_;  // one a texture; empty where none is looked up by footprint
  std::vector<bool> mesh_has_pyramid_;
};

/// Turns both normals towards `to_viewer` and records which side that is.
void face(SurfacePoint& point, const Vec3& to_viewer);

/// How the surface scatters the light that reaches the viewer in unit direction `to_viewer`. Requires: face()d there. Where gloss
/// would show the viewer what lies below the surface, the point's shading normal is turned until it does not.
Bsdf bsdf_at(const Surfaces& surfaces, SurfacePoint& point, const Vec3& to_viewer);

/// The start of a ray that leaves the surface on the side its geometric normal shows.
inline Vec3 leave(const SurfacePoint& point) { return point.position + point.geometric_normal * point.offset; }

/// The same on the side that `direction` points to.
inline Vec3 leave(const SurfacePoint& point, const Vec3& direction) {
  const float side = dot(direction, point.geometric_normal) < 0 ? -point.offset : point.offset;
  return point.position + point.geometric_normal * side;
}

}  // namespace radfarm
