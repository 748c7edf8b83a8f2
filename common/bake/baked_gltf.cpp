#include "bake/baked_gltf.h"

#include <algorithm>
#include <map>
#include <span>
#include <string>
#include <tuple>

#include <nlohmann/json.hpp>

#include "bake/glb.h"
#include "image/png.h"

namespace radfarm {
namespace {

using nlohmann::json;

constexpr int kFloat = 5126, kUnsignedShort = 5123, kUnsignedInt = 5125;
// Planes between which viewers show things, in radii of the scene.
constexpr float kNearPlane = 1e-4F, kFarPlane = 10;
constexpr double kDefaultAspect = 16.0 / 9.0;

template <typename T>
std::span<const std::byte> bytes_of(const std::vector<T>& values) {
  return std::as_bytes(std::span(values));
}

template <typename Field>
auto column(const BakedMesh& mesh, Field BakedVertex::*field) {
  std::vector<Field> values;
  values.reserve(mesh.vertices.size());
  for (const BakedVertex& vertex : mesh.vertices) values.push_back(vertex.*field);
  return values;
}

std::size_t add_positions(const BakedMesh& mesh, GlbWriter& file) {
  Box3 box;
  for (const BakedVertex& vertex : mesh.vertices) box.extendBy(vertex.position);
  const std::size_t index = file.add_accessor(bytes_of(column(mesh, &BakedVertex::position)), GlbWriter::Use::kVertices,
                                              {kFloat, "VEC3", false, mesh.vertices.size()});
  file.json["accessors"][index]["min"] = {box.min.x, box.min.y, box.min.z};
  file.json["accessors"][index]["max"] = {box.max.x, box.max.y, box.max.z};
  return index;
}

void add_mesh(const BakedScene& baked, const BakedMesh& mesh, GlbWriter& file) {
  const std::size_t count = mesh.vertices.size();
  constexpr auto kVertices = GlbWriter::Use::kVertices;
  json attributes = {
      {"POSITION", add_positions(mesh, file)},
      {"COLOR_0", file.add_accessor(bytes_of(column(mesh, &BakedVertex::color)), kVertices, {kUnsignedShort, "VEC4", true, count})},
      {"_IRRADIANCE",
       file.add_accessor(bytes_of(column(mesh, &BakedVertex::irradiance)), kVertices, {kFloat, "VEC3", false, count})}};
  if (baked.materials[mesh.material].shows != BakedMaterial::Shows::kColor) {
    attributes["TEXCOORD_0"] =
        file.add_accessor(bytes_of(column(mesh, &BakedVertex::uv)), kVertices, {kFloat, "VEC2", false, count});
  }
  const std::size_t indices = file.add_accessor(bytes_of(mesh.triangles), GlbWriter::Use::kIndices,
                                                {kUnsignedInt, "SCALAR", false, 3 * mesh.triangles.size()});
  const json primitive = {{"attributes", attributes}, {"indices", indices}, {"material", mesh.material}};
  file.json["meshes"].push_back({{"name", mesh.name}, {"primitives", json::array({primitive})}});
}

int wrap_number(Texture::Wrap wrap) {
  return wrap == Texture::Wrap::kClamp ? 33071 : wrap == Texture::Wrap::kMirror ? 33648 : 10497;
}

/// Textures by their index in the scene, each written once.
class TextureWriter {
 public:
  TextureWriter(const Scene& scene, GlbWriter& file) : scene_(scene), file_(file) {}

  Result<std::size_t> add(std::uint32_t index) {
    const auto known = written_.find(index);
    if (known != written_.end()) return known->second;
    const Texture& texture = scene_.textures[index];
    RADFARM_TRY(const std::vector<std::byte> png, encode_png(texture.width, texture.height, texture.texels));
    file_.json["images"].push_back(
        {{"bufferView", file_.add_view(png, GlbWriter::Use::kImage)}, {"mimeType", "image/png"}});
    file_.json["samplers"].push_back({{"wrapS", wrap_number(texture.wrap_u)}, {"wrapT", wrap_number(texture.wrap_v)}});
    const std::size_t last = file_.json["images"].size() - 1;
    file_.json["textures"].push_back({{"source", last}, {"sampler", last}});
    written_[index] = last;
    return last;
  }

 private:
  const Scene& scene_;
  GlbWriter& file_;
  std::map<std::uint32_t, std::size_t> written_;
};

/// What is seen through shows through: coverage, and panes in part.
void add_alpha(const Material& material, json& gltf) {
  const float alpha = (material.alpha_mode == Material::Alpha::kOpaque ? 1 : material.alpha) * (1 - material.transmission);
  gltf["pbrMetallicRoughness"]["baseColorFactor"] = {1, 1, 1, alpha};
  if (material.alpha_mode == Material::Alpha::kMask && material.transmission == 0) {
    gltf["alphaMode"] = "MASK";
    gltf["alphaCutoff"] = material.alpha_cutoff;
  } else if (material.alpha_mode != Material::Alpha::kOpaque || material.transmission > 0) {
    gltf["alphaMode"] = "BLEND";
  }
}

Status add_material(const BakedMaterial& baked, const Scene& scene, TextureWriter& textures, GlbWriter& file) {
  const Material& material = scene.materials[baked.material];
  json gltf = {{"name", material.name},
               {"pbrMetallicRoughness", {{"metallicFactor", 0}, {"roughnessFactor", 1}}},
               {"extensions", {{"KHR_materials_unlit", json::object()}}}};
  add_alpha(material, gltf);
  if (baked.shows != BakedMaterial::Shows::kColor) {
    const bool is_emission = baked.shows == BakedMaterial::Shows::kEmissionTexture;
    RADFARM_TRY(const std::size_t texture, textures.add((is_emission ? material.emission_texture : material.base_texture).texture));
    gltf["pbrMetallicRoughness"]["baseColorTexture"] = {{"index", texture}};
  }
  file.json["materials"].push_back(std::move(gltf));
  return {};
}

json lens_of(const Camera& camera, float radius) {
  const double aspect = camera.aspect > 0 ? static_cast<double>(camera.aspect) : kDefaultAspect;
  json gltf = {{"name", camera.name}};
  if (camera.kind == Camera::Kind::kPerspective) {
    gltf["type"] = "perspective";
    gltf["perspective"] = {{"yfov", camera.vertical_fov}, {"znear", kNearPlane * radius}, {"zfar", kFarPlane * radius}};
    if (camera.aspect > 0) gltf["perspective"]["aspectRatio"] = camera.aspect;
    return gltf;
  }
  const auto half_height = static_cast<double>(camera.half_height);
  gltf["type"] = "orthographic";
  gltf["orthographic"] = {
      {"xmag", half_height * aspect}, {"ymag", half_height}, {"znear", 0}, {"zfar", kFarPlane * radius}};
  return gltf;
}

void add_cameras(const World& world, json& children, GlbWriter& file) {
  for (const Camera& camera : world.scene.cameras) {
    const Vec3 back = -camera.forward;
    file.json["cameras"].push_back(lens_of(camera, world.radius));
    children.push_back(file.json["nodes"].size());
    file.json["nodes"].push_back({{"name", camera.name},
                                  {"camera", file.json["cameras"].size() - 1},
                                  {"matrix", {camera.right.x, camera.right.y, camera.right.z, 0, camera.up.x, camera.up.y,
                                              camera.up.z, 0, back.x, back.y, back.z, 0, camera.position.x,
                                              camera.position.y, camera.position.z, 1}}});
  }
}

json extras_of(const BakedScene& baked, const json& extras) {
  json all = extras;
  all["exposure_ev"] = baked.exposure_ev;
  all["color"] = "COLOR_0 times the base colour is 2^exposure_ev times the radiance in cd/m^2, clipped at 1";
  all["irradiance"] = "_IRRADIANCE is in lux, linear Rec.709; its luminance is 0.2126 R + 0.7152 G + 0.0722 B";
  return all;
}

}  // namespace

Result<std::vector<std::byte>> encode_baked_glb(const BakedScene& baked, const World& world, const json& extras) {
  GlbWriter file;
  file.json["asset"]["generator"] = "radfarm bake";
  file.json["asset"]["extras"] = extras_of(baked, extras);
  file.json["extensionsUsed"] = json::array({"KHR_materials_unlit"});
  TextureWriter textures(world.scene, file);
  for (const BakedMaterial& material : baked.materials) {
    RADFARM_TRY_STATUS(add_material(material, world.scene, textures, file));
  }
  file.json["nodes"] = json::array();
  json children = json::array();
  for (const BakedMesh& mesh : baked.meshes) {
    add_mesh(baked, mesh, file);
    children.push_back(file.json["nodes"].size());
    file.json["nodes"].push_back({{"name", mesh.name}, {"mesh", file.json["meshes"].size() - 1}});
  }
  add_cameras(world, children, file);
  // The scene lies about its own zero; one node brings it back to where the source file has it, in double.
  const Vec3d& origin = world.scene.origin;
  file.json["nodes"].push_back({{"name", "scene"}, {"translation", {origin.x, origin.y, origin.z}}});
  if (!children.empty()) file.json["nodes"].back()["children"] = std::move(children);
  file.json["scenes"] = json::array({{{"nodes", json::array({file.json["nodes"].size() - 1})}}});
  file.json["scene"] = 0;
  return std::move(file).finish();
}

}  // namespace radfarm
