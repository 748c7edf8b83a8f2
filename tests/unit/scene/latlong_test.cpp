#include "scene/latlong.h"

#include <cmath>
#include <numbers>

#include <gtest/gtest.h>

#include "base/random.h"

namespace radfarm {
namespace {

constexpr double kPiD = std::numbers::pi;

Environment map_of(std::uint32_t width, std::uint32_t height) {
  Environment e;
  e.width = width;
  e.height = height;
  for (std::uint32_t i = 0; i < width * height; ++i) e.radiance.push_back(Spectrum(to_unit_float(combine(1, i))));
  return e;
}

TEST(LatLong, RunsFromMinusZOverPlusX) {
  EXPECT_LT(length(direction_at({0, kPiD / 2}) - Vec3d(0, 0, -1)), 1e-15);
  EXPECT_LT(length(direction_at({kPiD / 2, kPiD / 2}) - Vec3d(1, 0, 0)), 1e-15);
  EXPECT_LT(length(direction_at({kPiD, kPiD / 2}) - Vec3d(0, 0, 1)), 1e-15);
  EXPECT_LT(length(direction_at({1, 0}) - Vec3d(0, 1, 0)), 1e-15);
  EXPECT_EQ(latlong_of({0, 1, 0}).longitude, 0);
  EXPECT_EQ(latlong_of({0, 1, -0.0}).longitude, 0);
  EXPECT_EQ(latlong_of({0, -2, 0}).colatitude, kPiD);
}

TEST(LatLong, ConversionsUndoEachOther) {
  RandomSequence random(1);
  for (int i = 0; i < 10'000; ++i) {
    // As near to the poles as one likes.
    const double near = std::pow(10.0, -8 * random.uniform_double());
    const LatLong place{2 * kPiD * random.uniform_double(), i % 2 == 0 ? near : kPiD - near};
    const LatLong again = latlong_of(direction_at(place));
    EXPECT_NEAR(again.longitude, place.longitude, 1e-14 + 1e-15 / near);
    EXPECT_NEAR(again.colatitude, place.colatitude, 1e-15);
  }
}

TEST(LatLongMap, HasTheTexelsValueInItsMiddle) {
  const Environment environment = map_of(8, 4);
  const LatLongMap map(environment);
  for (std::uint32_t row = 0; row < 4; ++row) {
    for (std::uint32_t column = 0; column < 8; ++column) {
      const LatLong middle{2 * kPiD * (column + 0.5) / 8, kPiD * (row + 0.5) / 4};
      EXPECT_NEAR(map.radiance(middle).g, environment.radiance[row * 8 + column].g, 1e-6F);
      EXPECT_EQ(map.texel_at(middle).row, row);
      EXPECT_EQ(map.texel_at(middle).column, column);
    }
  }
}

TEST(LatLongMap, WrapsAroundAndEndsAtThePoles) {
  Environment environment = map_of(4, 2);
  environment.radiance = {Spectrum(1), Spectrum(2), Spectrum(3), Spectrum(4),
                          Spectrum(5), Spectrum(6), Spectrum(7), Spectrum(8)};
  const LatLongMap map(environment);
  EXPECT_NEAR(map.radiance({0, 0}).r, 2.5F, 1e-6F);
  EXPECT_NEAR(map.radiance({2 * kPiD - 1e-9, 0}).r, 2.5F, 1e-6F);
  EXPECT_NEAR(map.radiance({kPiD / 4, 0}).r, 1, 1e-6F);
  EXPECT_NEAR(map.radiance({kPiD / 4, kPiD}).r, 5, 1e-6F);
  EXPECT_NEAR(map.radiance({kPiD / 4, kPiD / 2}).r, 3, 1e-6F);
}

TEST(LatLongMap, CellsAddUpToTheSphere) {
  for (const std::uint32_t height : {1U, 2U, 37U, 4096U}) {
    const Environment environment = map_of(2, height);
    const LatLongMap map(environment);
    double sum = 0;
    for (std::uint32_t row = 0; row < height; ++row) sum += 2 * map.solid_angle(row);
    EXPECT_NEAR(sum, 4 * kPiD, 1e-11);
  }
}

TEST(LatLongMap, IntegralsAreThoseOfWhatIsInterpolated) {
  for (const std::uint32_t height : {1U, 2U, 5U}) {
    const Environment environment = map_of(2 * height, height);
    const LatLongMap map(environment);
    double integrals = 0, sum = 0;
    for (std::uint32_t row = 0; row < height; ++row) {
      for (std::uint32_t column = 0; column < 2 * height; ++column) integrals += map.integral({row, column}).r;
    }
    constexpr int kSteps = 1000;
    for (int i = 0; i < kSteps; ++i) {
      const double colatitude = kPiD * (i + 0.5) / kSteps;
      for (int j = 0; j < 2 * kSteps; ++j) {
        sum += static_cast<double>(map.radiance({kPiD * (j + 0.5) / kSteps, colatitude}).r) * std::sin(colatitude);
      }
    }
    EXPECT_NEAR(integrals, sum * kPiD * kPiD / kSteps / kSteps, 1e-5 * integrals);
  }
}

TEST(LatLongMap, APlaceInATexelIsInIt) {
  const Environment environment = map_of(64, 32);
  const LatLongMap map(environment);
  for (const std::uint32_t row : {0U, 1U, 15U, 16U, 31U}) {
    for (const double u : {1e-6, 0.5, 1 - 1e-6}) {
      const auto texel = map.texel_at(map.place_in({row, 63}, u, u));
      EXPECT_EQ(texel.row, row);
      EXPECT_EQ(texel.column, 63U);
    }
  }
}

}  // namespace
}  // namespace radfarm
