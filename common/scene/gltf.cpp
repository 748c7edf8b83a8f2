#include "scene/gltf.h"

#include "scene/gltf_material.h"
#include "scene/gltf_mesh.h"
#include "scene/gltf_model.h"
#include "scene/gltf_nodes.h"

namespace radfarm {

Result<DraftScene> read_gltf(const std::filesystem::path& path) {
  RADFARM_TRY(GltfSource source, read_gltf_source(path));
  return read_gltf(std::move(source));
}

Result<DraftScene> read_gltf(GltfSource source) {
  RADFARM_TRY(GltfModel model, parse_gltf(std::move(source)));
  DraftScene draft;
  pose_at_start(model, draft.scene);
  RADFARM_TRY(const std::vector<GltfUvSets> uv_sets, read_gltf_materials(model, draft.scene));
  RADFARM_TRY(const auto mesh_parts, read_gltf_meshes(model, uv_sets, draft.scene));
  RADFARM_TRY_STATUS(read_gltf_nodes(model, mesh_parts, draft));
  draft.positions.resize(draft.scene.meshes.size());
  return draft;
}

}  // namespace radfarm
