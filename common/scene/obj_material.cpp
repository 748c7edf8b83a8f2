#include "scene/obj_material.h"

#include <algorithm>
#include <exception>
#include <set>
#include <sstream>

#include <tiny_obj_loader.h>

#include "base/file.h"
#include "scene/draft_scene.h"
#include "scene/limits.h"
#include "scene/obj_layers.h"
#include "scene/obj_texture.h"
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

using MtlKeys = std::set<std::string>;

/// Which keys each material gives: tinyobj does not tell a default from a value.
std::map<std::string, MtlKeys> keys_given(const std::string& text) {
  std::map<std::string, MtlKeys> keys;
  std::string material;
  for_each_line(text, [&](std::size_t, std::string_view line) {
    const std::string key(take_word(line));
    if (key == "newmtl") material = std::string(trimmed(line));
    if (key == "illum" || key == "Tf") keys[material].insert(key);
  });
  return keys;
}

/// Reads one MTL file into the scene.
class LibraryReader {
 public:
  LibraryReader(const std::filesystem::path& folder, Scene& scene)
      : folder_(folder), scene_(scene), textures_(folder, scene) {}

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
    std::map<std::string, MtlKeys> keys = keys_given(text);
    for (const tinyobj::material_t& source : *parsed) {
      const auto material = read_material(source, keys[std::string(trimmed(source.name))], path.parent_path());
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

  Result<Material> read_material(const tinyobj::material_t& source, const MtlKeys& keys,
                                 const std::filesystem::path& folder) {
    RADFARM_TRY(const ObjOptics optics, optics_of(source, keys));
    RADFARM_TRY_STATUS(check_range("Ke", spectrum(source.emission), limits::kLight));
    RADFARM_TRY_STATUS(check_range("d", SpectrumD(source.dissolve), 1));
    Material material;
    material.name = std::string(trimmed(source.name));
    set_obj_layers(optics, material);
    material.emission = Spectrum(spectrum(source.emission));
    const bool is_glass = is_obj_glass(optics.illumination);
    // What is seen through glass is the glass's doing; elsewhere `d` is how much of the surface is there.
    if (!is_glass) material.alpha = static_cast<float>(source.dissolve);
    if (material.alpha < 1) material.alpha_mode = Material::Alpha::kBlend;
    RADFARM_TRY_STATUS(read_textures(source, is_glass, folder, material));
    note_what_is_ignored(source);
    return material;
  }

  static Result<ObjOptics> optics_of(const tinyobj::material_t& source, const MtlKeys& keys) {
    ObjOptics optics;
    optics.diffuse = spectrum(source.diffuse);
    optics.specular = spectrum(source.specular);
    if (keys.contains("Tf")) optics.filter = spectrum(source.transmittance);
    if (keys.contains("illum")) optics.illumination = source.illum;
    optics.shininess = source.shininess;
    optics.ior = source.ior;
    RADFARM_TRY_STATUS(check_range("Kd", optics.diffuse, 1));
    RADFARM_TRY_STATUS(check_range("Ks", optics.specular, limits::kLight));
    RADFARM_TRY_STATUS(check_range("Tf", optics.filter, limits::kLight));
    RADFARM_TRY_STATUS(check_range("Ns", SpectrumD(std::max(optics.shininess, 0.0)), limits::kLight));
    RADFARM_TRY_STATUS(check_range("Ni", SpectrumD(optics.ior), limits::kLight));
    return optics;
  }

  Status read_textures(const tinyobj::material_t& source, bool is_glass, const std::filesystem::path& folder,
                       Material& material) {
    if (material.metallic > 0) {
      RADFARM_TRY(material.base_texture, color("map_Ks", source.specular_texname, source.specular_texopt, folder));
    } else if (!is_glass && !(source.diffuse_texname.empty() && source.alpha_texname.empty())) {
      RADFARM_TRY(material.base_texture, textures_.color_and_alpha(folder, source));
      if (!source.alpha_texname.empty()) material.alpha_mode = Material::Alpha::kBlend;
    }
    if (material.specular > 0 && !is_glass) {
      RADFARM_TRY(material.specular_color_texture,
                  color("map_Ks", source.specular_texname, source.specular_texopt, folder));
    }
    if (!is_black(material.emission)) {
      RADFARM_TRY(material.emission_texture, color("map_Ke", source.emissive_texname, source.emissive_texopt, folder));
    }
    if (!source.normal_texname.empty() || !source.bump_texname.empty()) {
      RADFARM_TRY(material.normal_texture, textures_.normals(folder, source));
    }
    return {};
  }

  Result<TextureUse> color(const std::string& key, const std::string& name, const tinyobj::texture_option_t& options,
                           const std::filesystem::path& folder) {
    if (name.empty()) return TextureUse();
    return textures_.color(folder, key, name, options);
  }

  void note_what_is_ignored(const tinyobj::material_t& source) {
    if (!source.specular_highlight_texname.empty()) add_note(scene_, "Gloss textures (map_Ns) are ignored.");
    if (!source.displacement_texname.empty()) add_note(scene_, "Displacement textures (disp) are ignored.");
    if (!source.reflection_texname.empty()) add_note(scene_, "Reflection maps (refl) are ignored.");
  }

  const std::filesystem::path& folder_;
  Scene& scene_;
  ObjTextureReader textures_;
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
    for (const std::string& name :
         {material.diffuse_texname, material.emissive_texname, material.specular_texname, material.alpha_texname,
          material.bump_texname, material.normal_texname}) {
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
