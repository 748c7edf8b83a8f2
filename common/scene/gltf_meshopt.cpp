#include "scene/gltf_meshopt.h"

#include <algorithm>
#include <array>
#include <string_view>

#include <meshoptimizer.h>

#include "scene/gltf_check.h"
#include "scene/gltf_values.h"
#include "scene/limits.h"

namespace radfarm {
namespace {

using nlohmann::json;

constexpr const char* kName = "EXT_meshopt_compression";
// The vertex codec's best: 4 bytes for 256. The index codecs spend at least a byte on 12.
constexpr std::size_t kHighestRatio = 64;

bool fits_mode(const std::string& mode, std::size_t stride, std::size_t count) {
  if (mode == "ATTRIBUTES") return stride % 4 == 0;
  return (mode == "INDICES" || (mode == "TRIANGLES" && count % 3 == 0)) && (stride == 2 || stride == 4);
}

bool fits_filter(const std::string& mode, const std::string& filter, std::size_t stride) {
  if (filter.empty() || filter == "NONE") return true;
  if (mode != "ATTRIBUTES") return false;
  if (filter == "OCTAHEDRAL") return stride == 4 || stride == 8;
  return filter == "QUATERNION" ? stride == 8 : filter == "EXPONENTIAL";
}

int unpack(const json& packed, const unsigned char* bytes, std::size_t size, std::string& result) {
  const auto count = packed.at("count").get<std::size_t>();
  const auto stride = packed.at("byteStride").get<std::size_t>();
  const auto mode = packed.at("mode").get<std::string>();
  if (mode == "TRIANGLES") return meshopt_decodeIndexBuffer(result.data(), count, stride, bytes, size);
  if (mode == "INDICES") return meshopt_decodeIndexSequence(result.data(), count, stride, bytes, size);
  const int failure = meshopt_decodeVertexBuffer(result.data(), count, stride, bytes, size);
  if (failure != 0) return failure;
  const std::string filter = gltf_text(packed, "filter");
  if (filter == "OCTAHEDRAL") meshopt_decodeFilterOct(result.data(), count, stride);
  if (filter == "QUATERNION") meshopt_decodeFilterQuat(result.data(), count, stride);
  if (filter == "EXPONENTIAL") meshopt_decodeFilterExp(result.data(), count, stride);
  return 0;
}

Result<std::string> unpacked_view(const json& packed, const std::vector<std::string>& buffers) {
  const std::string& buffer = buffers.at(packed.at("buffer").get<std::size_t>());
  const auto offset = static_cast<std::size_t>(gltf_number(packed, "byteOffset", 0));
  const auto size = packed.at("byteLength").get<std::size_t>();
  if (offset + size > buffer.size()) return fail(Code::kInvalidArgument, "its buffer has no data");
  std::string result(packed.at("count").get<std::size_t>() * packed.at("byteStride").get<std::size_t>(), '\0');
  if (unpack(packed, reinterpret_cast<const unsigned char*>(buffer.data()) + offset, size, result) != 0) {
    return fail(Code::kInvalidArgument, "is damaged: its bytes do not unpack");
  }
  return result;
}

}  // namespace

void check_gltf_meshopt(JsonChecker& checker, const JsonPlace& root, const JsonPlace& view) {
  if (!checker.ok() || !has_gltf_extension(*view.value, kName)) return;
  const JsonPlace packed = view.extension(kName);
  for (const char* key : {"buffer", "byteLength", "byteStride", "count", "mode"}) checker.require(packed, key);
  checker.index(packed, "buffer", "buffer", count_of(root, "buffers"));
  checker.string(packed, "mode");
  checker.string(packed, "filter");
  const std::size_t offset = checker.integer(packed, "byteOffset", 0, 0, limits::kSceneFileBytes);
  const std::size_t size = checker.integer(packed, "byteLength", 0, 1, limits::kSceneFileBytes);
  const std::size_t stride = checker.integer(packed, "byteStride", 0, 1, 256);
  const std::size_t count = checker.integer(packed, "count", 0, 1, limits::kVertices);
  if (!checker.ok()) return;
  const json& buffer = *root.at("buffers").at(packed.value->at("buffer").get<std::size_t>()).value;
  if (offset + size > buffer.at("byteLength").get<std::size_t>()) {
    return checker.fault(packed.pointer, "lies outside its buffer");
  }
  const auto mode = packed.value->at("mode").get<std::string>();
  if (!fits_mode(mode, stride, count)) return checker.fault(packed.pointer, "mode, byteStride and count do not agree");
  if (!fits_filter(mode, gltf_text(*packed.value, "filter"), stride)) {
    return checker.fault(packed.pointer + "/filter", "does not go with mode and byteStride");
  }
  if (count * stride != view.value->at("byteLength").get<std::size_t>()) {
    return checker.fault(packed.pointer, "does not unpack to the byteLength of its view");
  }
  if (count * stride > kHighestRatio * size) checker.fault(packed.pointer, "cannot hold that many elements");
}

bool is_meshopt_fallback(const json& buffer) {
  const json& extension = gltf_extension(buffer, kName);
  const auto fallback = extension.find("fallback");
  return fallback != extension.end() && fallback->is_boolean() && fallback->get<bool>();
}

Status unpack_gltf_meshopt(json& document, std::vector<std::string>& buffers) {
  if (!document.contains("bufferViews")) return {};
  std::size_t total = 0;
  std::size_t index = 0;
  for (json& view : document.at("bufferViews")) {
    const std::string pointer = "/bufferViews/" + std::to_string(index++);
    const auto length = view.at("byteLength").get<std::size_t>();
    if (!has_gltf_extension(view, kName)) {
      const std::size_t end = static_cast<std::size_t>(gltf_number(view, "byteOffset", 0)) + length;
      if (end <= buffers.at(view.at("buffer").get<std::size_t>()).size()) continue;
      return fail(Code::kInvalidArgument, pointer + ": its buffer has no data");
    }
    total += length;
    if (total > limits::kUnpackedBytes) {
      return fail(Code::kResourceExhausted, pointer + ": unpacks to more than " +
                                                std::to_string(limits::kUnpackedBytes) + " bytes with the rest");
    }
    Result<std::string> bytes = unpacked_view(gltf_extension(view, kName), buffers);
    if (!bytes) return annotate(bytes.error(), pointer + "/extensions/" + kName);
    view["buffer"] = buffers.size();
    view["byteOffset"] = 0;
    buffers.push_back(std::move(*bytes));
  }
  return {};
}

}  // namespace radfarm
