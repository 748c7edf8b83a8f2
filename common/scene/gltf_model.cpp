#include "scene/gltf_model.h"

#include <algorithm>
#include <exception>

#include "scene/gltf_check.h"
#include "scene/gltf_draco.h"
#include "scene/gltf_meshopt.h"
#include "scene/limits.h"
#include "scene/reference.h"

namespace radfarm {
namespace {

/// The bytes of one buffer, exactly as many as it declares; none of one that only stands for compressed views.
Result<std::string> buffer_bytes(const GltfSource& source, const nlohmann::json& buffer, std::size_t index) {
  const auto declared = buffer.at("byteLength").get<std::size_t>();
  const std::string pointer = "/buffers/" + std::to_string(index);
  std::string bytes;
  if (buffer.contains("uri")) {
    auto read = read_uri(source.folder, buffer.at("uri").get<std::string>(), limits::kSceneFileBytes);
    if (!read) return annotate(read.error(), pointer + "/uri");
    bytes = std::move(*read);
  } else if (is_meshopt_fallback(buffer)) {
    return bytes;
  } else if (index == 0 && source.is_binary) {
    bytes = source.binary;
  } else {
    return fail(Code::kInvalidArgument, pointer + ": has neither a URI nor a BIN chunk");
  }
  if (bytes.size() < declared) {
    return fail(Code::kInvalidArgument, pointer + "/byteLength: is " + std::to_string(declared) + ", the data has " +
                                            std::to_string(bytes.size()) + " bytes");
  }
  bytes.resize(declared);
  return bytes;
}

std::vector<GltfModel::Image> images_of(const nlohmann::json& json) {
  std::vector<GltfModel::Image> images;
  if (!json.contains("images")) return images;
  for (const nlohmann::json& image : json.at("images")) {
    images.push_back({image.value("uri", std::string()), image.value("bufferView", -1)});
  }
  return images;
}

/// tinygltf's message as one line.
std::string one_line(std::string text) {
  while (!text.empty() && text.back() == '\n') text.pop_back();
  std::replace(text.begin(), text.end(), '\n', ' ');
  return text;
}

Status map_document(nlohmann::json json, tinygltf::Model& document) {
  for (const char* key : {"buffers", "images"}) json.erase(key);
  std::string errors;
  std::string warnings;
  try {
    const std::string text = json.dump();
    tinygltf::TinyGLTF loader;
    loader.SetFsCallbacks({nullptr, nullptr, nullptr, nullptr, nullptr});
    if (loader.LoadASCIIFromString(&document, &errors, &warnings, text.data(), static_cast<unsigned>(text.size()),
                                   "")) {
      return {};
    }
  } catch (const std::exception& exception) {
    errors += exception.what();
  }
  return fail(Code::kInvalidArgument, "is not glTF 2.0: " + one_line(errors));
}

}  // namespace

Result<GltfModel> parse_gltf(GltfSource source) {
  RADFARM_TRY_STATUS(check_gltf(source.json));
  GltfModel model;
  model.folder = source.folder;
  model.images = images_of(source.json);
  if (source.json.contains("buffers")) {
    for (const nlohmann::json& buffer : source.json.at("buffers")) {
      RADFARM_TRY(std::string bytes, buffer_bytes(source, buffer, model.buffers.size()));
      model.buffers.push_back(std::move(bytes));
    }
  }
  RADFARM_TRY_STATUS(unpack_gltf_meshopt(source.json, model.buffers));
  RADFARM_TRY_STATUS(unpack_gltf_draco(source.json, model.buffers));
  model.materials = source.json.value("materials", nlohmann::json::array());
  RADFARM_TRY_STATUS(map_document(std::move(source.json), model.document));
  return model;
}

Result<std::string> image_bytes(const GltfModel& model, std::size_t image) {
  const GltfModel::Image& source = model.images[image];
  if (!source.uri.empty()) return read_uri(model.folder, source.uri, limits::kTextureFileBytes);
  if (source.buffer_view < 0) return fail(Code::kInvalidArgument, "has neither a URI nor a bufferView");
  const tinygltf::BufferView& view = model.document.bufferViews[static_cast<std::size_t>(source.buffer_view)];
  return model.buffers[static_cast<std::size_t>(view.buffer)].substr(view.byteOffset, view.byteLength);
}

}  // namespace radfarm
