#include "scene/validate.h"

#include <algorithm>
#include <cmath>
#include <string>

#include "scene/limits.h"

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

void check_material(const Material& material, std::size_t textures, Faults& faults) {
  const auto is_texture = [&](std::uint32_t index) { return index == kNone || index < textures; };
  faults.require(is_finite(material.reflectance) && min_component(material.reflectance) >= 0 &&
                     max_component(material.reflectance) <= 1,
                 "reflectance must be in [0, 1]");
  faults.require(is_light(material.emission), "emission must be finite and not negative");
  faults.require(is_texture(material.reflectance_texture) && is_texture(material.emission_texture),
                 "texture does not exist");
  faults.require(material.reflectance_uv < 2 && material.emission_uv < 2, "UV set must be 0 or 1");
  faults.require(is_within(material.alpha, 0, 1), "alpha must be in [0, 1]");
  faults.require(is_within(material.alpha_cutoff, 0, 1e6F), "alpha cutoff must be in [0, 1e6]");
}

void check_mesh(const Mesh& mesh, std::size_t materials, Faults& faults) {
  const std::size_t vertices = mesh.positions.size();
  const auto fits = [&](std::size_t size) { return size == 0 || size == vertices; };
  faults.require(mesh.material < materials, "material does not exist");
  faults.require(
      fits(mesh.normals.size()) && fits(mesh.uv[0].size()) && fits(mesh.uv[1].size()) && fits(mesh.colors.size()),
      "an attribute has another length than the positions");
  faults.require(std::all_of(mesh.positions.begin(), mesh.positions.end(), is_place),
                 "a position is not finite or beyond 1e18");
  faults.require(std::all_of(mesh.normals.begin(), mesh.normals.end(), is_unit), "a normal is not of unit length");
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
}

void check_light(const PunctualLight& light, Faults& faults) {
  faults.require(is_place(light.position), "position is not finite");
  faults.require(is_unit(light.direction), "direction is not unit");
  faults.require(is_light(light.intensity), "intensity must be finite and not negative");
  faults.require(is_within(light.cos_inner, 0, 1) && is_within(light.cos_outer, 0, 1), "cone angle out of range");
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
    check_light(scene.lights[i], faults);
  }
  for (std::size_t i = 0; i < scene.cameras.size() && faults.ok(); ++i) {
    faults.place("cameras", i, scene.cameras[i].name);
    check_camera(scene.cameras[i], faults);
  }
  return faults.status();
}

}  // namespace radfarm
