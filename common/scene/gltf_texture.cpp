#include "scene/gltf_texture.h"

#include <cmath>

#include "scene/gltf_values.h"
#include "scene/image_file.h"
#include "scene/limits.h"

namespace radfarm {
namespace {

Texture::Wrap wrap_mode(int wrap) {
  if (wrap == TINYGLTF_TEXTURE_WRAP_CLAMP_TO_EDGE) return Texture::Wrap::kClamp;
  return wrap == TINYGLTF_TEXTURE_WRAP_MIRRORED_REPEAT ? Texture::Wrap::kMirror : Texture::Wrap::kRepeat;
}

/// KHR_texture_transform as an affine map: scale, then turn, then move.
std::array<float, 6> transform_map(const nlohmann::json& transform) {
  const double sx = gltf_element(transform, "scale", 0, 1);
  const double sy = gltf_element(transform, "scale", 1, 1);
  const double rotation = gltf_number(transform, "rotation", 0);
  // v points down, so a counter-clockwise turn as seen takes (1, 0) to (cos, -sin).
  const double c = std::cos(rotation);
  const double s = std::sin(rotation);
  const double map[6] = {c * sx,  s * sy, gltf_element(transform, "offset", 0, 0),
                         -s * sx, c * sy, gltf_element(transform, "offset", 1, 0)};
  std::array<float, 6> result{};
  for (std::size_t i = 0; i < result.size(); ++i) result[i] = static_cast<float>(map[i]);
  return result;
}

/// Why a glTF texture without an image that we read has none.
std::string missing_source(const tinygltf::Texture& texture) {
  if (texture.extensions.empty()) return "has no PNG or JPEG source";
  return "has no PNG or JPEG source but " + texture.extensions.begin()->first + ", which is not supported";
}

}  // namespace

Result<TextureUse> GltfTextureReader::use(const nlohmann::json& object, const std::string& key, bool is_srgb) {
  TextureUse use;
  const nlohmann::json& info = gltf_object(object, key);
  if (!info.contains("index")) return use;
  RADFARM_TRY(use.texture, read(info.at("index").get<std::size_t>(), is_srgb));
  const nlohmann::json& transform = gltf_extension(info, "KHR_texture_transform");
  const double set = gltf_number(transform, "texCoord", gltf_number(info, "texCoord", 0));
  use.uv_set = static_cast<std::uint32_t>(set);
  use.map = transform_map(transform);
  return use;
}

Result<std::uint32_t> GltfTextureReader::read(std::size_t index, bool is_srgb) {
  const tinygltf::Texture& texture = model_.document.textures.at(index);
  if (texture.source < 0) {
    return fail(Code::kUnimplemented, "/textures/" + std::to_string(index) + ": " + missing_source(texture));
  }
  auto wrap_u = Texture::Wrap::kRepeat;
  auto wrap_v = Texture::Wrap::kRepeat;
  if (texture.sampler >= 0) {
    const tinygltf::Sampler& sampler = model_.document.samplers.at(static_cast<std::size_t>(texture.sampler));
    wrap_u = wrap_mode(sampler.wrapS);
    wrap_v = wrap_mode(sampler.wrapT);
  }
  const auto [known, is_new] = textures_.try_emplace({texture.source, wrap_u, wrap_v, is_srgb}, 0);
  if (is_new) {
    RADFARM_TRY(Texture decoded, decode(static_cast<std::size_t>(texture.source)));
    decoded.wrap_u = wrap_u;
    decoded.wrap_v = wrap_v;
    decoded.is_srgb = is_srgb;
    known->second = static_cast<std::uint32_t>(scene_.textures.size());
    scene_.textures.push_back(std::move(decoded));
  }
  return known->second;
}

Result<Texture> GltfTextureReader::decode(std::size_t image) {
  const std::string pointer = "/images/" + std::to_string(image);
  const Result<std::string> bytes = image_bytes(model_, image);
  if (!bytes) return annotate(bytes.error(), pointer);
  Result<Texture> texture = decode_image(*bytes);
  if (!texture) return annotate(texture.error(), pointer);
  texels_ += texture->texels.size();
  if (texels_ > limits::kTextureTexels) {
    return fail(Code::kResourceExhausted,
                pointer + ": textures have more than " + std::to_string(limits::kTextureTexels) + " pixels together");
  }
  return texture;
}

}  // namespace radfarm
