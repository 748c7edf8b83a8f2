#include "radiosity/element_mesh_file.h"

#include <algorithm>

#include "base/flat_file.h"

namespace radfarm {
namespace {

constexpr std::uint32_t kVersion = 1;

/// An edge starts at its corner, 0, and goes on towards 1.
bool is_sound_edge(const ElementMesh& mesh, std::size_t first, std::uint32_t count) {
  for (std::size_t i = first; i < first + count; ++i) {
    const RingVertex& vertex = mesh.ring[i];
    if (vertex.vertex >= mesh.vertices.size()) return false;
    // Written so that NaN fails.
    const bool goes_on = i == first ? vertex.along == 0 : vertex.along > mesh.ring[i - 1].along && vertex.along < 1;
    if (!goes_on) return false;
  }
  return true;
}

bool is_sound_outline(const ElementMesh& mesh, const Element& element) {
  std::size_t first = element.first_ring;
  for (const std::uint32_t count : element.edge_vertices) {
    if (count == 0 || count > mesh.ring.size() || first > mesh.ring.size() - count) return false;
    if (!is_sound_edge(mesh, first, count)) return false;
    first += count;
  }
  const bool has_more = first - element.first_ring > 3;
  return has_more ? element.center < mesh.vertices.size() : element.center == kNone;
}

bool is_sound_element(const ElementMesh& mesh, std::size_t i) {
  const Element& element = mesh.elements[i];
  if (element.is_undivided()) return is_sound_outline(mesh, element);
  return element.first_child > i && mesh.elements.size() >= 4 && element.first_child <= mesh.elements.size() - 4;
}

bool is_light(const Spectrum& s) { return is_finite(s) && min_component(s) >= 0; }

bool is_sound(const ElementMesh& mesh) {
  for (std::size_t i = 0; i < mesh.elements.size(); ++i) {
    if (!is_sound_element(mesh, i)) return false;
  }
  const auto is_side = [&](std::uint32_t side) { return side == kNone || side < mesh.elements.size(); };
  const auto is_vertex = [](const MeshVertex& vertex) {
    return is_finite(vertex.position) && is_light(vertex.irradiance.direct) && is_light(vertex.irradiance.indirect);
  };
  return std::all_of(mesh.sides.begin(), mesh.sides.end(), is_side) &&
         std::all_of(mesh.vertices.begin(), mesh.vertices.end(), is_vertex);
}

}  // namespace

std::vector<std::byte> encode(const ElementMesh& mesh) {
  FlatFileWriter file("elements", kVersion);
  file.add("vertices", mesh.vertices);
  file.add("elements", mesh.elements);
  file.add("ring", mesh.ring);
  file.add("sides", mesh.sides);
  return file.finish();
}

Result<ElementMesh> decode_element_mesh(std::span<const std::byte> bytes, std::size_t sides) {
  RADFARM_TRY(const FlatFileReader file, FlatFileReader::open(bytes, "elements", kVersion));
  ElementMesh mesh;
  RADFARM_TRY(mesh.vertices, file.copy<MeshVertex>("vertices"));
  RADFARM_TRY(mesh.elements, file.copy<Element>("elements"));
  RADFARM_TRY(mesh.ring, file.copy<RingVertex>("ring"));
  RADFARM_TRY(mesh.sides, file.copy<std::uint32_t>("sides"));
  if (mesh.sides.size() != sides) return fail(Code::kDataLoss, "elements: the scene has other triangles");
  if (!is_sound(mesh)) return fail(Code::kDataLoss, "elements: an index or a value lies outside");
  return mesh;
}

}  // namespace radfarm
