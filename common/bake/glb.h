#pragma once

#include <array>
#include <cstddef>
#include <span>
#include <vector>

#include <nlohmann/json.hpp>

#include "base/status.h"

namespace radfarm {

/// A glTF 2.0 binary under construction: the JSON grows in `json`, arrays go into its one buffer.
class GlbWriter {
 public:
  GlbWriter() : json({{"asset", {{"version", "2.0"}}}}) {}

  nlohmann::json json;

  enum class Use { kVertices, kIndices, kImage };
  /// Appends bytes, 4-byte aligned, as a buffer view; returns its index.
  std::size_t add_view(std::span<const std::byte> bytes, Use use);

  struct Accessor {
    int component_type = 5126;  // glTF's number: 5126 float, 5123 unsigned short, 5125 unsigned int
    const char* type = "SCALAR";
    bool is_normalized = false;
    std::size_t count = 0;
  };
  /// Appends an array of its own; returns the accessor's index. The caller adds min and max.
  std::size_t add_accessor(std::span<const std::byte> bytes, Use use, const Accessor& accessor);

  /// The file. RESOURCE_EXHAUSTED above 4 GiB, which the format cannot hold.
  [[nodiscard]] Result<std::vector<std::byte>> finish() &&;

 private:
  std::vector<std::byte> buffer_;
};

}  // namespace radfarm
