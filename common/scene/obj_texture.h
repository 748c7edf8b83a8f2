#pragma once

#include <cstdint>
#include <filesystem>
#include <functional>
#include <map>
#include <string>

#include <tiny_obj_loader.h>

#include "base/status.h"
#include "scene/scene.h"

namespace radfarm {

/// Reads the textures of MTL materials into the scene, each once for each way it is used. All errors begin with the
/// MTL key. `folder` is the MTL file's, relative to the scene's.
class ObjTextureReader {
 public:
  ObjTextureReader(const std::filesystem::path& scene_folder, Scene& scene)
      : scene_folder_(scene_folder), scene_(scene) {}

  /// map_Kd, map_Ks, map_Ke: sRGB colour, unless "-colorspace linear" says otherwise.
  Result<TextureUse> color(const std::filesystem::path& folder, const std::string& key, const std::string& name,
                           const tinyobj::texture_option_t& options);
  /// map_Kd with map_d as its alpha, or a white texture of that alpha where there is no map_Kd. Where the two do not
  /// fit texel by texel, map_d is left out with a note.
  Result<TextureUse> color_and_alpha(const std::filesystem::path& folder, const tinyobj::material_t& material);
  /// `norm` as it is; else map_Bump as a normal map (height_map.h).
  Result<TextureUse> normals(const std::filesystem::path& folder, const tinyobj::material_t& material);

 private:
  using Change = std::function<Status(Texture&)>;
  /// The file after `change`, kept under its name and `role`.
  Result<TextureUse> read(const std::filesystem::path& folder, const std::string& key, const std::string& name,
                          const tinyobj::texture_option_t& options, const std::string& role, const Change& change);
  Result<Texture> decode(const std::filesystem::path& path, const std::string& key);

  const std::filesystem::path& scene_folder_;
  Scene& scene_;
  std::map<std::string, std::uint32_t> textures_;
  std::size_t texels_ = 0;
};

}  // namespace radfarm
