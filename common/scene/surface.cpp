#include "scene/surface.h"

#include <algorithm>
#include <cmath>

#include "scene/texture.h"

namespace radfarm {
namespace {

// Embree's triangle test and the transforms before it err by a few ulps of the largest vertex coordinate; 64 ulps (2^-18)
// covers them with room, and scales with the scene: no absolute length enters.
constexpr float kOffsetUlps = 64 * 0x1p-24F;

Vec3 transform_point(const Vec3& p, const Matrix4& m) {
  return {p.x * m[0][0] + p.y * m[1][0] + p.z * m[2][0] + m[3][0],
          p.x * m[0][1] + p.y * m[1][1] + p.z * m[2][1] + m[3][1],
          p.x * m[0][2] + p.y * m[1][2] + p.z * m[2][2] + m[3][2]};
}

template <typename T>
T interpolate(const std::vector<T>& values, const std::array<std::uint32_t, 3>& index, float u, float v) {
  return values[index[0]] * (1 - u - v) + values[index[1]] * u + values[index[2]] * v;
}

bool texture_has_alpha(const Texture& texture) {
  return std::any_of(texture.texels.begin(), texture.texels.end(), [](const auto& t) { return t[3] < 255; });
}

bool compute_has_holes(const Scene& scene, const Mesh& mesh) {
  const Material& material = scene.materials[mesh.material];
  if (material.alpha_mode == Material::Alpha::kOpaque) return false;
  const bool vertex_alpha = std::any_of(mesh.colors.begin(), mesh.colors.end(), [](const auto& c) { return c[3] < 1; });
  return material.alpha < 1 || vertex_alpha ||
         (material.reflectance_texture != kNone && texture_has_alpha(scene.textures[material.reflectance_texture]));
}

}  // namespace

Surfaces::Surfaces(const Scene& scene) : scene_(&scene) {
  for (const Instance& instance : scene.instances) {
    const Matrix4d inverse = Matrix4d(instance.to_world).inverse();
    const Matrix4d& to_world = Matrix4d(instance.to_world);
    Matrix4 normals;
    for (int row = 0; row < 3; ++row) {
      for (int column = 0; column < 3; ++column) normals[row][column] = static_cast<float>(inverse[column][row]);
    }
    const Vec3d x(to_world[0][0], to_world[0][1], to_world[0][2]), y(to_world[1][0], to_world[1][1], to_world[1][2]),
        z(to_world[2][0], to_world[2][1], to_world[2][2]);
    placements_.push_back({normals, dot(cross(x, y), z) < 0});
  }
  for (const Mesh& mesh : scene.meshes) mesh_has_holes_.push_back(compute_has_holes(scene, mesh));
}

TriangleVertices Surfaces::triangle(std::uint32_t instance, std::uint32_t triangle) const {
  const Instance& placed = scene_->instances[instance];
  const Mesh& mesh = scene_->meshes[placed.mesh];
  const auto& index = mesh.triangles[triangle];
  TriangleVertices vertices = {transform_point(mesh.positions[index[0]], placed.to_world),
                               transform_point(mesh.positions[index[1]], placed.to_world),
                               transform_point(mesh.positions[index[2]], placed.to_world)};
  if (placements_[instance].is_mirrored) std::swap(vertices[1], vertices[2]);
  return vertices;
}

Hit Surfaces::hit_at(std::uint32_t instance, std::uint32_t triangle, const Vec3& position) const {
  const TriangleVertices whole = this->triangle(instance, triangle);
  const Vec3d e1 = to_double(whole[1]) - to_double(whole[0]), e2 = to_double(whole[2]) - to_double(whole[0]);
  const Vec3d d = to_double(position) - to_double(whole[0]), normal = cross(e1, e2);
  const double area = dot(normal, normal);
  double b = std::max(0.0, dot(cross(d, e2), normal) / area), c = std::max(0.0, dot(cross(e1, d), normal) / area);
  const double sum = b + c;
  if (sum > 1) b /= sum, c /= sum;
  const auto u = static_cast<float>(b), v = static_cast<float>(c);
  return is_mirrored(instance) ? Hit{instance, triangle, v, u, 0} : Hit{instance, triangle, u, v, 0};
}

SurfacePoint Surfaces::at(const Hit& hit) const {
  const Instance& placed = scene_->instances[hit.instance];
  const Placement& placement = placements_[hit.instance];
  const Mesh& mesh = scene_->meshes[placed.mesh];
  const auto& index = mesh.triangles[hit.triangle];
  const Vec3 p0 = transform_point(mesh.positions[index[0]], placed.to_world);
  const Vec3 p1 = transform_point(mesh.positions[index[1]], placed.to_world);
  const Vec3 p2 = transform_point(mesh.positions[index[2]], placed.to_world);

  SurfacePoint point;
  point.position = p0 * (1 - hit.u - hit.v) + p1 * hit.u + p2 * hit.v;
  const Vec3 normal = cross(p1 - p0, p2 - p0);
  // Tiny triangles can have an area below the smallest float square: normalise in double.
  point.geometric_normal = to_float(normalize(to_double(placement.is_mirrored ? -normal : normal)));
  point.offset = kOffsetUlps * std::max({max_abs_component(p0), max_abs_component(p1), max_abs_component(p2)});
  point.material = mesh.material;
  point.shading_normal = point.geometric_normal;
  if (!mesh.normals.empty()) {
    Vec3 shading;
    placement.normal_to_world.multDirMatrix(interpolate(mesh.normals, index, hit.u, hit.v), shading);
    shading = normalize(shading);
    // A file's normals may point to either side; the triangle's winding decides which side is the front.
    if (dot(shading, point.geometric_normal) < 0) shading = -shading;
    if (dot(shading, point.geometric_normal) > 0) point.shading_normal = shading;
  }
  for (std::size_t set = 0; set < 2; ++set) {
    if (!mesh.uv[set].empty()) point.uv[set] = interpolate(mesh.uv[set], index, hit.u, hit.v);
  }
  if (!mesh.colors.empty()) {
    for (std::size_t k = 0; k < 4; ++k) {
      point.color[k] = mesh.colors[index[0]][k] * (1 - hit.u - hit.v) + mesh.colors[index[1]][k] * hit.u +
                       mesh.colors[index[2]][k] * hit.v;
    }
  }
  return point;
}

Spectrum Surfaces::reflectance(const SurfacePoint& point) const {
  const Material& material = scene_->materials[point.material];
  Spectrum rho = material.reflectance * Spectrum(point.color[0], point.color[1], point.color[2]);
  if (material.reflectance_texture != kNone) {
    const Vec4 texel = texture_lookup(scene_->textures[material.reflectance_texture], point.uv[material.reflectance_uv]);
    rho *= Spectrum(texel.x, texel.y, texel.z);
  }
  return rho;
}

Spectrum Surfaces::emission(const SurfacePoint& point) const {
  const Material& material = scene_->materials[point.material];
  if (is_black(material.emission) || !(point.is_front || material.emits_from_both_sides)) return {};
  if (material.emission_texture == kNone) return material.emission;
  const Vec4 texel = texture_lookup(scene_->textures[material.emission_texture], point.uv[material.emission_uv]);
  return material.emission * Spectrum(texel.x, texel.y, texel.z);
}

float Surfaces::coverage(const Hit& hit) const {
  const Mesh& mesh = scene_->meshes[scene_->instances[hit.instance].mesh];
  const Material& material = scene_->materials[mesh.material];
  if (material.alpha_mode == Material::Alpha::kOpaque) return 1;
  const auto& index = mesh.triangles[hit.triangle];
  float alpha = material.alpha;
  if (!mesh.colors.empty()) {
    alpha *= mesh.colors[index[0]][3] * (1 - hit.u - hit.v) + mesh.colors[index[1]][3] * hit.u +
             mesh.colors[index[2]][3] * hit.v;
  }
  if (material.reflectance_texture != kNone && !mesh.uv[material.reflectance_uv].empty()) {
    const Vec2 uv = interpolate(mesh.uv[material.reflectance_uv], index, hit.u, hit.v);
    alpha *= texture_lookup(scene_->textures[material.reflectance_texture], uv).w;
  }
  if (material.alpha_mode == Material::Alpha::kMask) return alpha >= material.alpha_cutoff ? 1.0F : 0.0F;
  return std::clamp(alpha, 0.0F, 1.0F);
}

void face(SurfacePoint& point, const Vec3& to_viewer) {
  if (dot(point.geometric_normal, to_viewer) >= 0) return;
  point.geometric_normal = -point.geometric_normal;
  point.shading_normal = -point.shading_normal;
  point.is_front = !point.is_front;
}

}  // namespace radfarm
