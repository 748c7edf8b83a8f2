#include "estimate/audit_pixels.h"

#include <algorithm>
#include <cmath>

#include "base/random.h"

namespace radfarm {
namespace {

constexpr std::uint64_t kAuditPixelKey = 0x6175646974;  // "audit"

}  // namespace

std::vector<AuditPixel> choose_audit_pixels(int width, int height, std::uint32_t wanted, std::uint64_t seed) {
  if (wanted == 0) return {};
  const double aspect = static_cast<double>(width) / height;
  const int columns = std::clamp(static_cast<int>(std::lround(std::sqrt(wanted * aspect))), 1, width);
  const int rows = std::clamp(static_cast<int>(std::lround(static_cast<double>(wanted) / columns)), 1, height);
  std::vector<AuditPixel> pixels;
  for (int row = 0; row < rows; ++row) {
    for (int column = 0; column < columns; ++column) {
      const int x0 = width * column / columns, x1 = width * (column + 1) / columns;
      const int y0 = height * row / rows, y1 = height * (row + 1) / rows;
      RandomSequence random(combine(seed, kAuditPixelKey, pixels.size()));
      const int x = x0 + static_cast<int>(random.uniform_double() * (x1 - x0));
      const int y = y0 + static_cast<int>(random.uniform_double() * (y1 - y0));
      const double weight = static_cast<double>(x1 - x0) * (y1 - y0) / (static_cast<double>(width) * height);
      pixels.push_back({x, y, weight});
    }
  }
  return pixels;
}

}  // namespace radfarm
