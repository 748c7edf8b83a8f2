#include "scene/validate.h"

#include <algorithm>
#include <cmath>
#include <string>

#include "scene/limits.h"
#include "scene/texture_uses.h"

namespace radfarm {
namespace {

constexpr float kUnitTolerance = 1e-3F;

bool is_place(const Vec3& p) { return max_abs_component(p) < static_cast<float>(limits::kCoordinate) && is_finite(p); }
bool is_unit(const Vec3& n) { return is_finite(n) && std::fabs(length(n) - 1) < kUnitTolerance; }
bool is_light(const Spectrum& s) {
  return is_finite(s) && min_component(s) >= 0 && max_component(s) <= static_cast<float>(limits::kLight) * 1.0001F;
}
bool is_within(float value, float lowest, float highest) { return value >= lowest && value <= highest; }

/// The first fault among checks that run in turn.
class Faults {
 public:
  void place(std::string_view array, std::size_t index, std::string_view name) {
    if (ok())
      place_ =
          std::string(array) + "[" + std::to_string(index) + "]" + (name.empty() ? "" : " '" + std::string(name) + "'");
  }
  void require(bool condition, std::string_view what) {
    if (!condition && ok()) status_ = fail(Code::kInvalidArgument, place_ + ": " + std::string(what));
  }
  bool ok() const { return status_.has_value(); }
  const Status& status() const { return status_; }

 private:
  std::string place_;
  Status status_;
};

void check_texture(const Texture& texture, Faults& faults) {
  const bool has_size = texture.width >= 1 && texture.height >= 1 && texture.width <= limits::kTextureSide &&
                        texture.height <= limits::kTextureSide;
  faults.require(has_size, "size must be from 1 to 16384 a side");
  faults.require(!has_size || texture.texels.size() == std::size_t{texture.width} * texture.height,
                 "number of texels is not width times height");
}

bool is_share(const Spectrum& s) { return is_finite(s) && min_component(s) >= 0 && max_component(s) <= 1; }

void check_layers(const Material& m, Faults& faults) {
  faults.require(is_share(m.base_color), "base colour must be in [0, 1]");
  faults.require(is_within(m.metallic, 0, 1) && is_within(m.roughness, 0, 1), "metallic and roughness must be in [0, 1]");
  faults.require(is_within(m.specular, 0, 1), "specular factor must be in [0, 1]");
  faults.require(is_light(m.specular_color), "specular colour must be finite and not negative");
  faults.require(is_within(m.ior, 1, 1e6F), "index of refraction must be in [1, 1e6]");
  faults.require(is_within(m.transmission, 0, 1), "transmission must be in [0, 1]");
  faults.require(is_share(m.attenuation_color), "attenuation colour must be in [0, 1]");
  faults.require(is_within(m.attenuation_distance, 0, 1e18F), "attenuation distance must not be negative");
  faults.require(is_within(m.clearcoat, 0, 1) && is_within(m.clearcoat_roughness, 0, 1), "clearcoat must be in [0, 1]");
  faults.require(is_share(m.sheen_color) && is_within(m.sheen_roughness, 0, 1), "sheen must be in [0, 1]");
  faults.require(is_within(m.anisotropy, 0, 1) && std::isfinite(m.anisotropy_rotation), "anisotropy must be in [0, 1]");
  faults.require(is_within(m.normal_scale, -1e6F, 1e6F), "normal scale must be finite");
}

void check_material(const Material& material, std::size_t textures, Faults& faults) {
  check_layers(material, faults);
  for (const TextureUse* use : texture_uses(material)) {
    const TextureUse& t = *use;
    faults.require(!t.is_used() || t.texture < textures, "texture does not exist");
    faults.require(t.uv_set < 2, "UV set must be 0 or 1");
    faults.require(std::all_of(t.map.begin(), t.map.end(), [](float m) { return std::isfinite(m); }),
                   "texture transform is not finite");
  }
  faults.require(is_light(material.emission), "emission must be finite and not negative");
  faults.require(is_within(material.alpha, 0, 1), "alpha must be in [0, 1]");
  faults.require(is_within(material.alpha_cutoff, 0, 1e6F), "alpha cutoff must be in [0, 1e6]");
}

void check_mesh(const Mesh& mesh, std::size_t materials, Faults& faults) {
  const std::size_t vertices = mesh.positions.size();
  const auto fits = [&](std::size_t size) { return size == 0 || size == vertices; };
  faults.require(mesh.material < materials, "material does not exist");
  faults.require(
      fits(mesh.normals.size()) && fits(mesh.uv[0].size()) && fits(mesh.uv[1].size()) && fits(mesh.colors.size()) &&
          fits(mesh.tangents.size()),
      "an attribute has another length than the positions");
  faults.require(std::all_of(mesh.positions.begin(), mesh.positions.end(), is_place),
                 "a position is not finite or beyond 1e18");
  faults.require(std::all_of(mesh.normals.begin(), mesh.normals.end(), is_unit), "a normal is not of unit length");
  faults.require(std::all_of(mesh.tangents.begin(), mesh.tangents.end(),
                             [](const auto& t) { return is_unit({t[0], t[1], t[2]}) && std::fabs(t[3]) == 1; }),
                 "a tangent is not of unit length");
  for (const std::vector<Vec2>& set : mesh.uv) {
    faults.require(
        std::all_of(set.begin(), set.end(), [](const Vec2& uv) { return std::isfinite(uv.x) && std::isfinite(uv.y); }),
        "a texture coordinate is not finite");
  }
  for (const auto& color : mesh.colors) {
    faults.require(std::all_of(color.begin(), color.end(), [](float c) { return is_within(c, 0, 1); }),
                   "a vertex colour is outside [0, 1]");
  }
  for (const auto& t : mesh.triangles) {
    if (t[0] < vertices && t[1] < vertices && t[2] < vertices) continue;
    return faults.require(false, "a triangle names a vertex that does not exist");
  }
}

void check_camera(const Camera& camera, Faults& faults) {
  faults.require(is_place(camera.position), "position is not finite");
  faults.require(is_unit(camera.right) && is_unit(camera.up) && is_unit(camera.forward), "an axis is not unit");
  faults.require(std::fabs(dot(camera.right, camera.up)) < kUnitTolerance &&
                     std::fabs(dot(camera.right, camera.forward)) < kUnitTolerance &&
                     std::fabs(dot(camera.up, camera.forward)) < kUnitTolerance,
                 "axes are not perpendicular");
  faults.require(is_within(camera.vertical_fov, 1e-6F, kPi), "field of view must be above 0 and below pi");
  faults.require(is_within(camera.half_height, 1e-18F, 1e18F), "half height must be positive");
  faults.require(is_within(camera.aspect, 0, 1e9F), "aspect must not be negative");
  faults.require(is_within(camera.lens_diameter, 0, 1e6F), "lens diameter must not be negative");
  faults.require(is_within(camera.focus_distance, 1e-6F, 1e18F), "focus distance must be positive");
}

void check_light(const PunctualLight& light, std::size_t photometries, Faults& faults) {
  faults.require(light.photometry == kNone || light.photometry < photometries, "photometry does not exist");
  faults.require(is_unit(light.right), "right axis is not unit");
  faults.require(light.photometry == kNone || std::fabs(dot(light.right, light.direction)) < kUnitTolerance,
                 "right axis is not perpendicular to the direction");
  faults.require(is_place(light.position), "position is not finite");
  faults.require(is_unit(light.direction), "direction is not unit");
  faults.require(is_light(light.intensity), "intensity must be finite and not negative");
  faults.require(is_within(light.cos_inner, 0, 1) && is_within(light.cos_outer, 0, 1), "cone angle out of range");
}

void check_photometry(const Photometry& p, Faults& faults) {
  const auto is_ascending = [](const std::vector<float>& angles, float most) {
    return !angles.empty() && angles.front() >= 0 && angles.back() <= most && std::is_sorted(angles.begin(), angles.end());
  };
  faults.require(is_ascending(p.gamma, 180) && is_ascending(p.c, 360), "angles must ascend within [0, 180] and [0, 360]");
  const bool is_whole = !p.c.empty() && p.c.front() == 0 &&
                        (p.c.size() == 1 || p.c.back() == 90 || p.c.back() == 180 || p.c.back() == 360);
  faults.require(is_whole, "C must be 0 alone or go from 0 to 90, 180 or 360");
  faults.require(p.candela.size() == p.gamma.size() * p.c.size(), "number of candela values is not that of the angles");
  faults.require(std::all_of(p.candela.begin(), p.candela.end(), [](float c) { return is_within(c, 0, 1e18F); }),
                 "a candela value is negative or not finite");
}

void check_environment(const Environment& e, Faults& faults) {
  faults.require(e.width <= limits::kTextureSide && e.height <= limits::kTextureSide &&
                     e.radiance.size() == std::size_t{e.width} * e.height,
                 "number of pixels is not width times height");
  faults.require(std::all_of(e.radiance.begin(), e.radiance.end(), is_light), "a radiance is negative or not finite");
  faults.require(is_unit(e.sun.direction) && is_within(e.sun.cos_radius, -1, 1), "sun has no direction or size");
  faults.require(is_light(e.sun.radiance), "the sun's radiance is negative or not finite");
}

bool is_affine(const Matrix4& m) {
  for (int row = 0; row < 4; ++row) {
    if (!is_place({m[row][0], m[row][1], m[row][2]})) return false;
  }
  return m[0][3] == 0 && m[1][3] == 0 && m[2][3] == 0 && m[3][3] == 1;
}

}  // namespace

bool is_invertible(const Matrix4& matrix) {
  Vec3d rows[3];
  for (int i = 0; i < 3; ++i) rows[i] = Vec3d(matrix[i][0], matrix[i][1], matrix[i][2]);
  const double volume = std::fabs(dot(rows[0], cross(rows[1], rows[2])));
  const double box = length(rows[0]) * length(rows[1]) * length(rows[2]);
  // Below this share, three float axes may as well lie in one plane.
  constexpr double kFlat = 1e-7;
  return std::isfinite(box) && box > 0 && volume > kFlat * box;
}

Status validate(const Scene& scene) {
  Faults faults;
  for (std::size_t i = 0; i < scene.textures.size() && faults.ok(); ++i) {
    faults.place("textures", i, "");
    check_texture(scene.textures[i], faults);
  }
  for (std::size_t i = 0; i < scene.materials.size() && faults.ok(); ++i) {
    faults.place("materials", i, scene.materials[i].name);
    check_material(scene.materials[i], scene.textures.size(), faults);
  }
  for (std::size_t i = 0; i < scene.meshes.size() && faults.ok(); ++i) {
    faults.place("meshes", i, scene.meshes[i].name);
    check_mesh(scene.meshes[i], scene.materials.size(), faults);
  }
  for (std::size_t i = 0; i < scene.instances.size() && faults.ok(); ++i) {
    const Instance& instance = scene.instances[i];
    faults.place("instances", i, instance.name);
    faults.require(instance.mesh < scene.meshes.size(), "mesh does not exist");
    faults.require(is_affine(instance.to_world), "transform is not affine and finite");
    faults.require(is_invertible(instance.to_world), "transform is not invertible");
  }
  for (std::size_t i = 0; i < scene.lights.size() && faults.ok(); ++i) {
    faults.place("lights", i, "");
    check_light(scene.lights[i], scene.photometries.size(), faults);
  }
  for (std::size_t i = 0; i < scene.photometries.size() && faults.ok(); ++i) {
    faults.place("photometries", i, scene.photometries[i].name);
    check_photometry(scene.photometries[i], faults);
  }
  faults.place("environment", 0, "");
  check_environment(scene.environment, faults);
  for (std::size_t i = 0; i < scene.cameras.size() && faults.ok(); ++i) {
    faults.place("cameras", i, scene.cameras[i].name);
    check_camera(scene.cameras[i], faults);
  }
  return faults.status();
}

}  // namespace radfarm
