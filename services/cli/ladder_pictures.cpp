#include "cli/ladder_pictures.h"

#include <algorithm>
#include <cmath>

#include "image/color_map.h"
#include "image/png.h"
#include "image/rgb.h"
#include "math/spectrum.h"

namespace radfarm::cli {
namespace {

constexpr const char* kChannels[] = {"R", "G", "B"};

/// The mean over columns [x0, x1) and rows [y0, y1).
float box_mean(const std::vector<float>& values, int width, int x0, int x1, int y0, int y1) {
  double sum = 0, count = 0;
  for (int y = y0; y < y1; ++y) {
    for (int x = x0; x < x1; ++x) {
      const float value = values[static_cast<std::size_t>(y) * static_cast<std::size_t>(width) + static_cast<std::size_t>(x)];
      if (std::isfinite(value)) sum += static_cast<double>(value), count += 1;
    }
  }
  return count > 0 ? static_cast<float>(sum / count) : 0;
}

double luminance_at(const RgbLayer& rgb, std::size_t i) { return luminance(SpectrumD(rgb.at(i))); }

}  // namespace

Image shrunk(const Image& image, int width) {
  Image small;
  small.width = std::min(image.width, width);
  small.height = std::max(1, image.height * small.width / image.width);
  for (const char* name : kChannels) {
    const std::vector<float>& from = image.channels.at(name);
    std::vector<float>& to = small.channels[name];
    for (int y = 0; y < small.height; ++y) {
      for (int x = 0; x < small.width; ++x) {
        to.push_back(box_mean(from, image.width, image.width * x / small.width, image.width * (x + 1) / small.width,
                              image.height * y / small.height, image.height * (y + 1) / small.height));
      }
    }
  }
  return small;
}

Image mean_of(const Image& a, const Image& b) {
  Image mean;
  mean.width = a.width, mean.height = a.height;
  for (const char* name : kChannels) {
    const std::vector<float>& from_a = a.channels.at(name);
    const std::vector<float>& from_b = b.channels.at(name);
    for (std::size_t i = 0; i < from_a.size(); ++i) mean.channels[name].push_back((from_a[i] + from_b[i]) / 2);
  }
  return mean;
}

Result<std::vector<std::byte>> difference_picture(const Image& image, const Image& reference, double most) {
  RADFARM_TRY(const RgbLayer x, rgb_layer(image));
  RADFARM_TRY(const RgbLayer r, rgb_layer(reference));
  double mean = 0;
  for (std::size_t i = 0; i < reference.pixel_count(); ++i) mean += luminance_at(r, i);
  const double floor = 0.01 * mean / static_cast<double>(std::max<std::size_t>(1, reference.pixel_count()));
  std::vector<Rgba8> pixels;
  for (std::size_t i = 0; i < reference.pixel_count(); ++i) {
    const double truth = luminance_at(r, i), off = std::fabs(luminance_at(x, i) - truth);
    pixels.push_back(viridis(static_cast<float>(off > 0 ? off / (truth + floor) / most : 0)));
  }
  return encode_png(static_cast<std::uint32_t>(reference.width), static_cast<std::uint32_t>(reference.height), pixels);
}

}  // namespace radfarm::cli
