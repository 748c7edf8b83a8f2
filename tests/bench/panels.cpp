#include "bench/panels.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>

#include "base/file.h"
#include "image/png.h"

namespace radfarm::bench {
namespace {

using Pixel = std::array<std::uint8_t, 4>;
constexpr int kGap = 4;  // pixels
constexpr Pixel kLine{255, 255, 255, 255};

Pixel shade(double value) {
  const double v = std::clamp(value, 0.0, 1.0);
  const double srgb = v <= .0031308 ? 12.92 * v : 1.055 * std::pow(v, 1 / 2.4) - .055;
  const auto grey = static_cast<std::uint8_t>(std::lround(255 * srgb));
  return {grey, grey, grey, 255};
}

}  // namespace

Status write_panels(const std::filesystem::path& file, const std::vector<std::vector<Panel>>& rows, double white,
                    int scale) {
  const int across = rows[0][0].width * scale, down = rows[0][0].height * scale;
  const int columns = static_cast<int>(rows[0].size());
  const int width = columns * (across + kGap) - kGap, height = static_cast<int>(rows.size()) * (down + kGap) - kGap;
  std::vector<Pixel> pixels(static_cast<std::size_t>(width) * static_cast<std::size_t>(height), kLine);
  for (int y = 0; y < height; ++y) {
    for (int x = 0; x < width; ++x) {
      const int row = y / (down + kGap), column = x / (across + kGap);
      const int in_y = y % (down + kGap), in_x = x % (across + kGap);
      const auto& line = rows[static_cast<std::size_t>(row)];
      if (in_y >= down || in_x >= across || static_cast<std::size_t>(column) >= line.size()) continue;
      const Panel& panel = line[static_cast<std::size_t>(column)];
      const double value = panel.values[static_cast<std::size_t>(in_y / scale * panel.width + in_x / scale)];
      pixels[static_cast<std::size_t>(y * width + x)] = shade(value / white);
    }
  }
  RADFARM_TRY(const std::vector<std::byte> png,
              encode_png(static_cast<std::uint32_t>(width), static_cast<std::uint32_t>(height), pixels));
  return write_file_atomically(file, png);
}

double quantile_of(const Panel& panel, double share) {
  std::vector<double> sorted = panel.values;
  std::sort(sorted.begin(), sorted.end());
  return sorted[static_cast<std::size_t>(share * static_cast<double>(sorted.size() - 1))];
}

}  // namespace radfarm::bench
