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

/// An integrator that counts, and whose second sample is not finite.
class SamplePixel : public testing::Test {
 protected:
  PixelSums sample(std::uint32_t first, std::uint32_t count, AovSums* aovs) {
    std::uint32_t i = first;
    const SampleRadiance radiance = [&](const Ray&, const PixelSampler& sampler, Counters& c, FirstSurface* seen) {
      EXPECT_EQ(seen != nullptr, aovs != nullptr);
      if (seen != nullptr) *seen = seen_by(i);
      ++c.camera_rays;
      c.visibility_rays += i;
      const bool is_lost = i++ == 1;
      return RadianceParts{{}, Spectrum(is_lost ? std::nanf("") : sampler.one(9)), {}, {}};
    };
    return sample_pixel(film_, Stream::kRender, 3, 4, first, count, radiance, counters_, aovs);
  }
  Film film_{Camera(), 8, 8, 1};
  Counters counters_{};
};

TEST_F(SamplePixel, GivesTheSameLightWithAndWithoutAovs) {
  AovSums aovs;
  EXPECT_EQ(sample(0, 6, &aovs), sample(0, 6, nullptr));
}

TEST_F(SamplePixel, CountsAllSamplesAndAddsWhatKeptOnesSaw) {
  AovSums aovs;
  const PixelSums pixel = sample(0, 6, &aovs);
  EXPECT_EQ(pixel.dropped, 1U);
  EXPECT_EQ(aovs.camera_rays, 6U);
  EXPECT_EQ(aovs.visibility_rays, 0U + 1 + 2 + 3 + 4 + 5);
  EXPECT_EQ(aovs.hits, 3U) << "0, 3 and 4: 1 is dropped, 2 and 5 see nothing";
  // The camera looks along -z from the origin: 2 m a step.
  EXPECT_EQ(film_.camera.forward, Vec3(0, 0, -1));
  EXPECT_EQ(aovs.depth, 2 * (1 + 4 + 5));
}

TEST_F(SamplePixel, ContinuesSums) {
  AovSums whole, parts, rest;
  sample(0, 6, &whole);
  sample(0, 2, &parts);
  sample(2, 4, &rest);
  EXPECT_EQ(parts.camera_rays + rest.camera_rays, whole.camera_rays);
  EXPECT_EQ(parts.hits + rest.hits, whole.hits);
  EXPECT_EQ(parts.cell, whole.cell);
}

}  // namespace
}  // namespace radfarm
