#pragma once

#include <cstdint>
#include <map>
#include <string>
#include <tuple>

#include <nlohmann/json.hpp>

#include "scene/gltf_model.h"
#include "scene/scene.h"

namespace radfarm {

/// Reads the textures that materials use into the scene, each image once for each way it is looked up: its wrap modes,
/// and whether its colours are sRGB (an image used as colour and as data is stored twice).
class GltfTextureReader {
 public:
  GltfTextureReader(const GltfModel& model, Scene& scene) : model_(model), scene_(scene) {}

  /// The use that object[key], a glTF textureInfo, describes; none where it is missing. `uv_set` of the result is the
  /// file's: the n of TEXCOORD_n (KHR_texture_transform may replace it), not yet 0 or 1.
  Result<TextureUse> use(const nlohmann::json& object, const std::string& key, bool is_srgb);

 private:
  Result<std::uint32_t> read(std::size_t texture, bool is_srgb);
  Result<Texture> decode(std::size_t image);

  const GltfModel& model_;
  Scene& scene_;
  std::map<std::tuple<int, Texture::Wrap, Texture::Wrap, bool>, std::uint32_t> textures_;
  std::size_t texels_ = 0;
};

}  // namespace radfarm
