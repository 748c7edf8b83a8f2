#include "bake/glb.h"

#include <cstdint>
#include <cstring>
#include <limits>
#include <string>
#include <utility>

namespace radfarm {
namespace {

constexpr std::uint32_t kMagic = 0x46546c67;       // "glTF"
constexpr std::uint32_t kJsonChunk = 0x4e4f534a;   // "JSON"
constexpr std::uint32_t kBinaryChunk = 0x004e4942; // "BIN"

void append(std::vector<std::byte>& bytes, std::uint32_t word) {
  for (int shift = 0; shift < 32; shift += 8) bytes.push_back(static_cast<std::byte>(word >> shift));
}

void append_chunk(std::vector<std::byte>& bytes, std::uint32_t kind, std::span<const std::byte> data) {
  append(bytes, static_cast<std::uint32_t>(data.size()));
  append(bytes, kind);
  bytes.insert(bytes.end(), data.begin(), data.end());
}

}  // namespace

std::size_t GlbWriter::add_view(std::span<const std::byte> bytes, Use use) {
  nlohmann::json view = {{"buffer", 0}, {"byteOffset", buffer_.size()}, {"byteLength", bytes.size()}};
  if (use == Use::kVertices) view["target"] = 34962;
  if (use == Use::kIndices) view["target"] = 34963;
  buffer_.insert(buffer_.end(), bytes.begin(), bytes.end());
  buffer_.resize((buffer_.size() + 3) / 4 * 4);
  json["bufferViews"].push_back(std::move(view));
  return json["bufferViews"].size() - 1;
}

std::size_t GlbWriter::add_accessor(std::span<const std::byte> bytes, Use use, const Accessor& accessor) {
  nlohmann::json entry = {{"bufferView", add_view(bytes, use)},
                          {"componentType", accessor.component_type},
                          {"type", accessor.type},
                          {"count", accessor.count}};
  if (accessor.is_normalized) entry["normalized"] = true;
  json["accessors"].push_back(std::move(entry));
  return json["accessors"].size() - 1;
}

Result<std::vector<std::byte>> GlbWriter::finish() && {
  if (!buffer_.empty()) json["buffers"] = nlohmann::json::array({{{"byteLength", buffer_.size()}}});
  std::string text = json.dump(-1, ' ', false, nlohmann::json::error_handler_t::replace);
  text.resize((text.size() + 3) / 4 * 4, ' ');
  const std::size_t size = 12 + 8 + text.size() + (buffer_.empty() ? 0 : 8 + buffer_.size());
  if (size > std::numeric_limits<std::uint32_t>::max()) {
    return fail(Code::kResourceExhausted, "the baked scene has more than 4 GiB, the most that a GLB holds: lower --quality");
  }
  std::vector<std::byte> bytes;
  bytes.reserve(size);
  append(bytes, kMagic);
  append(bytes, 2);
  append(bytes, static_cast<std::uint32_t>(size));
  append_chunk(bytes, kJsonChunk, std::as_bytes(std::span(text)));
  if (!buffer_.empty()) append_chunk(bytes, kBinaryChunk, buffer_);
  return bytes;
}

}  // namespace radfarm
