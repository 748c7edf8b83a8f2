#pragma once

#include <cstring>
#include <filesystem>
#include <fstream>
#include <string>
#include <string_view>
#include <vector>

#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include "base/file.h"
#include "scene/clean.h"
#include "scene/gltf.h"
#include "scene/load_scene.h"
#include "scene/recentre.h"
#include "scene/reference.h"
#include "scene/validate.h"

namespace radfarm::test {

using nlohmann::json;

inline std::string base64(std::string_view bytes) {
  constexpr std::string_view kDigits = "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
  std::string text;
  for (std::size_t i = 0; i < bytes.size(); i += 3) {
    std::uint32_t word = 0;
    for (std::size_t k = 0; k < 3; ++k) {
      word = (word << 8U) | (i + k < bytes.size() ? static_cast<unsigned char>(bytes[i + k]) : 0U);
    }
    for (std::size_t k = 0; k < 4; ++k) text += i + k > bytes.size() ? '=' : kDigits[(word >> (18 - 6 * k)) & 63U];
  }
  return text;
}

template <typename T>
std::string bytes_of(const std::vector<T>& values) {
  std::string bytes(values.size() * sizeof(T), '\0');
  std::memcpy(bytes.data(), values.data(), bytes.size());
  return bytes;
}

/// A glTF document under construction.
struct GltfBuilder {
  json document = {{"asset", {{"version", "2.0"}}}};

  /// Adds the values as buffer, view and accessor; returns the accessor.
  template <typename T>
  std::size_t add(const std::vector<T>& values, int component_type, const std::string& type, std::size_t count) {
    const std::string bytes = bytes_of(values);
    document["buffers"].push_back(
        {{"byteLength", bytes.size()}, {"uri", "data:application/octet-stream;base64," + base64(bytes)}});
    document["bufferViews"].push_back({{"buffer", document["buffers"].size() - 1}, {"byteLength", bytes.size()}});
    document["accessors"].push_back({{"bufferView", document["bufferViews"].size() - 1},
                                     {"componentType", component_type},
                                     {"type", type},
                                     {"count", count}});
    return document["accessors"].size() - 1;
  }
  std::size_t add_vec3(const std::vector<float>& values) { return add(values, 5126, "VEC3", values.size() / 3); }
};

/// One triangle (0,0,0) (1,0,0) (0,1,0), indexed, on node 0, with material 0.
inline GltfBuilder triangle() {
  GltfBuilder gltf;
  gltf.add_vec3({0, 0, 0, 1, 0, 0, 0, 1, 0});
  gltf.add<std::uint16_t>({0, 1, 2}, 5123, "SCALAR", 3);
  gltf.document["materials"] = {{{"name", "paint"}}};
  gltf.document["meshes"] = {
      {{"primitives", {{{"attributes", {{"POSITION", 0}}}, {"indices", 1}, {"material", 0}}}}}};
  gltf.document["nodes"] = {{{"mesh", 0}}};
  gltf.document["scenes"] = {{{"nodes", {0}}}};
  gltf.document["scene"] = 0;
  return gltf;
}

/// As load_scene does, from memory, in a folder that does not exist.
inline Result<Scene> load(const json& document) {
  RADFARM_TRY(GltfSource source, split_gltf(document.dump(), "/nonexistent"));
  RADFARM_TRY(DraftScene draft, read_gltf(std::move(source)));
  Scene scene = recentre(std::move(draft));
  clean_scene(scene);
  RADFARM_TRY_STATUS(validate(scene));
  return scene;
}

/// The error's message, or "loads".
inline std::string refusal(const json& document) {
  const Result<Scene> scene = load(document);
  return scene ? "loads" : scene.error().message;
}

/// A vertex of an instance's mesh in the file's coordinates.
inline Vec3d placed(const Scene& scene, std::size_t instance, std::size_t vertex) {
  const Instance& i = scene.instances.at(instance);
  return to_double(scene.meshes[i.mesh].positions.at(vertex)) * Matrix4d(i.to_world) + scene.origin;
}

/// Files in a folder that goes away with the test.
class Folder {
 public:
  Folder() : directory_(std::move(*TemporaryDirectory::create("radfarm-scene"))) {}
  std::filesystem::path write(const std::string& name, std::string_view text) const {
    const std::filesystem::path path = directory_.path() / name;
    std::filesystem::create_directories(path.parent_path());
    std::ofstream(path, std::ios::binary) << text;
    return path;
  }

 private:
  TemporaryDirectory directory_;
};

/// A 2 x 1 PNG: red (opaque), then green.
inline std::string tiny_png() {
  return *decode_data_uri(
      "data:image/png;base64,iVBORw0KGgoAAAANSUhEUgAAAAIAAAABCAIAAAB7QOjdAAAAD0lEQVR4nGP4z8DA8J8BAAf/Af8B"
      "f4mnAAAAAElFTkSuQmCC");
}

}  // namespace radfarm::test
