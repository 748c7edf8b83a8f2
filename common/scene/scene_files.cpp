#include "scene/scene_files.h"

#include <algorithm>
#include <cctype>
#include <string>

#include "base/file.h"
#include "scene/gltf_source.h"
#include "scene/limits.h"
#include "scene/obj_material.h"
#include "scene/obj_scan.h"
#include "scene/reference.h"

namespace radfarm {
namespace {

using Paths = std::vector<std::filesystem::path>;

void add_once(Paths& files, const std::filesystem::path& file) {
  if (std::find(files.begin(), files.end(), file) == files.end()) files.push_back(file);
}

Status add_gltf_files(const std::filesystem::path& scene, Paths& files) {
  RADFARM_TRY(const GltfSource source, read_gltf_source(scene));
  for (const char* array : {"buffers", "images"}) {
    if (!source.json.is_object() || !source.json.contains(array)) continue;
    std::size_t index = 0;
    for (const nlohmann::json& element : source.json.at(array)) {
      const std::string pointer = std::string("/").append(array).append("/").append(std::to_string(index++)) + "/uri";
      if (!element.is_object() || !element.contains("uri") || !element.at("uri").is_string()) continue;
      const auto& uri = element.at("uri").get_ref<const std::string&>();
      if (is_data_uri(uri)) continue;
      const auto path = path_of_uri(uri);
      if (!path) return annotate(path.error(), pointer);
      add_once(files, *path);
    }
  }
  return {};
}

Status add_obj_files(const std::filesystem::path& scene, Paths& files) {
  RADFARM_TRY(const std::string text, read_file(scene, limits::kSceneFileBytes));
  RADFARM_TRY(const ObjScan scan, scan_obj(text));
  for (const ObjScan::Library& library : scan.libraries) {
    for (const std::string& name : library_names(scene.parent_path(), library.name)) {
      RADFARM_TRY(const std::filesystem::path path, path_of_name(name));
      const Result<std::string> mtl = read_file(scene.parent_path() / path, limits::kSceneFileBytes);
      // load_scene() does without it, too.
      if (!mtl && mtl.error().code == Code::kNotFound) continue;
      if (!mtl) return tl::unexpected(mtl.error());
      add_once(files, path);
      for (const std::string& texture : texture_names(*mtl)) {
        RADFARM_TRY(const std::filesystem::path file, path_of_name((path.parent_path() / texture).generic_string()));
        add_once(files, file);
      }
    }
  }
  return {};
}

}  // namespace

Result<Paths> scene_files(const std::filesystem::path& scene) {
  Paths files = {scene.filename()};
  std::string extension = scene.extension().string();
  std::transform(extension.begin(), extension.end(), extension.begin(),
                 [](unsigned char c) { return static_cast<char>(std::tolower(c)); });
  const Status status = extension == ".obj" ? add_obj_files(scene, files) : add_gltf_files(scene, files);
  if (!status) {
    if (status.error().message.starts_with(scene.string())) return tl::unexpected(status.error());
    return annotate(status.error(), scene.string());
  }
  return files;
}

}  // namespace radfarm
