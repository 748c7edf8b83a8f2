#include "estimate/aov_sums.h"

#include <cmath>

#include <gtest/gtest.h>

#include "estimate/render_tile.h"

namespace radfarm {
namespace {

/// What sample i of a made-up integrator sees: nothing, every third time.
FirstSurface seen_by(std::uint32_t i) {
  if (i % 3 == 2) return {};
  const auto x = static_cast<float>(i + 1);
  return {true, {x, 0, -2 * x}, {0, 1, 0}, Spectrum(0.5F), Spectrum(x, 0, 0), 10 + i, 20 + i, {i, 1, 0, 1}};
}

TEST(AovSums, AreMeansOfWhatIsSeenAndTheFirstCell) {
  AovSums sums;
  for (std::uint32_t i = 2; i < 6; ++i) sums.add(seen_by(i), 2);
  EXPECT_EQ(sums.hits, 2U);
  EXPECT_EQ(sums.albedo, SpectrumD(1.0));
  EXPECT_EQ(sums.normal, Vec3d(0, 2, 0));
  EXPECT_EQ(sums.irradiance, SpectrumD(4 + 5, 0, 0));
  EXPECT_EQ(sums.depth, 4);
  EXPECT_EQ(sums.cell, 13U);
  EXPECT_EQ(sums.vertex, 23U);
  EXPECT_EQ(sums.classified, 2U);
  EXPECT_DOUBLE_EQ(sums.classes[0], 3.0 / 5 + 4.0 / 6);
  EXPECT_DOUBLE_EQ(sums.classes[1], 1.0 / 5 + 1.0 / 6);
  EXPECT_EQ(sums.classes[2], 0);
}

TEST(AovSums, VerticesWithoutSendersHaveNoShares) {
  AovSums sums;
  FirstSurface seen = seen_by(0);
  seen.classes = {};
  sums.add(seen, 1);
  EXPECT_EQ(sums.hits, 1U);
  EXPECT_EQ(sums.classified, 0U);
}

/// A pixel by an integrator that counts, and whose second sample is not finite.
class AovsOfAPixel : public testing::Test {
 protected:
  TilePixels sample(std::uint32_t count, bool keeps_aovs) {
    std::uint32_t i = 0;
    const SampleRadiance radiance = [&](const Ray&, const PixelSampler& sampler, Counters& c, FirstSurface* seen) {
      EXPECT_EQ(seen != nullptr, keeps_aovs);
      if (seen != nullptr) *seen = seen_by(i);
      ++c.camera_rays;
      c.visibility_rays += i;
      const bool is_lost = i++ == 1;
      return RadianceParts{{}, Spectrum(is_lost ? std::nanf("") : sampler.one(9)), {}, {}};
    };
    return render_tile(film_, {3, 4, 4, 5}, {count, count, 0}, radiance, counters_, {keeps_aovs, false});
  }
  Film film_{Camera(), 8, 8, 1};
  Counters counters_{};
};

TEST_F(AovsOfAPixel, GiveTheSameLightAsWithoutThem) { EXPECT_EQ(sample(6, true).light, sample(6, false).light); }

TEST_F(AovsOfAPixel, CountAllSamplesAndHaveWhatKeptOnesSaw) {
  const TilePixels pixel = sample(6, true);
  const AovSums& aovs = pixel.aovs.at(0);
  EXPECT_EQ(pixel.light.at(0).dropped, 1U);
  EXPECT_EQ(counters_.dropped_samples, 1U);
  EXPECT_EQ(aovs.camera_rays, 6U);
  EXPECT_EQ(aovs.visibility_rays, 0U + 1 + 2 + 3 + 4 + 5);
  EXPECT_EQ(aovs.hits, 3U) << "0, 3 and 4: 1 is dropped, 2 and 5 see nothing";
  // The camera looks along -z from the origin: 2 m a step.
  EXPECT_EQ(film_.camera.forward, Vec3(0, 0, -1));
  EXPECT_EQ(aovs.depth, 2 * (1 + 4 + 5));
}

}  // namespace
}  // namespace radfarm
