#include "estimate/render_tile.h"

#include <gtest/gtest.h>

#include "base/random.h"
#include "math/statistics.h"

namespace radfarm {
namespace {

constexpr int kWidth = 24, kHeight = 16;

Film small_film(std::uint64_t seed = 1) {
  Film film;
  film.camera.vertical_fov = 1;
  film.width = kWidth;
  film.height = kHeight;
  film.seed = seed;
  return film;
}

/// Light of mean 1 that is seldom and much in the left half of the film, and 1 in the right half.
RadianceParts rare_light(const Ray& ray, const PixelSampler& sampler, Counters& counters, FirstSurface*) {
  ++counters.camera_rays;
  RadianceParts parts;
  const bool is_left = ray.direction.x < 0;
  parts.direct = Spectrum(!is_left ? 1.0F : to_unit_float(sampler.key(99)) < 0.02F ? 50.0F : 0.0F);
  return parts;
}

std::vector<PixelSums> render(const PixelRect& rect, const SampleBudget& budget, std::uint64_t seed = 1) {
  Counters counters;
  return render_tile(small_film(seed), rect, budget, rare_light, counters);
}

constexpr PixelRect kWhole{0, 0, kWidth, kHeight};
constexpr SampleBudget kByNoise{8, 128, 0.1F};

TEST(RenderTile, WithoutNoiseEachPixelGetsTheFirstSamples) {
  for (const PixelSums& pixel : render(kWhole, {8, 128, 0})) EXPECT_EQ(pixel.samples, 8U);
}

TEST(RenderTile, NoisyPixelsGetMoreSamples) {
  const std::vector<PixelSums> pixels = render(kWhole, kByNoise);
  std::uint32_t left = 0, right = 0;
  for (int y = 0; y < kHeight; ++y) {
    for (int x = 0; x < kWidth; ++x) {
      const std::uint32_t samples = pixels[static_cast<std::size_t>(y * kWidth + x)].samples;
      EXPECT_TRUE(samples >= kByNoise.first && samples <= kByNoise.most);
      (x < kWidth / 2 ? left : right) += samples;
    }
  }
  EXPECT_GT(left, 4 * right);
}

TEST(RenderTile, TheSameBitsInAnyTile) {
  const std::vector<PixelSums> whole = render(kWhole, kByNoise);
  for (const int side : {1, 5, 7}) {
    for (int y0 = 0; y0 < kHeight; y0 += side) {
      for (int x0 = 0; x0 < kWidth; x0 += side) {
        const PixelRect rect{x0, y0, std::min(kWidth, x0 + side), std::min(kHeight, y0 + side)};
        const std::vector<PixelSums> tile = render(rect, kByNoise);
        for (int y = rect.y0; y < rect.y1; ++y) {
          for (int x = rect.x0; x < rect.x1; ++x) {
            ASSERT_EQ(tile[static_cast<std::size_t>((y - rect.y0) * rect.width() + x - rect.x0)],
                      whole[static_cast<std::size_t>(y * kWidth + x)]);
          }
        }
      }
    }
  }
}

// A pixel that decides for itself stops early when rare light has not come yet: with 8 of these samples that loses most of it.
TEST(RenderTile, RareLightIsNotLostToStopping) {
  RunningStatistics means;
  for (std::uint64_t seed = 1; seed <= 200; ++seed) {
    const std::vector<PixelSums> pixels = render(kWhole, kByNoise, seed);
    double sum = 0;
    for (int y = 0; y < kHeight; ++y) {
      for (int x = 0; x < kWidth / 2; ++x) {
        const PixelSums& pixel = pixels[static_cast<std::size_t>(y * kWidth + x)];
        sum += luminance(pixel.reflected()) / pixel.samples;
      }
    }
    means.add(sum / (kHeight * kWidth / 2));
  }
  // One false alarm in 16000.
  EXPECT_NEAR(means.mean(), 1, 4 * means.standard_error());
}

TEST(RenderTile, APixelWithoutNeighboursGetsTheFirstSamples) {
  Film film = small_film();
  film.width = film.height = 1;
  Counters counters;
  const std::vector<PixelSums> pixels = render_tile(film, {0, 0, 1, 1}, kByNoise, rare_light, counters);
  EXPECT_EQ(pixels.at(0).samples, 8U);
}

}  // namespace
}  // namespace radfarm
