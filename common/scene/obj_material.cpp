#include "scene/obj_material.h"

#include <algorithm>
#include <exception>
#include <sstream>
#include <tuple>

#include <tiny_obj_loader.h>

#include "base/file.h"
#include "scene/draft_scene.h"
#include "scene/image_file.h"
#include "scene/limits.h"
#include "scene/reference.h"

namespace radfarm {
namespace {

SpectrumD spectrum(const tinyobj::real_t (&values)[3]) { return {values[0], values[1], values[2]}; }

Result<std::vector<tinyobj::material_t>> parse_mtl(const std::string& text) {
  std::vector<tinyobj::material_t> materials;
  std::map<std::string, int> names;
  std::istringstream stream(text);
  std::string warnings;
  std::string errors;
  try {
    tinyobj::LoadMtl(&names, &materials, &stream, &warnings, &errors);
  } catch (const std::exception& exception) {
    errors += exception.what();
  }
  if (!errors.empty())
    return fail(Code::kInvalidArgument, "is not an MTL file: " + errors.substr(0, errors.find('\n')));
  // tinyobj begins with a nameless material when the file has none.
  std::erase_if(materials, [](const tinyobj::material_t& material) { return material.name.empty(); });
  return materials;
}

std::size_t line_of_material(const std::string& text, const std::string& name) {
  std::size_t found = 0;
  for_each_line(text, [&](std::size_t number, std::string_view line) {
    if (found == 0 && take_word(line) == "newmtl" && trimmed(line) == trimmed(name)) found = number;
  });
  return found;
}

/// Reads one MTL file into the scene.
class LibraryReader {
 public:
  LibraryReader(const std::filesystem::path& folder, Scene& scene) : folder_(folder), scene_(scene) {}

  /// False when there is no such file.
  Result<bool> read(const std::string& name, ObjMaterials& materials) {
    RADFARM_TRY(const std::filesystem::path path, path_of_name(name));
    const Result<std::string> text = read_file(folder_ / path, limits::kSceneFileBytes);
    if (!text && text.error().code == Code::kNotFound) return false;
    if (!text) return tl::unexpected(text.error());
    RADFARM_TRY_STATUS(add_materials(*text, path, materials));
    return true;
  }

 private:
  Status add_materials(const std::string& text, const std::filesystem::path& path, ObjMaterials& materials) {
    if (text.find('\0') != std::string::npos)
      return fail(Code::kInvalidArgument, path.string() + ": is not plain text");
    const auto parsed = parse_mtl(text);
    if (!parsed) return annotate(parsed.error(), path.string());
    for (const tinyobj::material_t& source : *parsed) {
      const auto material = read_material(source, path.parent_path());
      if (!material) {
        return fail(material.error().code, path.string() + ": line " +
                                               std::to_string(line_of_material(text, source.name)) + ": material '" +
                                               source.name + "': " + material.error().message);
      }
      materials.try_emplace(std::string(trimmed(source.name)), static_cast<std::uint32_t>(scene_.materials.size()));
      scene_.materials.push_back(*material);
    }
    return {};
  }

  static Status check_range(const std::string& key, const SpectrumD& value, double highest) {
    if (is_finite(value) && min_component(value) >= 0 && max_component(value) <= highest) return {};
    std::ostringstream message;
    message << key << " is " << value.r << " " << value.g << " " << value.b << ", must be in [0, " << highest << "]";
    return fail(Code::kInvalidArgument, message.str());
  }

  Result<Material> read_material(const tinyobj::material_t& source, const std::filesystem::path& folder) {
    const SpectrumD diffuse = spectrum(source.diffuse);
    const SpectrumD specular = spectrum(source.specular);
    RADFARM_TRY_STATUS(check_range("Kd", diffuse, 1));
    RADFARM_TRY_STATUS(check_range("Ks", specular, limits::kLight));
    RADFARM_TRY_STATUS(check_range("Ke", spectrum(source.emission), limits::kLight));
    RADFARM_TRY_STATUS(check_range("d", SpectrumD(source.dissolve), 1));
    Material material;
    material.name = std::string(trimmed(source.name));
    // Gloss is folded into diffuse; a sum above 1 is scaled as a whole, which keeps its hue.
    const SpectrumD sum = diffuse + specular;
    material.reflectance = Spectrum(sum / std::max(1.0, max_component(sum)));
    material.folds_gloss_into_diffuse = !is_black(specular);
    material.emission = Spectrum(spectrum(source.emission));
    material.alpha = static_cast<float>(source.dissolve);
    if (material.alpha < 1) material.alpha_mode = Material::Alpha::kBlend;
    if (!source.diffuse_texname.empty()) {
      RADFARM_TRY(material.reflectance_texture,
                  read_texture(folder, "map_Kd", source.diffuse_texname, source.diffuse_texopt));
    }
    if (!source.emissive_texname.empty() && !is_black(material.emission)) {
      RADFARM_TRY(material.emission_texture,
                  read_texture(folder, "map_Ke", source.emissive_texname, source.emissive_texopt));
    }
    if (!source.alpha_texname.empty()) add_note(scene_, "Transparency textures of OBJ materials (map_d) are ignored.");
    return material;
  }

  Result<std::uint32_t> read_texture(const std::filesystem::path& folder, const std::string& key,
                                     const std::string& name, const tinyobj::texture_option_t& options) {
    RADFARM_TRY(const std::filesystem::path path, path_of_name((folder / name).generic_string()));
    const bool is_srgb = options.colorspace != "linear";
    const auto [known, is_new] = textures_.try_emplace({path.string(), options.clamp, is_srgb}, 0U);
    if (!is_new) return known->second;
    const Result<std::string> bytes = read_file(folder_ / path, limits::kTextureFileBytes);
    if (!bytes) return annotate(bytes.error(), key);
    Result<Texture> texture = decode_image(*bytes);
    if (!texture) return annotate(texture.error(), key + " " + path.string());
    texture->is_srgb = is_srgb;
    texture->wrap_u = texture->wrap_v = options.clamp ? Texture::Wrap::kClamp : Texture::Wrap::kRepeat;
    if (options.scale[0] != 1 || options.scale[1] != 1 || options.origin_offset[0] != 0 ||
        options.origin_offset[1] != 0) {
      add_note(scene_, "Texture offsets and scales of OBJ materials (-o, -s) are ignored.");
    }
    texels_ += texture->texels.size();
    if (texels_ > limits::kTextureTexels)
      return fail(Code::kResourceExhausted, key + ": textures have too many pixels");
    known->second = static_cast<std::uint32_t>(scene_.textures.size());
    scene_.textures.push_back(std::move(*texture));
    return known->second;
  }

  const std::filesystem::path& folder_;
  Scene& scene_;
  std::map<std::tuple<std::string, bool, bool>, std::uint32_t> textures_;
  std::size_t texels_ = 0;
};

}  // namespace

std::vector<std::string> library_names(const std::filesystem::path& folder, const std::string& line) {
  std::error_code ignored;
  const auto whole = path_of_name(line);
  if (line.find_first_of(" \t") == std::string::npos) return {line};
  if (whole && std::filesystem::exists(folder / *whole, ignored)) return {line};
  std::vector<std::string> names;
  std::string_view rest = line;
  for (std::string_view word = take_word(rest); !word.empty(); word = take_word(rest)) names.emplace_back(word);
  return names;
}

std::vector<std::string> texture_names(const std::string& mtl_text) {
  std::vector<std::string> names;
  const auto parsed = parse_mtl(mtl_text);
  if (!parsed) return names;
  for (const tinyobj::material_t& material : *parsed) {
    for (const std::string& name : {material.diffuse_texname, material.emissive_texname}) {
      if (!name.empty() && std::find(names.begin(), names.end(), name) == names.end()) names.push_back(name);
    }
  }
  return names;
}

Result<ObjMaterials> read_obj_materials(const std::filesystem::path& folder, const ObjScan& scan, Scene& scene) {
  ObjMaterials materials;
  LibraryReader reader(folder, scene);
  for (const ObjScan::Library& library : scan.libraries) {
    for (const std::string& name : library_names(folder, library.name)) {
      const std::string line = std::to_string(library.line);
      const Result<bool> is_there = reader.read(name, materials);
      if (!is_there) return annotate(is_there.error(), "line " + line + ": mtllib " + name);
      if (!*is_there) add_note(scene, "Line " + line + ": material library '" + name + "' does not exist.");
    }
  }
  Material otherwise;
  otherwise.name = "no material";
  scene.materials.push_back(otherwise);
  return materials;
}

}  // namespace radfarm
