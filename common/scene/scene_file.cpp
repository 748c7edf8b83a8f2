#include "scene/scene_file.h"

#include <bit>
#include <string>
#include <string_view>

#include "base/flat_file.h"
#include "scene/texture_uses.h"
#include "scene/validate.h"

namespace radfarm {
namespace {

constexpr std::uint32_t kVersion = 3;

// Records as stored: fixed-size fields without padding, so equal scenes give equal bytes.
struct TextureRecord {
  std::uint32_t width, height, is_srgb, wrap_u, wrap_v;
};
/// Every number of a material in the order of Material, then its textures likewise.
struct MaterialRecord {
  std::array<float, 3> base_color, specular_color, attenuation_color, sheen_color, emission;
  float metallic, roughness, specular, ior, transmission, attenuation_distance, clearcoat, clearcoat_roughness;
  float sheen_roughness, anisotropy, anisotropy_rotation, normal_scale, alpha, alpha_cutoff;
  std::uint32_t has_volume, emits_from_both_sides, alpha_mode, is_switched_off, unsimulated;
  std::array<TextureUse, 11> textures;
};
static_assert(sizeof(MaterialRecord) == (15 + 14 + 5 + 11 * 8) * 4, "stored without padding");
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
  std::uint32_t photometry;
  std::array<float, 3> right;
};
struct PhotometryRecord {
  std::uint64_t gammas, cs;
};
struct EnvironmentRecord {
  std::uint32_t width, height;
  std::array<float, 3> sun_direction, sun_radiance;
  float sun_cos_radius;
};
struct CameraRecord {
  std::uint32_t kind;
  std::array<float, 3> position, right, up, forward;
  float vertical_fov, half_height, aspect, lens_diameter, focus_distance;
};
constexpr std::uint32_t kHasNormals = 1, kHasUv0 = 2, kHasUv1 = 4, kHasColors = 8, kHasTangents = 16;

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

MaterialRecord record_of(const Material& m) {
  MaterialRecord r{};
  r.base_color = stored(m.base_color), r.specular_color = stored(m.specular_color);
  r.attenuation_color = stored(m.attenuation_color), r.sheen_color = stored(m.sheen_color);
  r.emission = stored(m.emission);
  r.metallic = m.metallic, r.roughness = m.roughness, r.specular = m.specular, r.ior = m.ior;
  r.transmission = m.transmission, r.attenuation_distance = m.attenuation_distance;
  r.clearcoat = m.clearcoat, r.clearcoat_roughness = m.clearcoat_roughness, r.sheen_roughness = m.sheen_roughness;
  r.anisotropy = m.anisotropy, r.anisotropy_rotation = m.anisotropy_rotation, r.normal_scale = m.normal_scale;
  r.alpha = m.alpha, r.alpha_cutoff = m.alpha_cutoff;
  r.has_volume = m.has_volume ? 1 : 0, r.emits_from_both_sides = m.emits_from_both_sides ? 1 : 0;
  r.alpha_mode = static_cast<std::uint32_t>(m.alpha_mode), r.is_switched_off = m.is_switched_off ? 1 : 0;
  r.unsimulated = m.unsimulated;
  const auto uses = texture_uses(m);
  for (std::size_t i = 0; i < uses.size(); ++i) r.textures[i] = *uses[i];
  return r;
}

Material material_of(const MaterialRecord& r) {
  Material m;
  m.base_color = spectrum(r.base_color), m.specular_color = spectrum(r.specular_color);
  m.attenuation_color = spectrum(r.attenuation_color), m.sheen_color = spectrum(r.sheen_color);
  m.emission = spectrum(r.emission);
  m.metallic = r.metallic, m.roughness = r.roughness, m.specular = r.specular, m.ior = r.ior;
  m.transmission = r.transmission, m.attenuation_distance = r.attenuation_distance;
  m.clearcoat = r.clearcoat, m.clearcoat_roughness = r.clearcoat_roughness, m.sheen_roughness = r.sheen_roughness;
  m.anisotropy = r.anisotropy, m.anisotropy_rotation = r.anisotropy_rotation, m.normal_scale = r.normal_scale;
  m.alpha = r.alpha, m.alpha_cutoff = r.alpha_cutoff;
  m.has_volume = r.has_volume != 0, m.emits_from_both_sides = r.emits_from_both_sides != 0;
  m.alpha_mode = Material::Alpha(r.alpha_mode), m.is_switched_off = r.is_switched_off != 0;
  m.unsimulated = r.unsimulated;
  const auto uses = texture_uses(m);
  for (std::size_t i = 0; i < uses.size(); ++i) *uses[i] = r.textures[i];
  return m;
}

std::vector<MaterialRecord> material_records(const Scene& scene) {
  std::vector<MaterialRecord> records;
  for (const Material& m : scene.materials) records.push_back(record_of(m));
  return records;
}

std::vector<MeshRecord> mesh_records(const Scene& scene) {
  std::vector<MeshRecord> records;
  for (const Mesh& m : scene.meshes) {
    const std::uint32_t arrays = (m.normals.empty() ? 0 : kHasNormals) | (m.uv[0].empty() ? 0 : kHasUv0) |
                                 (m.uv[1].empty() ? 0 : kHasUv1) | (m.colors.empty() ? 0 : kHasColors) |
                                 (m.tangents.empty() ? 0 : kHasTangents);
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
  add_concatenated<std::array<float, 4>>(file, "tangents", scene.meshes,
                                         [](const Mesh& m) -> auto& { return m.tangents; });
  add_concatenated<std::array<std::uint32_t, 3>>(file, "triangles", scene.meshes,
                                                 [](const Mesh& m) -> auto& { return m.triangles; });
}

void add_lights(FlatFileWriter& file, const Scene& scene) {
  std::vector<LightRecord> lights;
  for (const PunctualLight& l : scene.lights) {
    lights.push_back({static_cast<std::uint32_t>(l.kind), stored(l.position), stored(l.direction), stored(l.intensity),
                      l.cos_inner, l.cos_outer, l.photometry, stored(l.right)});
  }
  file.add("lights", lights);
  add_texts(file, "lights.names", names_of(scene.lights));
  std::vector<PhotometryRecord> photometries;
  for (const Photometry& p : scene.photometries) photometries.push_back({p.gamma.size(), p.c.size()});
  file.add("photometries", photometries);
  add_texts(file, "photometries.names", names_of(scene.photometries));
  add_concatenated<float>(file, "gamma", scene.photometries, [](const Photometry& p) -> auto& { return p.gamma; });
  add_concatenated<float>(file, "c", scene.photometries, [](const Photometry& p) -> auto& { return p.c; });
  add_concatenated<float>(file, "candela", scene.photometries, [](const Photometry& p) -> auto& { return p.candela; });
  const Environment& e = scene.environment;
  file.add_value("environment", EnvironmentRecord{e.width, e.height, stored(e.sun.direction), stored(e.sun.radiance),
                                                  e.sun.cos_radius});
  file.add("environment.map", e.radiance);
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
  std::vector<CameraRecord> cameras;
  for (const Camera& c : scene.cameras) {
    cameras.push_back({static_cast<std::uint32_t>(c.kind), stored(c.position), stored(c.right), stored(c.up),
                       stored(c.forward), c.vertical_fov, c.half_height, c.aspect, c.lens_diameter, c.focus_distance});
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
  return texels.fitted() ? Status() : damaged("texels do not fit the textures");
}

Status get_materials(const FlatFileReader& file, Scene& scene) {
  RADFARM_TRY(const auto records, file.get<MaterialRecord>("materials"));
  RADFARM_TRY(auto names, get_texts(file, "materials.names", records.size()));
  for (std::size_t i = 0; i < records.size(); ++i) {
    const MaterialRecord& r = records[i];
    if (r.alpha_mode > 2 || r.has_volume > 1 || r.emits_from_both_sides > 1 || r.is_switched_off > 1 ||
        r.unsimulated > 7) {
      return damaged("a material has an unknown mode");
    }
    scene.materials.push_back(material_of(r));
    scene.materials.back().name = std::move(names[i]);
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
  RADFARM_TRY(const auto all_tangents, (file.get<std::array<float, 4>>("tangents")));
  RADFARM_TRY(const auto all_triangles, (file.get<std::array<std::uint32_t, 3>>("triangles")));
  Pieces<Vec3> positions(all_positions);
  Pieces<Vec3> normals(all_normals);
  std::array<Pieces<Vec2>, 2> uvs = {Pieces<Vec2>(all_uv0), Pieces<Vec2>(all_uv1)};
  Pieces<std::array<float, 4>> colors(all_colors), tangents(all_tangents);
  Pieces<std::array<std::uint32_t, 3>> triangles(all_triangles);
  for (std::size_t i = 0; i < records.size(); ++i) {
    const MeshRecord& r = records[i];
    const auto length = [&](std::uint32_t bit) { return (r.arrays & bit) != 0 ? r.vertices : 0; };
    if (r.arrays > 31) return damaged("a mesh has unknown arrays");
    Mesh mesh;
    mesh.name = std::move(names[i]);
    mesh.material = r.material;
    mesh.positions = positions.next(r.vertices);
    mesh.normals = normals.next(length(kHasNormals));
    mesh.uv = {uvs[0].next(length(kHasUv0)), uvs[1].next(length(kHasUv1))};
    mesh.colors = colors.next(length(kHasColors));
    mesh.tangents = tangents.next(length(kHasTangents));
    mesh.triangles = triangles.next(r.triangles);
    scene.meshes.push_back(std::move(mesh));
  }
  const bool fitted = positions.fitted() && normals.fitted() && uvs[0].fitted() && uvs[1].fitted() &&
                      colors.fitted() && tangents.fitted() && triangles.fitted();
  return fitted ? Status() : damaged("arrays do not fit the meshes");
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

Status get_photometries(const FlatFileReader& file, Scene& scene) {
  RADFARM_TRY(const auto records, file.get<PhotometryRecord>("photometries"));
  RADFARM_TRY(auto names, get_texts(file, "photometries.names", records.size()));
  RADFARM_TRY(const auto all_gamma, file.get<float>("gamma"));
  RADFARM_TRY(const auto all_c, file.get<float>("c"));
  RADFARM_TRY(const auto all_candela, file.get<float>("candela"));
  Pieces<float> gamma(all_gamma), c(all_c), candela(all_candela);
  for (std::size_t i = 0; i < records.size(); ++i) {
    const PhotometryRecord& r = records[i];
    // Checked apart: their product must not overflow.
    if (r.gammas > all_gamma.size() || r.cs > all_c.size()) return damaged("a photometry does not fit its arrays");
    scene.photometries.push_back({std::move(names[i]), gamma.next(r.gammas), c.next(r.cs), candela.next(r.gammas * r.cs)});
  }
  const bool fitted = gamma.fitted() && c.fitted() && candela.fitted();
  return fitted ? Status() : damaged("arrays do not fit the photometries");
}

Status get_lights(const FlatFileReader& file, Scene& scene) {
  RADFARM_TRY(const auto lights, file.get<LightRecord>("lights"));
  RADFARM_TRY(auto names, get_texts(file, "lights.names", lights.size()));
  for (std::size_t i = 0; i < lights.size(); ++i) {
    const LightRecord& r = lights[i];
    if (r.kind > 2) return damaged("a light has an unknown kind");
    scene.lights.push_back({PunctualLight::Kind(r.kind), vector(r.position), vector(r.direction), spectrum(r.intensity),
                            r.cos_inner, r.cos_outer, std::move(names[i]), r.photometry, vector(r.right)});
  }
  RADFARM_TRY(const auto e, file.get_value<EnvironmentRecord>("environment"));
  RADFARM_TRY(auto map, file.copy<Spectrum>("environment.map"));
  scene.environment = {e.width, e.height, std::move(map),
                       {vector(e.sun_direction), e.sun_cos_radius, spectrum(e.sun_radiance)}};
  return {};
}

Status get_views(const FlatFileReader& file, Scene& scene) {
  RADFARM_TRY(const auto cameras, file.get<CameraRecord>("cameras"));
  RADFARM_TRY(auto names, get_texts(file, "cameras.names", cameras.size()));
  for (std::size_t i = 0; i < cameras.size(); ++i) {
    const CameraRecord& r = cameras[i];
    if (r.kind > 1) return damaged("a camera has an unknown kind");
    scene.cameras.push_back({std::move(names[i]), Camera::Kind(r.kind), vector(r.position), vector(r.right),
                             vector(r.up), vector(r.forward), r.vertical_fov, r.half_height, r.aspect,
                             r.lens_diameter, r.focus_distance});
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
  add_lights(file, scene);
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
  RADFARM_TRY_STATUS(get_photometries(file, scene));
  RADFARM_TRY_STATUS(get_lights(file, scene));
  RADFARM_TRY_STATUS(get_views(file, scene));
  RADFARM_TRY(const auto note_ends, file.get<std::uint64_t>("notes.ends"));
  RADFARM_TRY(scene.notes, get_texts(file, "notes", note_ends.size()));
  RADFARM_TRY_STATUS(validate(scene));
  return scene;
}

}  // namespace radfarm
