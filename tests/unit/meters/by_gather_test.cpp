#include "meters/by_gather.h"

#include <cmath>
#include <numbers>

#include <gtest/gtest.h>

#include "support/small_scenes.h"

namespace radfarm {
namespace {

/// O20: a cube of side 4 m with an even point light of 10,000 lm at its centre.
Scene cube_room(float reflectance) {
  test::SceneMaker maker;
  const auto grey = maker.material(Spectrum(reflectance));
  maker.room(std::vector<std::uint32_t>(6, grey), {-2, -2, -2}, {2, 2, 2});
  PunctualLight light;
  light.intensity = Spectrum(10000 / (4 * kPi));
  maker.light(light);
  return maker.take();
}

TEST(MeasureByGather, PointLightInFreeSpace) {  // O15
  const World world(cube_room(0));
  const std::vector<Meter> meters{{{0, -1, 0}, {0, 1, 0}}, {{1, -1, 0}, {0, 1, 0}}, {{0, -1, 0}, {0, -1, 0}}};
  const auto readings = measure_by_gather(world, meters, {});
  const double candela = 10000 / (4 * std::numbers::pi);
  EXPECT_NEAR(readings[0].lux(), candela, 1e-3 * candela);
  EXPECT_NEAR(readings[1].lux(), candela * std::pow(2, -1.5), 1e-3 * candela);
  EXPECT_EQ(readings[2].lux(), 0);
}

TEST(MeasureByGather, SamplesGivenAreSamplesTaken) {
  const World world(cube_room(.5F));
  GatherMeterSettings settings;
  settings.samples = 320;
  const auto readings = measure_by_gather(world, std::vector<Meter>{{{0, -1, 0}, {0, 1, 0}}}, settings);
  EXPECT_EQ(readings[0].samples, 320U);
  EXPECT_GT(readings[0].half_width, 0);
}

TEST(MeasureByGather, ReachesTheErrorThatItIsAskedFor) {
  const World world(cube_room(.5F));
  std::vector<Meter> meters;
  for (int i = 0; i < 16; ++i) meters.push_back({{-1.5F + .2F * static_cast<float>(i), -1, .3F}, {0, 1, 0}});
  const auto readings = measure_by_gather(world, meters, {});
  for (const Reading& reading : readings) EXPECT_LT(reading.half_width, 2 * .02 * reading.lux());
}

}  // namespace
}  // namespace radfarm
