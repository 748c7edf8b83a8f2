#include "sharing/planes.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace radfarm {
namespace {

constexpr int kVarianceRadius = 2;

void resize(Planes& planes) {
  const auto size = static_cast<std::size_t>(planes.stride()) * static_cast<std::size_t>(planes.height + 2 * Planes::kBorder);
  const auto clear = [&](Plane& plane) { plane.assign(size, 0); };
  clear(planes.shares), clear(planes.footprint);
  for (Plane& plane : planes.normal) clear(plane);
  for (Plane& plane : planes.position) clear(plane);
  for (Planes::Part& part : planes.parts) {
    clear(part.variance);
    for (int half = 0; half < 2; ++half) {
      clear(part.luminance[half]);
      for (Plane& plane : part.irradiance[half]) clear(plane);
    }
  }
}

bool can_share(const PixelSums& pixel, const SharingSums& sums) {
  const bool has_halves = sums.samples > 0 && pixel.samples > sums.samples;
  return has_halves && sums.hits > 0 && luminance(pixel.emission) == 0 &&
         luminance(sums.albedo) > kLeastAlbedo * static_cast<double>(pixel.samples) && length(sums.normal) > 0;
}

/// Mean light of a half over mean albedo, by channel.
void set_half(Planes::Part& part, int half, std::size_t at, const SpectrumD& light, double samples, const SpectrumD& albedo) {
  const auto ratio = [&](double of, double by) { return by > kLeastAlbedo ? static_cast<float>(of / samples / by) : 0.0F; };
  const Spectrum e(ratio(light.r, albedo.r), ratio(light.g, albedo.g), ratio(light.b, albedo.b));
  part.irradiance[half][0][at] = e.r, part.irradiance[half][1][at] = e.g, part.irradiance[half][2][at] = e.b;
  part.luminance[half][at] = luminance(e);
}

void set_pixel(Planes& planes, std::size_t at, const PixelSums& pixel, const SharingSums& sums) {
  planes.shares[at] = 1;
  const Vec3d normal = normalize(sums.normal), position = sums.position / static_cast<double>(sums.hits);
  for (int k = 0; k < 3; ++k) {
    planes.normal[k][at] = static_cast<float>(normal[k]);
    planes.position[k][at] = static_cast<float>(position[k]);
  }
  const SpectrumD albedo = sums.albedo / static_cast<double>(pixel.samples);
  const double odd = sums.samples, even = pixel.samples - sums.samples;
  set_half(planes.parts[0], 0, at, pixel.direct - sums.direct, even, albedo);
  set_half(planes.parts[0], 1, at, sums.direct, odd, albedo);
  set_half(planes.parts[1], 0, at, pixel.indirect - sums.indirect, even, albedo);
  set_half(planes.parts[1], 1, at, sums.indirect, odd, albedo);
}

Vec3 position_at(const Planes& planes, std::size_t at) {
  return {planes.position[0][at], planes.position[1][at], planes.position[2][at]};
}

float footprint(const Planes& planes, int x, int y) {
  float nearest = std::numeric_limits<float>::infinity();
  const Vec3 here = position_at(planes, planes.index(x, y));
  for (const auto& [i, j] : {std::pair(x - 1, y), std::pair(x + 1, y), std::pair(x, y - 1), std::pair(x, y + 1)}) {
    const std::size_t at = planes.index(i, j);
    if (planes.shares[at] > 0) nearest = std::min(nearest, length(position_at(planes, at) - here));
  }
  return nearest;
}

std::size_t row_by_row(const Planes& planes, int x, int y) {
  return static_cast<std::size_t>(y) * static_cast<std::size_t>(planes.width) + static_cast<std::size_t>(x);
}

/// The variance of one sample about a pixel, from how the halves of its neighbours differ, over the samples of a half.
float variance(const Planes& planes, const Planes::Part& part, std::span<const PixelSums> pixels, int x, int y) {
  double sum = 0;
  int count = 0;
  for (int j = std::max(0, y - kVarianceRadius); j <= std::min(planes.height - 1, y + kVarianceRadius); ++j) {
    for (int i = std::max(0, x - kVarianceRadius); i <= std::min(planes.width - 1, x + kVarianceRadius); ++i) {
      const std::size_t at = planes.index(i, j);
      if (!(planes.shares[at] > 0)) continue;
      const auto apart = static_cast<double>(part.luminance[0][at] - part.luminance[1][at]);
      sum += apart * apart / 2 * pixels[row_by_row(planes, i, j)].samples;
      ++count;
    }
  }
  return static_cast<float>(sum / count / pixels[row_by_row(planes, x, y)].samples);
}

}  // namespace

Planes make_planes(int width, int height, std::span<const PixelSums> pixels, std::span<const SharingSums> sums) {
  Planes planes;
  planes.width = width, planes.height = height;
  resize(planes);
  std::size_t next = 0;
  for (int y = 0; y < height; ++y) {
    for (int x = 0; x < width; ++x, ++next) {
      if (can_share(pixels[next], sums[next])) set_pixel(planes, planes.index(x, y), pixels[next], sums[next]);
    }
  }
  for (int y = 0; y < height; ++y) {
    for (int x = 0; x < width; ++x) {
      const std::size_t at = planes.index(x, y);
      if (!(planes.shares[at] > 0)) continue;
      planes.footprint[at] = footprint(planes, x, y);
      for (Planes::Part& part : planes.parts) part.variance[at] = variance(planes, part, pixels, x, y);
    }
  }
  return planes;
}

}  // namespace radfarm
