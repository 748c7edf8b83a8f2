#include "scene/load_scene.h"

#include <algorithm>
#include <cctype>

#include "scene/clean.h"
#include "scene/draft_scene.h"
#include "scene/gltf.h"
#include "scene/obj.h"
#include "scene/recentre.h"
#include "scene/validate.h"

namespace radfarm {
namespace {

Result<DraftScene> read_by_extension(const std::filesystem::path& path, const LoadOptions& options) {
  std::string extension = path.extension().string();
  std::transform(extension.begin(), extension.end(), extension.begin(),
                 [](unsigned char c) { return static_cast<char>(std::tolower(c)); });
  if (extension == ".gltf" || extension == ".glb") return read_gltf(path);
  if (extension == ".obj") return read_obj(path, options.up);
  return fail(Code::kInvalidArgument, "unknown scene format '" + extension + "'; supported are .gltf, .glb and .obj");
}

}  // namespace

Result<Scene> load_scene(const std::filesystem::path& path, const LoadOptions& options) {
  const auto named = [&](const Error& error) -> tl::unexpected<Error> {
    if (error.message.starts_with(path.string())) return tl::unexpected(error);
    return annotate(error, path.string());
  };
  Result<DraftScene> draft = read_by_extension(path, options);
  if (!draft) return named(draft.error());
  Scene scene = recentre(std::move(*draft));
  clean_scene(scene);
  if (const Status status = validate(scene); !status) return named(status.error());
  return scene;
}

}  // namespace radfarm
