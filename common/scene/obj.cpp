#include "scene/obj.h"

#include <algorithm>
#include <cstdint>
#include <exception>
#include <map>
#include <sstream>
#include <unordered_map>
#include <utility>

#include <tiny_obj_loader.h>

#include "base/file.h"
#include "base/random.h"
#include "scene/limits.h"
#include "scene/obj_material.h"
#include "scene/obj_scan.h"
#include "scene/polygon.h"
#include "scene/texture_uses.h"

namespace radfarm {
namespace {

/// A face corner: indices into the file's positions, texture coordinates and normals; -1 is none.
struct Corner {
  std::int64_t position = -1;
  std::int64_t uv = -1;
  std::int64_t normal = -1;
  friend bool operator==(const Corner&, const Corner&) = default;
};

struct CornerHash {
  std::size_t operator()(const Corner& corner) const {
    return combine(static_cast<std::uint64_t>(corner.position), static_cast<std::uint64_t>(corner.uv),
                   static_cast<std::uint64_t>(corner.normal));
  }
};

/// Collects what tinyobjloader's callbacks deliver, in file order. Invariant: scan_obj() has passed the text, so every
/// index is in range.
class ObjBuilder {
 public:
  ObjBuilder(ObjMaterials materials, LoadOptions::UpAxis up, DraftScene& draft)
      : materials_(std::move(materials)), up_(up), draft_(draft) {
    material_ = no_material();
  }

  void add_position(const Vec3d& p) { positions_.push_back(upright(p)); }
  void add_normal(const Vec3d& n) { normals_.push_back(to_float(upright(n))); }
  // OBJ counts v upwards, our textures downwards.
  void add_uv(double u, double v) { uvs_.emplace_back(static_cast<float>(u), static_cast<float>(1 - v)); }
  void start_shape(std::string name) {
    ++shape_;
    shape_name_ = std::move(name);
  }

  void use_material(const std::string& name) {
    const auto found = materials_.find(std::string(trimmed(name)));
    material_ = found == materials_.end() ? no_material() : found->second;
    if (found != materials_.end()) return;
    add_note(draft_.scene, "Material '" + name + "' is not defined; its faces are grey (reflectance 0.5).");
  }

  void add_face(const tinyobj::index_t* indices, int count) {
    if (count < 3) return add_note(draft_.scene, "Faces with fewer than three corners are skipped.");
    if (material_ == no_material()) {
      add_note(draft_.scene, "Faces without a material are grey (reflectance 0.5).");
    }
    MeshBuilder& part = part_of_current();
    std::vector<std::uint32_t> vertices;
    for (int i = 0; i < count; ++i) {
      const Corner corner = {resolve(indices[i].vertex_index, positions_.size()),
                             resolve(indices[i].texcoord_index, uvs_.size()),
                             resolve(indices[i].normal_index, normals_.size())};
      part.has_normals = part.has_normals || corner.normal >= 0;
      const auto [known, is_new] = part.vertices.try_emplace(corner, static_cast<std::uint32_t>(part.corners.size()));
      if (is_new) part.corners.push_back(corner);
      vertices.push_back(known->second);
    }
    part.outlines.push_back(std::move(vertices));
  }

  /// Meshes and instances of all faces. Last, because faces may refer to vertices that come later in the file.
  Status finish() {
    std::size_t triangles = 0;
    for (MeshBuilder& part : parts_) {
      Mesh mesh;
      mesh.name = part.name;
      mesh.material = part.material;
      std::vector<Vec3d> positions;
      fill_vertices(part, mesh, positions);
      for (const std::vector<std::uint32_t>& outline : part.outlines) {
        std::vector<Vec3d> corners;
        for (const std::uint32_t vertex : outline) corners.push_back(positions[vertex]);
        for (const auto& t : triangulate_polygon(corners)) {
          mesh.triangles.push_back({outline[t[0]], outline[t[1]], outline[t[2]]});
        }
      }
      triangles += mesh.triangles.size();
      if (triangles > limits::kTriangles) return fail(Code::kResourceExhausted, "too many triangles");
      const auto index = static_cast<std::uint32_t>(draft_.scene.meshes.size());
      draft_.scene.instances.push_back({index, Matrix4(), part.name});
      draft_.instance_to_world.emplace_back();
      draft_.positions.push_back(std::move(positions));
      draft_.scene.meshes.push_back(std::move(mesh));
      part = {};
    }
    return {};
  }

 private:
  struct MeshBuilder {
    std::string name;
    std::uint32_t material = 0;
    bool has_normals = false;
    std::vector<Corner> corners;
    std::unordered_map<Corner, std::uint32_t, CornerHash> vertices;
    std::vector<std::vector<std::uint32_t>> outlines;
  };

  std::uint32_t no_material() const { return static_cast<std::uint32_t>(draft_.scene.materials.size() - 1); }
  Vec3d upright(const Vec3d& v) const { return up_ == LoadOptions::UpAxis::kZ ? Vec3d(v.x, v.z, -v.y) : v; }

  /// 1-based, or negative from the last one so far, or 0 for none.
  static std::int64_t resolve(int index, std::size_t count) {
    if (index > 0) return index - 1;
    return index == 0 ? -1 : static_cast<std::int64_t>(count) + index;
  }

  MeshBuilder& part_of_current() {
    const auto [known, is_new] = part_indices_.try_emplace({shape_, material_}, parts_.size());
    if (is_new) {
      parts_.emplace_back();
      parts_.back().name = shape_name_;
      parts_.back().material = material_;
    }
    return parts_[known->second];
  }

  void fill_vertices(const MeshBuilder& part, Mesh& mesh, std::vector<Vec3d>& positions) const {
    const Material& material = draft_.scene.materials[part.material];
    const auto uses = texture_uses(material);
    const bool is_textured = std::any_of(uses.begin(), uses.end(), [](const auto* use) { return use->is_used(); });
    for (const Corner& corner : part.corners) {
      positions.push_back(positions_[static_cast<std::size_t>(corner.position)]);
      // A corner without normal gets the zero vector, which clean_meshes() replaces by the surface's own.
      if (part.has_normals) {
        mesh.normals.push_back(corner.normal < 0 ? Vec3(0.0F) : normals_[static_cast<std::size_t>(corner.normal)]);
      }
      if (is_textured) {
        mesh.uv[0].push_back(corner.uv < 0 ? Vec2(0.0F) : uvs_[static_cast<std::size_t>(corner.uv)]);
      }
    }
  }

  ObjMaterials materials_;
  LoadOptions::UpAxis up_;
  DraftScene& draft_;
  std::vector<Vec3d> positions_;
  std::vector<Vec3> normals_;
  std::vector<Vec2> uvs_;
  std::vector<MeshBuilder> parts_;
  std::map<std::pair<std::size_t, std::uint32_t>, std::size_t> part_indices_;
  std::size_t shape_ = 0;
  std::string shape_name_;
  std::uint32_t material_ = 0;
};

ObjBuilder& builder(void* data) { return *static_cast<ObjBuilder*>(data); }

tinyobj::callback_t callbacks() {
  using tinyobj::real_t;
  tinyobj::callback_t calls;
  calls.vertex_cb = [](void* data, real_t x, real_t y, real_t z, real_t) { builder(data).add_position({x, y, z}); };
  calls.normal_cb = [](void* data, real_t x, real_t y, real_t z) { builder(data).add_normal({x, y, z}); };
  calls.texcoord_cb = [](void* data, real_t x, real_t y, real_t) { builder(data).add_uv(x, y); };
  calls.index_cb = [](void* data, tinyobj::index_t* indices, int count) { builder(data).add_face(indices, count); };
  calls.usemtl_cb = [](void* data, const char* name, int) { builder(data).use_material(name); };
  calls.group_cb = [](void* data, const char** names, int count) {
    builder(data).start_shape(count > 0 ? names[0] : "");
  };
  calls.object_cb = [](void* data, const char* name) { builder(data).start_shape(name); };
  return calls;
}

}  // namespace

Result<DraftScene> read_obj(const std::filesystem::path& path, LoadOptions::UpAxis up) {
  RADFARM_TRY(std::string text, read_file(path, limits::kSceneFileBytes));
  RADFARM_TRY(const ObjScan scan, scan_obj(text));
  DraftScene draft;
  RADFARM_TRY(ObjMaterials materials, read_obj_materials(path.parent_path(), scan, draft.scene));
  if (scan.has_vertex_colors) add_note(draft.scene, "Vertex colours of OBJ files are ignored.");
  ObjBuilder build(std::move(materials), up, draft);
  try {
    std::istringstream stream(std::move(text));
    std::string warnings;
    std::string errors;
    if (!tinyobj::LoadObjWithCallback(stream, callbacks(), &build, nullptr, &warnings, &errors)) {
      return fail(Code::kInvalidArgument, "is not OBJ: " + errors.substr(0, errors.find('\n')));
    }
  } catch (const std::exception& exception) {
    return fail(Code::kInvalidArgument, "is not OBJ: " + std::string(exception.what()));
  }
  RADFARM_TRY_STATUS(build.finish());
  return draft;
}

}  // namespace radfarm
