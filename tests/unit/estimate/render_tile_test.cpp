#include "estimate/render_tile.h"

#include <algorithm>
#include <cmath>

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
  return render_tile(small_film(seed), rect, budget, rare_light, counters).light;
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
  const std::vector<PixelSums> pixels = render_tile(film, {0, 0, 1, 1}, kByNoise, rare_light, counters).light;
  EXPECT_EQ(pixels.at(0).samples, 8U);
}

/// The same noise everywhere; the left half looks at a plane, the right half at grass.
RadianceParts on_plane_and_grass(const Ray& ray, const PixelSampler& sampler, Counters&, FirstSurface* seen) {
  const bool is_left = ray.direction.x < 0;
  if (seen != nullptr) {
    const Vec3 blade = normalize(Vec3(sampler.one(5) - 0.5F, sampler.one(6) - 0.5F, 0.3F));
    *seen = {true, ray.direction / -ray.direction.z, is_left ? Vec3(0, 0, 1) : blade, Spectrum(0.5F), {}, kNone, kNone, {}};
  }
  return {{}, Spectrum(2 * sampler.one(9)), {}, {}};
}

TEST(RenderTile, PixelsThatCanShareGetFewerSamples) {
  Counters counters;
  const TilePixels tile = render_tile(small_film(), kWhole, {8, 1024, 0.01F}, on_plane_and_grass, counters, {false, true});
  double left = 0, right = 0;
  for (std::size_t i = 0; i < tile.light.size(); ++i) {
    const auto x = static_cast<int>(i) % kWidth;
    if (x < kWidth / 2 - 2) left += tile.light[i].samples;
    if (x >= kWidth / 2 + 2) right += tile.light[i].samples;
  }
  EXPECT_GT(right, 2 * left);
  EXPECT_LT(right, 4 * left);
}

TEST(RenderTile, SharingKeepsTheOddHalfApart) {
  Counters counters;
  const TilePixels tile = render_tile(small_film(), kWhole, {7, 7, 0}, on_plane_and_grass, counters, {false, true});
  ASSERT_EQ(tile.sharing.size(), tile.light.size());
  RunningStatistics products;  // of how far the halves are off
  for (std::size_t i = 0; i < tile.light.size(); ++i) {
    EXPECT_EQ(tile.light[i].samples, 7U);
    EXPECT_EQ(tile.sharing[i].samples, 3U);
    EXPECT_EQ(tile.sharing[i].hits, 7U);
    const double odd = luminance(tile.sharing[i].direct) / 3, all = luminance(tile.light[i].direct);
    products.add((odd - 1) * ((all - 3 * odd) / 4 - 1));
  }
  // Samples of one stratified set would be off in opposite directions. One false alarm in 16000.
  EXPECT_NEAR(products.mean(), 0, 4 * products.standard_error());
}

/// A lamp of 1000 cd/m^2 behind the edge x = .01, before a black wall.
RadianceParts lamp_behind_an_edge(const Ray& ray, const PixelSampler&, Counters& counters, FirstSurface*) {
  ++counters.camera_rays;
  return {Spectrum(ray.direction.x / -ray.direction.z > 0.01F ? 1000.0F : 0.0F), {}, {}, {}};
}

TEST(RenderTile, EdgesOfEmissionAreSampledFurther) {
  Counters counters;
  const SampleEmission emission = [](const Ray& ray, const PixelSampler& sampler, Counters& c) {
    return lamp_behind_an_edge(ray, sampler, c, nullptr).emission;
  };
  const SampleBudget budget{4, 1024, 0.1F};
  const Film film = small_film();
  const TilePixels tile = render_tile(film, kWhole, budget, lamp_behind_an_edge, counters, {}, emission);
  const double step = 2 * std::tan(0.5) / kHeight;  // of the film's plane, a pixel
  const double edge = 0.01 / step + kWidth / 2.0;
  for (int x = 0; x < kWidth; ++x) {
    PixelSums pixel = tile.light[static_cast<std::size_t>(5 * kWidth + x)];
    complete_emission(tile.needs[static_cast<std::size_t>(5 * kWidth + x)], pixel);
    const double share = std::clamp(x + 1 - edge, 0.0, 1.0);
    EXPECT_EQ(pixel.samples, 4U);
    // A stratified set of 1020 points cuts an interval to within one of them.
    EXPECT_NEAR(luminance(pixel.emission) / 4, 1000 * share, 2.0) << x;
  }
  EXPECT_LT(counters.camera_rays, static_cast<std::uint64_t>(kWidth * kHeight * 4 + 4 * kHeight * 1024)) << "only near the edge";
}

TEST(RenderTile, GoingOnGivesTheBitsOfAllAtOnce) {
  const SampleEmission emission = [](const Ray& ray, const PixelSampler& sampler, Counters& c) {
    return lamp_behind_an_edge(ray, sampler, c, nullptr).emission;
  };
  for (const float noise : {0.0F, 0.1F}) {
    SampleBudget budget{7, 128, noise};
    const Film film = small_film();
    const Kept kept{true, true};
    Counters gone_on, at_once;
    TilePixels tile = render_tile(film, kWhole, budget, on_plane_and_grass, gone_on, kept, emission);
    for (const double scale : {1.3, 2.0, 5.5}) {
      budget.scale = scale;
      tile = resume_tile(film, kWhole, budget, on_plane_and_grass, gone_on, kept, emission, tile);
    }
    const TilePixels once = render_tile(film, kWhole, budget, on_plane_and_grass, at_once, kept, emission);
    EXPECT_EQ(tile.light, once.light);
    EXPECT_EQ(tile.aovs, once.aovs);
    EXPECT_EQ(tile.sharing, once.sharing);
    EXPECT_EQ(tile.needs, once.needs);
  }
}

TEST(SampleBudget, NeverFallsAsTheScaleGrows) {
  const PixelNeeds needs{0.73, 1.91, {}, 0, 0};
  std::uint32_t light = 0, emission = 0;
  for (double scale = 1; scale < 40; scale *= 1.03) {
    const SampleBudget budget{4, 64, 0.05F, scale};
    EXPECT_GE(samples_of(budget, needs), light);
    EXPECT_GE(emission_samples_of(budget, needs), emission);
    light = samples_of(budget, needs), emission = emission_samples_of(budget, needs);
  }
  EXPECT_EQ(samples_of({4, 64, 0, 2.5}, needs), 10U) << "all alike";
}

}  // namespace
}  // namespace radfarm
