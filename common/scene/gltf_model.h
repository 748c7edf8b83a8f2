#pragma once

#include <string>
#include <vector>

#include <tiny_gltf.h>

#include "base/status.h"
#include "scene/gltf_source.h"

namespace radfarm {

/// A checked glTF document with its buffers in memory. tinygltf maps the JSON to structs; it sees neither buffers nor
/// images and opens no file: those are read here, within the scene's folder and limits.h.
struct GltfModel {
  struct Image {
    std::string uri;        // either this
    int buffer_view = -1;   // or that, or neither: a fault only where a material uses the image
  };
  tinygltf::Model document;
  nlohmann::json materials;  // as in the file: tinygltf knows only half of what they may say
  std::vector<std::string> buffers;
  std::vector<Image> images;
  std::filesystem::path folder;
};

/// Checks (gltf_check.h), reads the buffers, unpacks compressed geometry, and parses.
Result<GltfModel> parse_gltf(GltfSource source);

/// The encoded bytes of an image. Requires: a model from parse_gltf and an image it has.
Result<std::string> image_bytes(const GltfModel& model, std::size_t image);

}  // namespace radfarm
