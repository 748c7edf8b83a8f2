#include "scene/gltf_source.h"

#include <algorithm>
#include <cstdint>
#include <cstring>

#include "base/file.h"
#include "scene/limits.h"

namespace radfarm {
namespace {

constexpr std::uint32_t kMagic = 0x46546c67;      // "glTF"
constexpr std::uint32_t kJsonChunk = 0x4e4f534a;  // "JSON"
constexpr std::uint32_t kBinChunk = 0x004e4942;   // "BIN"

std::uint32_t word_at(std::string_view bytes, std::size_t offset) {
  std::uint32_t word = 0;
  std::memcpy(&word, bytes.data() + offset, sizeof word);
  return word;
}

struct Chunks {
  std::string_view json;
  std::string_view binary;
  bool has_binary = false;
};

tl::unexpected<Error> damaged_glb(std::size_t offset, const std::string& what) {
  return fail(Code::kInvalidArgument, "byte " + std::to_string(offset) + ": " + what);
}

/// The JSON and BIN chunks of a .glb; chunks of other types after them are skipped, as the specification says.
Result<Chunks> split_glb(std::string_view bytes) {
  if (bytes.size() < 20) return damaged_glb(bytes.size(), "GLB file is shorter than its header");
  if (word_at(bytes, 4) != 2) return damaged_glb(4, "GLB version " + std::to_string(word_at(bytes, 4)) + ", must be 2");
  if (word_at(bytes, 8) != bytes.size()) {
    return damaged_glb(8, "GLB header says " + std::to_string(word_at(bytes, 8)) + " bytes, the file has " +
                              std::to_string(bytes.size()));
  }
  Chunks chunks;
  std::size_t index = 0;
  for (std::size_t offset = 12; offset < bytes.size(); ++index) {
    if (bytes.size() - offset < 8) return damaged_glb(offset, "GLB chunk header is cut off");
    const std::size_t size = word_at(bytes, offset);
    const std::uint32_t type = word_at(bytes, offset + 4);
    if (size > bytes.size() - offset - 8) return damaged_glb(offset, "GLB chunk reaches beyond the end of the file");
    const std::string_view data = bytes.substr(offset + 8, size);
    if ((index == 0) != (type == kJsonChunk)) return damaged_glb(offset, "GLB must have one JSON chunk, as its first");
    if (type == kJsonChunk) chunks.json = data;
    if (type == kBinChunk) {
      if (index != 1) return damaged_glb(offset, "GLB may have one BIN chunk, as its second");
      chunks.binary = data;
      chunks.has_binary = true;
    }
    offset += 8 + size;
  }
  return chunks;
}

/// The deepest nesting of brackets outside of strings.
std::size_t bracket_depth(std::string_view text) {
  std::size_t depth = 0;
  std::size_t deepest = 0;
  for (std::size_t i = 0; i < text.size(); ++i) {
    if (text[i] == '"') {
      // Skip the string: data URIs make most of the text.
      for (++i; i < text.size() && text[i] != '"'; ++i) i += text[i] == '\\' ? 1 : 0;
    } else if (text[i] == '{' || text[i] == '[') {
      deepest = std::max(deepest, ++depth);
    } else if ((text[i] == '}' || text[i] == ']') && depth > 0) {
      --depth;
    }
  }
  return deepest;
}

Result<nlohmann::json> parse_json(std::string_view text) {
  if (bracket_depth(text) > limits::kJsonDepth) {
    return fail(Code::kResourceExhausted, "JSON is nested deeper than " + std::to_string(limits::kJsonDepth));
  }
  try {
    return nlohmann::json::parse(text);
  } catch (const nlohmann::json::parse_error& error) {
    const std::string_view before = text.substr(0, std::min(error.byte, text.size()));
    const auto line = 1 + std::count(before.begin(), before.end(), '\n');
    return fail(Code::kInvalidArgument, "line " + std::to_string(line) + ": is not JSON");
  } catch (const nlohmann::json::exception&) {
    return fail(Code::kInvalidArgument, "JSON holds a number too large for a double");
  }
}

}  // namespace

Result<GltfSource> split_gltf(std::string_view bytes, const std::filesystem::path& folder) {
  GltfSource source;
  source.folder = folder;
  Chunks chunks{bytes, {}, false};
  if (bytes.size() >= 4 && word_at(bytes, 0) == kMagic) {
    RADFARM_TRY(chunks, split_glb(bytes));
  } else if (bytes.starts_with("\xef\xbb\xbf")) {
    chunks.json.remove_prefix(3);  // a byte order mark: not allowed, but harmless
  }
  source.binary = std::string(chunks.binary);
  source.is_binary = chunks.has_binary;
  RADFARM_TRY(source.json, parse_json(chunks.json));
  return source;
}

Result<GltfSource> read_gltf_source(const std::filesystem::path& path) {
  RADFARM_TRY(const std::string bytes, read_file(path, limits::kSceneFileBytes));
  return split_gltf(bytes, path.parent_path());
}

}  // namespace radfarm
