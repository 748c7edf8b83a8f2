#pragma once

#include <cstddef>
#include <span>
#include <vector>

#include "base/status.h"
#include "estimate/aov_sums.h"
#include "estimate/counters.h"
#include "estimate/pixel_sums.h"
#include "estimate/render_tile.h"
#include "estimate/sample_budget.h"
#include "estimate/sharing_sums.h"

namespace radfarm {

/// What a tile task returns.
struct TileResult {
  PixelRect rect;
  std::vector<PixelSums> pixels;  // row by row
  std::vector<AovSums> aovs;          // the same, or empty: nobody asked
  std::vector<SharingSums> sharing;   // the same, or empty: pixels do not share
  std::vector<PixelNeeds> needs;      // the same, or empty: all get the same number of samples
  Counters counters;
  friend bool operator==(const TileResult&, const TileResult&) = default;
};

/// What an audit task returns: two independent estimates of each of its pixels.
struct AuditResult {
  struct Pixel {
    std::int32_t x = 0;
    std::int32_t y = 0;
    PixelSums first;
    PixelSums second;
    friend bool operator==(const Pixel&, const Pixel&) = default;
  };
  std::vector<Pixel> pixels;
  Counters counters;
  friend bool operator==(const AuditResult&, const AuditResult&) = default;
};

/// Flat files of kinds "tile" and "audit" (docs/formats.md). Decoding checks sizes: hostile bytes give DATA_LOSS.
[[nodiscard]] std::vector<std::byte> encode(const TileResult& result);
[[nodiscard]] std::vector<std::byte> encode(const AuditResult& result);
Result<TileResult> decode_tile_result(std::span<const std::byte> bytes);
Result<AuditResult> decode_audit_result(std::span<const std::byte> bytes);

}  // namespace radfarm
