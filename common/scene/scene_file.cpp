#include "scene/scene_file.h"

#include <bit>
#include <string>
#include <string_view>

#include "base/flat_file.h"
#include "scene/validate.h"

namespace radfarm {
namespace {

constexpr std::uint32_t kVersion = 2;

// Records as stored: fixed-size fields without padding, so equal scenes give equal bytes.
struct TextureRecord {
  std::uint32_t width, height, is_srgb, wrap_u, wrap_v;
};
struct MaterialRecord {
  std::array<float, 3> reflectance;
  std::uint32_t reflectance_texture, reflectance_uv;
  std::array<float, 3> emission;
  std::uint32_t emission_texture, emission_uv, emits_from_both_sides, alpha_mode;
  float alpha, alpha_cutoff;
  std::uint32_t folds_gloss_into_diffuse, is_switched_off;
};
struct MeshRecord {
  std::uint64_t vertices, triangles;
  std::uint32_t material, arrays;  // a bit for each optional array
};
struct InstanceRecord {
  std::uint32_t mesh;
  std::array<float, 16> to_world;
};
struct LightRecord {
  std::uint32_t kind;
  std::array<float, 3> position, direction, intensity;
  float cos_inner, cos_outer;
};
struct CameraRecord {
  std::uint32_t kind;
  std::array<float, 3> position, right, up, forward;
  float vertical_fov, half_height, aspect;
};
constexpr std::uint32_t kHasNormals = 1;
constexpr std::uint32_t kHasUv0 = 2;
constexpr std::uint32_t kHasUv1 = 4;
constexpr std::uint32_t kHasColors = 8;

std::array<float, 3> stored(const Vec3& v) { return {v.x, v.y, v.z}; }
std::array<float, 3> stored(const Spectrum& s) { return {s.r, s.g, s.b}; }
Vec3 vector(const std::array<float, 3>& a) { return {a[0], a[1], a[2]}; }
Spectrum spectrum(const std::array<float, 3>& a) { return {a[0], a[1], a[2]}; }

tl::unexpected<Error> damaged(const std::string& what) { return fail(Code::kDataLoss, "scene file: " + what); }

/// Texts one after the other, and where each ends.
void add_texts(FlatFileWriter& file, const std::string& name, const std::vector<std::string>& texts) {
  std::string all;
  std::vector<std::uint64_t> ends;
  for (const std::string& text : texts) ends.push_back((all += text).size());
  file.add_text(name + ".text", all);
  file.add(name + ".ends", ends);
}

Result<std::vector<std::string>> get_texts(const FlatFileReader& file, const std::string& name, std::size_t count) {
  RADFARM_TRY(const std::string all, file.get_text(name + ".text"));
  RADFARM_TRY(const auto ends, file.get<std::uint64_t>(name + ".ends"));
  if (ends.size() != count) return damaged(name + " has another number of texts");
  std::vector<std::string> texts;
  std::uint64_t begin = 0;
  for (const std::uint64_t end : ends) {
    if (end < begin || end > all.size()) return damaged(name + " has a text that lies outside");
    texts.push_back(all.substr(begin, end - begin));
    begin = end;
  }
  if (begin != all.size()) return damaged(name + " has text that belongs to nothing");
  return texts;
}

template <typename Elements>
std::vector<std::string> names_of(const Elements& elements) {
  std::vector<std::string> names;
  for (const auto& element : elements) names.push_back(element.name);
  return names;
}

/// The same member of all elements in one array.
template <typename T, typename Elements, typename Member>
void add_concatenated(FlatFileWriter& file, std::string_view name, const Elements& elements, const Member& member) {
  std::vector<T> all;
  for (const auto& element : elements) {
    const auto& part = member(element);
    all.insert(all.end(), part.begin(), part.end());
  }
  file.add(name, all);
}

/// Hands out consecutive pieces of an array; remembers whether they were all there and nothing was left.
template <typename T>
class Pieces {
 public:
  explicit Pieces(std::span<const T> all) : rest_(all) {}
  std::vector<T> next(std::uint64_t count) {
    if (count > rest_.size()) {
      is_short_ = true;
      return {};
    }
    const auto piece = rest_.first(count);
    rest_ = rest_.subspan(count);
    return {piece.begin(), piece.end()};
  }
  bool fitted() const { return !is_short_ && rest_.empty(); }

 private:
  std::span<const T> rest_;
  bool is_short_ = false;
};

std::vector<TextureRecord> texture_records(const Scene& scene) {
  std::vector<TextureRecord> records;
  for (const Texture& t : scene.textures) {
    records.push_back({t.width, t.height, t.is_srgb ? 1U : 0U, static_cast<std::uint32_t>(t.wrap_u),
                       static_cast<std::uint32_t>(t.wrap_v)});
  }
  return records;
}

std::vector<MaterialRecord> material_records(const Scene& scene) {
  std::vector<MaterialRecord> records;
  for (const Material& m : scene.materials) {
    records.push_back({stored(m.reflectance), m.reflectance_texture, m.reflectance_uv, stored(m.emission),
                       m.emission_texture, m.emission_uv, m.emits_from_both_sides ? 1U : 0U,
                       static_cast<std::uint32_t>(m.alpha_mode), m.alpha, m.alpha_cutoff,
                       m.folds_gloss_into_diffuse ? 1U : 0U, m.is_switched_off ? 1U : 0U});
  }
  return records;
}

std::vector<MeshRecord> mesh_records(const Scene& scene) {
  std::vector<MeshRecord> records;
  for (const Mesh& m : scene.meshes) {
    const std::uint32_t arrays = (m.normals.empty() ? 0 : kHasNormals) | (m.uv[0].empty() ? 0 : kHasUv0) |
                                 (m.uv[1].empty() ? 0 : kHasUv1) | (m.colors.empty() ? 0 : kHasColors);
    records.push_back({m.positions.size(), m.triangles.size(), m.material, arrays});
  }
  return records;
}

void add_meshes(FlatFileWriter& file, const Scene& scene) {
  file.add("meshes", mesh_records(scene));
  add_texts(file, "meshes.names", names_of(scene.meshes));
  add_concatenated<Vec3>(file, "positions", scene.meshes, [](const Mesh& m) -> auto& { return m.positions; });
  add_concatenated<Vec3>(file, "normals", scene.meshes, [](const Mesh& m) -> auto& { return m.normals; });
  add_concatenated<Vec2>(file, "uv0", scene.meshes, [](const Mesh& m) -> auto& { return m.uv[0]; });
  add_concatenated<Vec2>(file, "uv1", scene.meshes, [](const Mesh& m) -> auto& { return m.uv[1]; });
  add_concatenated<std::array<float, 4>>(file, "colors", scene.meshes, [](const Mesh& m) -> auto& { return m.colors; });
  add_concatenated<std::array<std::uint32_t, 3>>(file, "triangles", scene.meshes,
                                                 [](const Mesh& m) -> auto& { return m.triangles; });
}

void add_views(FlatFileWriter& file, const Scene& scene) {
  std::vector<InstanceRecord> instances;
  for (const Instance& instance : scene.instances) {
    InstanceRecord record{instance.mesh, {}};
    for (std::size_t i = 0; i < 16; ++i) record.to_world[i] = instance.to_world[static_cast<int>(i / 4)][i % 4];
    instances.push_back(record);
  }
  file.add("instances", instances);
  add_texts(file, "instances.names", names_of(scene.instances));
  std::vector<LightRecord> lights;
  for (const PunctualLight& l : scene.lights) {
    lights.push_back({static_cast<std::uint32_t>(l.kind), stored(l.position), stored(l.direction), stored(l.intensity),
                      l.cos_inner, l.cos_outer});
  }
  file.add("lights", lights);
  std::vector<CameraRecord> cameras;
  for (const Camera& c : scene.cameras) {
    cameras.push_back({static_cast<std::uint32_t>(c.kind), stored(c.position), stored(c.right), stored(c.up),
                       stored(c.forward), c.vertical_fov, c.half_height, c.aspect});
  }
  file.add("cameras", cameras);
  add_texts(file, "cameras.names", names_of(scene.cameras));
}

Status get_textures(const FlatFileReader& file, Scene& scene) {
  RADFARM_TRY(const auto records, file.get<TextureRecord>("textures"));
  RADFARM_TRY(const auto all_texels, (file.get<std::array<std::uint8_t, 4>>("texels")));
  Pieces<std::array<std::uint8_t, 4>> texels(all_texels);
  for (const TextureRecord& r : records) {
    if (r.is_srgb > 1 || r.wrap_u > 2 || r.wrap_v > 2) return damaged("a texture has an unknown mode");
    Texture texture{r.width, r.height, r.is_srgb == 1, Texture::Wrap(r.wrap_u), Texture::Wrap(r.wrap_v), {}};
    texture.texels = texels.next(std::uint64_t{r.width} * r.height);
    scene.textures.push_back(std::move(texture));
  }
  if (!texels.fitted()) return damaged("texels do not fit the textures");
  return {};
}

Status get_materials(const FlatFileReader& file, Scene& scene) {
  RADFARM_TRY(const auto records, file.get<MaterialRecord>("materials"));
  RADFARM_TRY(auto names, get_texts(file, "materials.names", records.size()));
  for (std::size_t i = 0; i < records.size(); ++i) {
    const MaterialRecord& r = records[i];
    if (r.alpha_mode > 2 || r.emits_from_both_sides > 1 || r.folds_gloss_into_diffuse > 1 ||
        r.is_switched_off > 1) {
      return damaged("a material has an unknown mode");
    }
    scene.materials.push_back({std::move(names[i]), spectrum(r.reflectance), r.reflectance_texture, r.reflectance_uv,
                               spectrum(r.emission), r.emission_texture, r.emission_uv, r.emits_from_both_sides == 1,
                               Material::Alpha(r.alpha_mode), r.alpha, r.alpha_cutoff,
                               r.folds_gloss_into_diffuse == 1, r.is_switched_off == 1});
  }
  return {};
}

Status get_meshes(const FlatFileReader& file, Scene& scene) {
  RADFARM_TRY(const auto records, file.get<MeshRecord>("meshes"));
  RADFARM_TRY(auto names, get_texts(file, "meshes.names", records.size()));
  RADFARM_TRY(const auto all_positions, file.get<Vec3>("positions"));
  RADFARM_TRY(const auto all_normals, file.get<Vec3>("normals"));
  RADFARM_TRY(const auto all_uv0, file.get<Vec2>("uv0"));
  RADFARM_TRY(const auto all_uv1, file.get<Vec2>("uv1"));
  RADFARM_TRY(const auto all_colors, (file.get<std::array<float, 4>>("colors")));
  RADFARM_TRY(const auto all_triangles, (file.get<std::array<std::uint32_t, 3>>("triangles")));
  Pieces<Vec3> positions(all_positions);
  Pieces<Vec3> normals(all_normals);
  std::array<Pieces<Vec2>, 2> uvs = {Pieces<Vec2>(all_uv0), Pieces<Vec2>(all_uv1)};
  Pieces<std::array<float, 4>> colors(all_colors);
  Pieces<std::array<std::uint32_t, 3>> triangles(all_triangles);
  for (std::size_t i = 0; i < records.size(); ++i) {
    const MeshRecord& r = records[i];
    const auto length = [&](std::uint32_t bit) { return (r.arrays & bit) != 0 ? r.vertices : 0; };
    if (r.arrays > 15) return damaged("a mesh has unknown arrays");
    Mesh mesh;
    mesh.name = std::move(names[i]);
    mesh.material = r.material;
    mesh.positions = positions.next(r.vertices);
    mesh.normals = normals.next(length(kHasNormals));
    mesh.uv = {uvs[0].next(length(kHasUv0)), uvs[1].next(length(kHasUv1))};
    mesh.colors = colors.next(length(kHasColors));
    mesh.triangles = triangles.next(r.triangles);
    scene.meshes.push_back(std::move(mesh));
  }
  const bool fitted = positions.fitted() && normals.fitted() && uvs[0].fitted() && uvs[1].fitted() &&
                      colors.fitted() && triangles.fitted();
  if (!fitted) return damaged("arrays do not fit the meshes");
  return {};
}

Status get_instances(const FlatFileReader& file, Scene& scene) {
  RADFARM_TRY(const auto records, file.get<InstanceRecord>("instances"));
  RADFARM_TRY(auto names, get_texts(file, "instances.names", records.size()));
  for (std::size_t k = 0; k < records.size(); ++k) {
    Instance instance{records[k].mesh, Matrix4(), std::move(names[k])};
    for (std::size_t i = 0; i < 16; ++i) instance.to_world[static_cast<int>(i / 4)][i % 4] = records[k].to_world[i];
    scene.instances.push_back(std::move(instance));
  }
  return {};
}

Status get_views(const FlatFileReader& file, Scene& scene) {
  RADFARM_TRY(const auto lights, file.get<LightRecord>("lights"));
  for (const LightRecord& r : lights) {
    if (r.kind > 2) return damaged("a light has an unknown kind");
    scene.lights.push_back({PunctualLight::Kind(r.kind), vector(r.position), vector(r.direction),
                            spectrum(r.intensity), r.cos_inner, r.cos_outer});
  }
  RADFARM_TRY(const auto cameras, file.get<CameraRecord>("cameras"));
  RADFARM_TRY(auto names, get_texts(file, "cameras.names", cameras.size()));
  for (std::size_t i = 0; i < cameras.size(); ++i) {
    const CameraRecord& r = cameras[i];
    if (r.kind > 1) return damaged("a camera has an unknown kind");
    scene.cameras.push_back({std::move(names[i]), Camera::Kind(r.kind), vector(r.position), vector(r.right),
                             vector(r.up), vector(r.forward), r.vertical_fov, r.half_height, r.aspect});
  }
  return {};
}

}  // namespace

std::vector<std::byte> encode_scene(const Scene& scene) {
  FlatFileWriter file("scene", kVersion);
  file.add_value("origin", std::array<double, 3>{scene.origin.x, scene.origin.y, scene.origin.z});
  file.add("textures", texture_records(scene));
  add_concatenated<std::array<std::uint8_t, 4>>(file, "texels", scene.textures,
                                                [](const Texture& t) -> auto& { return t.texels; });
  file.add("materials", material_records(scene));
  add_texts(file, "materials.names", names_of(scene.materials));
  add_meshes(file, scene);
  add_views(file, scene);
  add_texts(file, "notes", scene.notes);
  return file.finish();
}

Result<Scene> decode_scene(std::span<const std::byte> bytes) {
  RADFARM_TRY(const FlatFileReader file, FlatFileReader::open(bytes, "scene", kVersion));
  Scene scene;
  RADFARM_TRY(const auto origin, (file.get_value<std::array<double, 3>>("origin")));
  scene.origin = {origin[0], origin[1], origin[2]};
  if (!(scene.origin.length2() < 1e40)) return damaged("origin is not finite");
  RADFARM_TRY_STATUS(get_textures(file, scene));
  RADFARM_TRY_STATUS(get_materials(file, scene));
  RADFARM_TRY_STATUS(get_meshes(file, scene));
  RADFARM_TRY_STATUS(get_instances(file, scene));
  RADFARM_TRY_STATUS(get_views(file, scene));
  RADFARM_TRY(const auto note_ends, file.get<std::uint64_t>("notes.ends"));
  RADFARM_TRY(scene.notes, get_texts(file, "notes", note_ends.size()));
  RADFARM_TRY_STATUS(validate(scene));
  return scene;
}

}  // namespace radfarm
