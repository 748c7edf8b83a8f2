#include "meters/by_paths.h"

#include <gtest/gtest.h>

#include "meters/by_gather.h"
#include "support/small_scenes.h"

namespace radfarm {
namespace {

Scene room() {
  test::SceneMaker maker;
  const auto grey = maker.material(Spectrum(.5F)), red = maker.material({.8F, .2F, .1F});
  const auto lamp = maker.material(Spectrum(0.0F), Spectrum(100.0F));
  maker.room({grey, grey, red, grey, grey, grey}, {-2, 0, -2}, {2, 3, 2});
  maker.polygon(lamp, {{-.5F, 2.9F, -.5F}, {.5F, 2.9F, -.5F}, {.5F, 2.9F, .5F}, {-.5F, 2.9F, .5F}});
  return maker.take();
}

TEST(MeasureByPaths, AgreesWithGatherInEachChannel) {
  const World world(room());
  std::vector<Meter> meters;
  for (int i = 0; i < 8; ++i) meters.push_back({{-1.4F + .4F * static_cast<float>(i), .85F, .5F}, {0, 1, 0}});
  meters.push_back({{1, 1.2F, 0}, {-1, 0, 0}});
  PathMeterSettings settings;
  settings.paths = 1600000;
  settings.most = .15F;
  const PathReadings paths = measure_by_paths(world, meters, settings);
  GatherMeterSettings exact;
  exact.error = .004;
  const auto gathered = measure_by_gather(world, meters, exact);
  for (std::size_t i = 0; i < meters.size(); ++i) {
    const Reading& a = paths.readings[i];
    const Reading& b = gathered[i];
    EXPECT_NEAR(a.lux(), b.lux(), 3 * (a.half_width + b.half_width)) << i;
    EXPECT_LT(a.half_width, .1 * a.lux());
    EXPECT_GT(a.samples, 100U);
    EXPECT_NEAR(a.irradiance.r / a.irradiance.b, b.irradiance.r / b.irradiance.b, .1 * b.irradiance.r / b.irradiance.b);
  }
}

TEST(MeasureByPaths, WhereNoPathCameTheIntervalStillHasAWidth) {
  const World world(room());
  PathMeterSettings settings;
  settings.paths = 1600;
  settings.radius = .01F;
  const Reading reading =
      measure_by_paths(world, std::vector<Meter>{{{-1.9F, .05F, -1.9F}, {0, 1, 0}}}, settings).readings[0];
  ASSERT_EQ(reading.samples, 0U);
  EXPECT_NEAR(reading.half_width, 3 * world.emitters.total_flux / (1600 * 3.14159265 * 1e-4),
              1e-3 * reading.half_width);
}

TEST(MeasureByPaths, RadiusIsTheOneGiven) {
  const World world(room());
  PathMeterSettings settings;
  settings.paths = 1600;
  settings.radius = .3F;
  const PathReadings paths = measure_by_paths(world, std::vector<Meter>{{{0, 1, 0}, {0, 1, 0}}}, settings);
  EXPECT_EQ(paths.radii, std::vector<float>{.3F});
}

}  // namespace
}  // namespace radfarm
