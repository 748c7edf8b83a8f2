#include "sharing/share_light.h"

#include <algorithm>
#include <numbers>

#include "base/parallel.h"
#include "sharing/likeness.h"
#include "sharing/local_fit.h"

namespace radfarm {
namespace {

constexpr int kBlockWidth = 32, kBlockHeight = 16;

std::vector<PixelBlock> cut_blocks(int width, int height) {
  std::vector<PixelBlock> blocks;
  for (int y = 0; y < height; y += kBlockHeight) {
    for (int x = 0; x < width; x += kBlockWidth) {
      blocks.push_back({x, y, std::min(width, x + kBlockWidth), std::min(height, y + kBlockHeight)});
    }
  }
  return blocks;
}

/// One part's light of a block, of one half, as its neighbours and it tell.
struct Fit {
  int part, half;
  LocalFits fits;
};

void add_neighbours(const Planes& planes, const PixelBlock& block, int dx, int dy, const Likeness& likeness,
                    const std::vector<float>& weights, Fit& fit) {
  const auto n = static_cast<std::size_t>(block.width());
  for (int y = block.y0; y < block.y1; ++y) {
    const std::size_t first = static_cast<std::size_t>(y - block.y0) * n, there = planes.index(block.x0 + dx, y + dy);
    std::array<const float*, 4> features;
    for (int k = 0; k < 4; ++k) features[k] = likeness.features()[k].data() + first;
    std::array<const float*, 3> values;
    for (int c = 0; c < 3; ++c) values[c] = planes.parts[fit.part].irradiance[fit.half][c].data() + there;
    fit.fits.add(first, n, weights.data() + first, features, values);
  }
}

SpectrumD fitted(const Fit& fit, std::size_t lane) {
  const std::array<double, 3> at = fit.fits.at_zero(lane);
  return {std::max(0.0, at[0]), std::max(0.0, at[1]), std::max(0.0, at[2])};
}

/// Sums of a pixel's reflected light: the fit's, or its own where hardly anything is reflected.
SpectrumD reflected(const SpectrumD& albedo_sum, double samples, const SpectrumD& fit, const SpectrumD& own) {
  const auto channel = [&](double albedo, double light, double before) {
    return albedo > kLeastAlbedo * samples ? albedo * light : before;
  };
  return {channel(albedo_sum.r, fit.r, own.r), channel(albedo_sum.g, fit.g, own.g), channel(albedo_sum.b, fit.b, own.b)};
}

/// The mean of what both halves tell of a part's light.
SpectrumD mean_of(const Fit& first, const Fit& second, std::size_t lane) {
  return (fitted(first, lane) + fitted(second, lane)) / 2.0;
}

/// What a pixel receives changes by what it reflects.
void follow(const SpectrumD& change, const SharingSums& sums, double samples, AovSums& aovs) {
  const auto channel = [&](double& irradiance, double albedo, double of) {
    if (albedo > kLeastAlbedo * samples) irradiance = std::max(0.0, irradiance + std::numbers::pi * of / albedo * aovs.hits);
  };
  channel(aovs.irradiance.r, sums.albedo.r, change.r);
  channel(aovs.irradiance.g, sums.albedo.g, change.g);
  channel(aovs.irradiance.b, sums.albedo.b, change.b);
}

struct Pixels {
  std::span<const SharingSums> sums;
  std::span<PixelSums> light;
  std::span<AovSums> aovs;
  std::span<float> noise;
};

/// Variance of a pixel's mean that the halves' fits show, and what of its own is of specular light, which is not shared.
float shared_noise(const PixelSums& own, const SharingSums& sums, const std::vector<Fit>& fits, std::size_t lane) {
  const auto half = [&](std::size_t h) {
    return luminance(reflected(sums.albedo, own.samples, fitted(fits[h], lane), own.direct) +
                     reflected(sums.albedo, own.samples, fitted(fits[2 + h], lane), own.indirect));
  };
  const double n = own.samples, off = (half(0) - half(1)) / (2 * n), all = luminance(own.reflected());
  const double specular = all > 0 && own.samples > 1 ? luminance(own.specular) / all : 0;
  return static_cast<float>(off * off + (specular > 0 ? specular * specular * variance_of_mean(own) : 0));
}

void replace_light(const Pixels& pixels, std::size_t i, const std::vector<Fit>& fits, std::size_t lane) {
  PixelSums& pixel = pixels.light[i];
  const SharingSums& sums = pixels.sums[i];
  const SpectrumD before = pixel.direct + pixel.indirect;
  const double mean_before = luminance(pixel.reflected()) / pixel.samples;
  pixels.noise[i] = shared_noise(pixel, sums, fits, lane);
  pixel.direct = reflected(sums.albedo, pixel.samples, mean_of(fits[0], fits[1], lane), pixel.direct);
  pixel.indirect = reflected(sums.albedo, pixel.samples, mean_of(fits[2], fits[3], lane), pixel.indirect);
  const double mean = luminance(pixel.reflected()) / pixel.samples;
  pixel.squared_luminance += (mean * mean - mean_before * mean_before) * pixel.samples;  // the samples scatter as before
  if (!pixels.aovs.empty()) follow(pixel.direct + pixel.indirect - before, sums, pixel.samples, pixels.aovs[i]);
}

void share_block(const Planes& planes, const PixelBlock& block, const Pixels& pixels) {
  Likeness likeness(planes, block);
  std::vector<Fit> fits;
  for (int part = 0; part < 2; ++part) {
    for (int half = 0; half < 2; ++half) fits.push_back({part, half, LocalFits(block.lanes())});
  }
  std::vector<float> weights(block.lanes());
  for (int dy = -kShareRadius; dy <= kShareRadius; ++dy) {
    for (int dx = -kShareRadius; dx <= kShareRadius; ++dx) {
      likeness.move_to(dx, dy);
      for (Fit& fit : fits) {
        likeness.weigh(planes.parts[fit.part], 1 - fit.half, weights);
        add_neighbours(planes, block, dx, dy, likeness, weights, fit);
      }
    }
  }
  std::size_t lane = 0;
  for (int y = block.y0; y < block.y1; ++y) {
    for (int x = block.x0; x < block.x1; ++x, ++lane) {
      if (!(planes.shares[planes.index(x, y)] > 0)) continue;
      const std::size_t i = static_cast<std::size_t>(y) * static_cast<std::size_t>(planes.width) + static_cast<std::size_t>(x);
      replace_light(pixels, i, fits, lane);
    }
  }
}

}  // namespace

std::vector<float> share_light(int width, int height, std::span<const SharingSums> sums, std::span<PixelSums> pixels,
                               std::span<AovSums> aovs) {
  const Planes planes = make_planes(width, height, pixels, sums);
  const std::vector<PixelBlock> blocks = cut_blocks(width, height);
  std::vector<float> noise(pixels.size());
  std::transform(pixels.begin(), pixels.end(), noise.begin(), [](const PixelSums& p) { return noise_of(p); });
  parallel_for(blocks.size(), 1, [&](std::size_t begin, std::size_t end) {
    for (std::size_t b = begin; b < end; ++b) share_block(planes, blocks[b], {sums, pixels, aovs, noise});
  });
  return noise;
}

}  // namespace radfarm
