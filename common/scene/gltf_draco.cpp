#include "scene/gltf_draco.h"

#include <algorithm>
#include <cstdint>
#include <exception>
#include <memory>
#include <string_view>

#include <draco/compression/mesh/mesh_edgebreaker_decoder.h>
#include <draco/compression/mesh/mesh_sequential_decoder.h>
#include <draco/core/varint_decoding.h>
#include <draco/metadata/metadata_decoder.h>

#include "scene/gltf_check.h"
#include "scene/gltf_values.h"
#include "scene/limits.h"

namespace radfarm {
namespace {

using nlohmann::json;

constexpr const char* kName = "KHR_draco_mesh_compression";

struct Head {
  std::uint8_t method = 0;  // draco::MeshEncoderMethod
  std::uint32_t faces = 0;
  std::uint32_t points = 0;  // at least so many
};

/// What the head of the packed data promises [Draco bitstream specification 2.2, sections 4 and 5]. The decoder takes
/// memory for it before it reads on. False where it is cut off or not a mesh of a version that glTF allows.
bool read_head(std::string_view bytes, Head& head) {
  draco::DecoderBuffer buffer;
  buffer.Init(bytes.data(), bytes.size());
  char magic[5];
  std::uint8_t major = 0, minor = 0, geometry = 0, traversal = 0;
  std::uint16_t flags = 0;
  if (!buffer.Decode(magic, sizeof magic) || !buffer.Decode(&major) || !buffer.Decode(&minor)) return false;
  if (!buffer.Decode(&geometry) || !buffer.Decode(&head.method) || !buffer.Decode(&flags)) return false;
  if (std::string_view(magic, sizeof magic) != "DRACO" || major != 2 || minor != 2) return false;
  if (geometry != draco::TRIANGULAR_MESH || head.method > draco::MESH_EDGEBREAKER_ENCODING) return false;
  buffer.set_bitstream_version(static_cast<std::uint16_t>(DRACO_BITSTREAM_VERSION(major, minor)));
  draco::GeometryMetadata metadata;
  const bool has_metadata = (flags & METADATA_FLAG_MASK) != 0;
  if (has_metadata && !draco::MetadataDecoder().DecodeGeometryMetadata(&buffer, &metadata)) return false;
  if (head.method == draco::MESH_SEQUENTIAL_ENCODING) {
    return draco::DecodeVarint(&head.faces, &buffer) && draco::DecodeVarint(&head.points, &buffer);
  }
  return buffer.Decode(&traversal) && draco::DecodeVarint(&head.points, &buffer) &&
         draco::DecodeVarint(&head.faces, &buffer);
}

tl::unexpected<Error> too_large() {
  return fail(Code::kResourceExhausted,
              "unpacks to more than " + std::to_string(limits::kDracoRatio) + " times its bytes");
}

Result<Head> checked_head(std::string_view bytes, std::size_t vertices) {
  Head head;
  if (!read_head(bytes, head)) return fail(Code::kInvalidArgument, "is not a mesh in Draco's bitstream 2.2");
  if (head.points > vertices) {
    return fail(Code::kInvalidArgument, "holds " + std::to_string(head.points) + " vertices or more, its accessors " +
                                            std::to_string(vertices));
  }
  if (head.faces > limits::kTriangles) return fail(Code::kResourceExhausted, "holds too many triangles");
  // Three indices a face, and three floats a vertex at the least.
  const std::size_t least = 12 * std::max(std::size_t{head.faces}, vertices);
  if (least > limits::kDracoRatio * bytes.size()) return too_large();
  return head;
}

/// One of Draco's decoders, which gives up when the attributes, whose types it has just read, would take too much.
template <typename Decoder>
class GuardedDecoder : public Decoder {
 public:
  explicit GuardedDecoder(std::size_t most_bytes) : most_bytes_(most_bytes) {}
  bool is_too_large() const { return is_too_large_; }

 protected:
  bool DecodeAllAttributes() override {
    const draco::PointCloud& cloud = *this->point_cloud();
    std::size_t vertex_bytes = 0;
    for (int i = 0; i < cloud.num_attributes(); ++i) {
      const draco::PointAttribute& attribute = *cloud.attribute(i);
      vertex_bytes += std::size_t{8} * static_cast<std::size_t>(std::max<int>(attribute.num_components(), 1));
    }
    is_too_large_ = vertex_bytes * cloud.num_points() > most_bytes_;
    return !is_too_large_ && Decoder::DecodeAllAttributes();
  }

 private:
  std::size_t most_bytes_;
  bool is_too_large_ = false;
};

template <typename Decoder>
Result<std::unique_ptr<draco::Mesh>> decode_with(std::string_view bytes) {
  draco::DecoderBuffer buffer;
  buffer.Init(bytes.data(), bytes.size());
  auto mesh = std::make_unique<draco::Mesh>();
  GuardedDecoder<Decoder> decoder(limits::kDracoRatio * bytes.size());
  const bool is_decoded = decoder.Decode(draco::DecoderOptions(), &buffer, mesh.get()).ok();
  if (decoder.is_too_large()) return too_large();
  if (!is_decoded) return fail(Code::kInvalidArgument, "is damaged: its bytes do not unpack");
  return mesh;
}

Result<std::unique_ptr<draco::Mesh>> decode(std::string_view bytes, std::size_t vertices) {
  RADFARM_TRY(const Head head, checked_head(bytes, vertices));
  Result<std::unique_ptr<draco::Mesh>> mesh = head.method == draco::MESH_SEQUENTIAL_ENCODING
                                                  ? decode_with<draco::MeshSequentialDecoder>(bytes)
                                                  : decode_with<draco::MeshEdgebreakerDecoder>(bytes);
  if (!mesh || (*mesh)->num_points() == vertices) return mesh;
  return fail(Code::kInvalidArgument, "holds " + std::to_string((*mesh)->num_points()) + " vertices, its accessors " +
                                          std::to_string(vertices));
}

std::string index_bytes(const draco::Mesh& mesh) {
  std::string bytes;
  bytes.reserve(std::size_t{mesh.num_faces()} * 12);
  for (draco::FaceIndex face(0); face < mesh.num_faces(); ++face) {
    for (const draco::PointIndex& point : mesh.face(face)) {
      const std::uint32_t index = point.value();
      bytes.append(reinterpret_cast<const char*>(&index), sizeof index);
    }
  }
  return bytes;
}

template <typename T>
Result<std::string> values_as(const draco::PointAttribute& attribute, std::size_t points, std::size_t components) {
  std::string bytes(points * components * sizeof(T), '\0');
  T element[16] = {};
  for (std::size_t i = 0; i < points; ++i) {
    const auto value = attribute.mapped_index(draco::PointIndex(static_cast<std::uint32_t>(i)));
    if (value.value() >= attribute.size() ||
        !attribute.ConvertValue<T>(value, static_cast<std::int8_t>(components), element)) {
      return fail(Code::kInvalidArgument, "has a value that its accessor cannot hold");
    }
    std::copy_n(reinterpret_cast<const char*>(element), components * sizeof(T),
                bytes.data() + i * components * sizeof(T));
  }
  return bytes;
}

/// The attribute of every point, as its accessor declares it.
Result<std::string> attribute_bytes(const draco::Mesh& mesh, std::uint32_t id, const json& accessor) {
  const draco::PointAttribute* attribute = mesh.GetAttributeByUniqueId(id);
  if (attribute == nullptr) return fail(Code::kInvalidArgument, "does not exist in the packed data");
  const std::size_t components = component_count(accessor.at("type").get<std::string>());
  if (static_cast<std::size_t>(attribute->num_components()) != components) {
    return fail(Code::kInvalidArgument, "has another number of components than its accessor");
  }
  switch (accessor.at("componentType").get<int>()) {
    case 5120:
      return values_as<std::int8_t>(*attribute, mesh.num_points(), components);
    case 5121:
      return values_as<std::uint8_t>(*attribute, mesh.num_points(), components);
    case 5122:
      return values_as<std::int16_t>(*attribute, mesh.num_points(), components);
    case 5123:
      return values_as<std::uint16_t>(*attribute, mesh.num_points(), components);
    case 5125:
      return values_as<std::uint32_t>(*attribute, mesh.num_points(), components);
    default:
      return values_as<float>(*attribute, mesh.num_points(), components);
  }
}

/// Unpacks primitives one after the other.
class Unpacker {
 public:
  Unpacker(json& document, std::vector<std::string>& buffers) : document_(document), buffers_(buffers) {}

  Status unpack(json& primitive) {
    const json packed = gltf_extension(primitive, kName);
    RADFARM_TRY(const std::string_view bytes, view_bytes(packed.at("bufferView").get<std::size_t>()));
    RADFARM_TRY(const std::unique_ptr<draco::Mesh> mesh, decode(bytes, vertices_of(primitive)));
    // Whatever the mode was, Draco stores a list.
    primitive["mode"] = 4;
    const json indices = {{"componentType", 5125}, {"type", "SCALAR"}, {"count", std::size_t{mesh->num_faces()} * 3}};
    if (mesh->num_faces() == 0) return fail(Code::kInvalidArgument, "holds no triangles");
    RADFARM_TRY(primitive["indices"], add_accessor(indices, index_bytes(*mesh)));
    for (const auto& [name, id] : packed.at("attributes").items()) {
      if (!primitive.at("attributes").contains(name)) continue;
      json& accessor = primitive.at("attributes").at(name);
      const json declared = document_.at("accessors").at(accessor.get<std::size_t>());
      Result<std::string> values = attribute_bytes(*mesh, id.get<std::uint32_t>(), declared);
      if (!values) return annotate(values.error(), "attribute " + name.substr(0, 60));
      RADFARM_TRY(accessor, add_accessor(declared, std::move(*values)));
    }
    return {};
  }

 private:
  Result<std::string_view> view_bytes(std::size_t index) const {
    const json& view = document_.at("bufferViews").at(index);
    const std::string_view buffer = buffers_.at(view.at("buffer").get<std::size_t>());
    const auto offset = static_cast<std::size_t>(gltf_number(view, "byteOffset", 0));
    const auto length = view.at("byteLength").get<std::size_t>();
    if (offset + length > buffer.size()) return fail(Code::kInvalidArgument, "its buffer has no data");
    return buffer.substr(offset, length);
  }

  std::size_t vertices_of(const json& primitive) const {
    const json& attributes = primitive.at("attributes");
    if (attributes.empty()) return 0;
    return document_.at("accessors").at(attributes.begin()->get<std::size_t>()).at("count").get<std::size_t>();
  }

  Result<std::size_t> add_accessor(json accessor, std::string bytes) {
    total_ += bytes.size();
    if (total_ > limits::kUnpackedBytes) {
      return fail(Code::kResourceExhausted,
                  "unpacks to more than " + std::to_string(limits::kUnpackedBytes) + " bytes with the rest");
    }
    document_["bufferViews"].push_back({{"buffer", buffers_.size()}, {"byteLength", bytes.size()}});
    buffers_.push_back(std::move(bytes));
    for (const char* key : {"byteOffset", "sparse"}) accessor.erase(key);
    accessor["bufferView"] = document_["bufferViews"].size() - 1;
    document_["accessors"].push_back(std::move(accessor));
    return document_["accessors"].size() - 1;
  }

  json& document_;
  std::vector<std::string>& buffers_;
  std::size_t total_ = 0;
};

}  // namespace

bool has_draco(const json& primitive) { return has_gltf_extension(primitive, kName); }

void check_gltf_draco(JsonChecker& checker, const JsonPlace& root, const JsonPlace& primitive) {
  if (!checker.ok() || !has_draco(*primitive.value)) return;
  const JsonPlace packed = primitive.extension(kName);
  checker.require(packed, "bufferView");
  checker.require(packed, "attributes");
  checker.index(packed, "bufferView", "bufferView", count_of(root, "bufferViews"));
  if (!checker.ok()) return;
  const JsonPlace attributes = packed.at("attributes");
  if (!attributes.value->is_object()) return checker.fault(attributes.pointer, "must be an object");
  for (const auto& [name, id] : attributes.value->items()) checker.integer(attributes, name, 0, 0, 0xffffffffU);
}

Status unpack_gltf_draco(json& document, std::vector<std::string>& buffers) {
  if (!document.contains("meshes")) return {};
  Unpacker unpacker(document, buffers);
  for (std::size_t m = 0; m < document["meshes"].size(); ++m) {
    json& primitives = document["meshes"][m]["primitives"];
    for (std::size_t p = 0; p < primitives.size(); ++p) {
      if (!has_draco(primitives[p])) continue;
      const std::string pointer = "/meshes/" + std::to_string(m) + "/primitives/" + std::to_string(p);
      try {
        const Status status = unpacker.unpack(primitives[p]);
        if (!status) return annotate(status.error(), pointer + "/extensions/" + kName);
      } catch (const std::exception&) {  // Draco is not written to throw, but takes memory as it goes
        return fail(Code::kResourceExhausted, pointer + "/extensions/" + kName + ": does not fit into memory");
      }
    }
  }
  return {};
}

}  // namespace radfarm
