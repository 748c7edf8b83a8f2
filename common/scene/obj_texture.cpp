#include "scene/obj_texture.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <vector>

#include "base/file.h"
#include "scene/draft_scene.h"
#include "scene/height_map.h"
#include "scene/image_file.h"
#include "scene/limits.h"
#include "scene/reference.h"

namespace radfarm {
namespace {

/// u' = s u + o for coordinates that count v upwards, as MTL's do; ours are v = 1 - v_up.
std::array<float, 6> option_map(const tinyobj::texture_option_t& options) {
  const double su = options.scale[0];
  const double sv = options.scale[1];
  return {static_cast<float>(su),
          0,
          static_cast<float>(options.origin_offset[0]),
          0,
          static_cast<float>(sv),
          static_cast<float>(1 - sv - options.origin_offset[1])};
}

/// A cut-out's alpha: its alpha channel if it has one, else how bright it is.
std::vector<std::uint8_t> alpha_of(const Texture& mask) {
  const bool has_alpha = std::any_of(mask.texels.begin(), mask.texels.end(), [](const auto& t) { return t[3] < 255; });
  std::vector<std::uint8_t> alpha;
  alpha.reserve(mask.texels.size());
  for (const auto& texel : mask.texels) {
    const double luminance = 0.2126 * texel[0] + 0.7152 * texel[1] + 0.0722 * texel[2];
    alpha.push_back(has_alpha ? texel[3] : static_cast<std::uint8_t>(luminance + 0.5));
  }
  return alpha;
}

bool is_finite(const tinyobj::texture_option_t& options) {
  const auto fits = [](double value) { return std::abs(value) < limits::kCoordinate; };
  return fits(options.scale[0]) && fits(options.scale[1]) && fits(options.origin_offset[0]) &&
         fits(options.origin_offset[1]) && fits(options.bump_multiplier);
}

}  // namespace

Result<TextureUse> ObjTextureReader::color(const std::filesystem::path& folder, const std::string& key,
                                           const std::string& name, const tinyobj::texture_option_t& options) {
  return read(folder, key, name, options, "color", [](Texture&) { return Status(); });
}

Result<TextureUse> ObjTextureReader::color_and_alpha(const std::filesystem::path& folder,
                                                     const tinyobj::material_t& material) {
  const std::string& mask_name = material.alpha_texname;
  if (mask_name.empty()) return color(folder, "map_Kd", material.diffuse_texname, material.diffuse_texopt);
  const bool is_alone = material.diffuse_texname.empty();
  const auto put_alpha = [&](Texture& texture) -> Status {
    RADFARM_TRY(const std::filesystem::path path, path_of_name((folder / mask_name).generic_string()));
    RADFARM_TRY(const Texture mask, decode(path, "map_d"));
    const bool fits = mask.width == texture.width && mask.height == texture.height &&
                      (is_alone || option_map(material.alpha_texopt) == option_map(material.diffuse_texopt));
    if (!fits) add_note(scene_, "Cut-outs (map_d) of another size or place than their map_Kd are ignored.");
    const std::vector<std::uint8_t> alpha = fits ? alpha_of(mask) : std::vector<std::uint8_t>();
    for (std::size_t i = 0; i < texture.texels.size(); ++i) {
      if (is_alone) texture.texels[i] = {255, 255, 255, 255};
      texture.texels[i][3] = fits ? alpha[i] : 255;
    }
    return {};
  };
  const std::string role = (is_alone ? "only alpha of " : "alpha of ") + (folder / mask_name).generic_string();
  if (is_alone) return read(folder, "map_d", mask_name, material.alpha_texopt, role, put_alpha);
  return read(folder, "map_Kd", material.diffuse_texname, material.diffuse_texopt, role, put_alpha);
}

Result<TextureUse> ObjTextureReader::normals(const std::filesystem::path& folder, const tinyobj::material_t& material) {
  if (!material.normal_texname.empty()) {
    return read(folder, "norm", material.normal_texname, material.normal_texopt, "normals", [](Texture& texture) {
      texture.is_srgb = false;
      return Status();
    });
  }
  const double scale = material.bump_texopt.bump_multiplier;
  const auto convert = [&](Texture& texture) -> Status {
    if (looks_like_normal_map(texture)) {
      texture.is_srgb = false;
      add_note(scene_, "Bump maps (map_Bump) that hold normals, not heights, are used as normal maps.");
    } else {
      texture = normal_map_of_heights(texture, scale);
    }
    return {};
  };
  return read(folder, "map_Bump", material.bump_texname, material.bump_texopt, "heights " + std::to_string(scale),
              convert);
}

Result<TextureUse> ObjTextureReader::read(const std::filesystem::path& folder, const std::string& key,
                                          const std::string& name, const tinyobj::texture_option_t& options,
                                          const std::string& role, const Change& change) {
  if (!is_finite(options)) return fail(Code::kInvalidArgument, key + ": an option is not a finite number");
  RADFARM_TRY(const std::filesystem::path path, path_of_name((folder / name).generic_string()));
  const bool is_srgb = options.colorspace != "linear";
  const std::string use_of =
      path.string() + "\n" + role + (options.clamp ? "\nclamped" : "") + (is_srgb ? "" : "\nlinear");
  TextureUse use;
  use.map = option_map(options);
  if (const auto known = textures_.find(use_of); known != textures_.end()) {
    use.texture = known->second;
    return use;
  }
  RADFARM_TRY(Texture texture, decode(path, key));
  texture.is_srgb = is_srgb;
  texture.wrap_u = texture.wrap_v = options.clamp ? Texture::Wrap::kClamp : Texture::Wrap::kRepeat;
  RADFARM_TRY_STATUS(change(texture));
  use.texture = static_cast<std::uint32_t>(scene_.textures.size());
  scene_.textures.push_back(std::move(texture));
  textures_.emplace(use_of, use.texture);
  return use;
}

Result<Texture> ObjTextureReader::decode(const std::filesystem::path& path, const std::string& key) {
  const Result<std::string> bytes = read_file(scene_folder_ / path, limits::kTextureFileBytes);
  if (!bytes) return annotate(bytes.error(), key);
  Result<Texture> texture = decode_image(*bytes);
  if (!texture) return annotate(texture.error(), key + " " + path.string());
  texels_ += texture->texels.size();
  if (texels_ > limits::kTextureTexels) return fail(Code::kResourceExhausted, key + ": textures have too many pixels");
  return texture;
}

}  // namespace radfarm
