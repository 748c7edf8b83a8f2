// Rays through panes: how often they go on, and what they weigh.
#include <array>
#include <cmath>

#include <gtest/gtest.h>

#include "base/random.h"
#include "math/statistics.h"
#include "scene/world.h"
#include "support/small_scenes.h"
#include "support/statistics.h"

namespace radfarm {
namespace {

constexpr int kRays = 100'000;
// One false alarm in a million runs of this file: 3 angles, each with a count and 3 + 3 channels, for 3 panes.
const double kLevel = test::sidak_level(1e-6, 63);

/// A pane of 8 m at z = 0 before a wall at z = -2.
Scene glazed_wall(const Spectrum& color, float coverage) {
  test::SceneMaker maker;
  const std::uint32_t glass = maker.material(color), wall = maker.material(Spectrum(0.5F));
  for (const auto& [material, z] : {std::pair(glass, 0.0F), std::pair(wall, -2.0F)}) {
    maker.polygon(material, {{-9, -9, z}, {9, -9, z}, {9, 9, z}, {-9, 9, z}});
  }
  Scene scene = maker.take();
  Material& m = scene.materials[glass];
  m.transmission = m.specular = 1;
  m.roughness = 0;
  if (coverage < 1) m.alpha_mode = Material::Alpha::kBlend, m.alpha = coverage;
  return scene;
}

void expect_mean(const RunningStatistics& measured, double truth) {
  // Where all rays weigh the same, rounding is all that is left.
  const double error = std::hypot(measured.standard_error(), 1e-6);
  EXPECT_GT(test::z_test(measured.mean(), error, truth), kLevel) << measured.mean() << ", should be " << truth;
}

TEST(PanesByChance, PassAndStopWithTheRightMeans) {
  struct Pane {
    Spectrum color;
    float coverage;
  };
  for (const Pane& pane : {Pane{Spectrum(1.0F), 1}, Pane{{0.25F, 0.5F, 1}, 1}, Pane{{0.75F, 0.5F, 0.25F}, 0.5F}}) {
    const World world(glazed_wall(pane.color, pane.coverage));
    for (const float slope : {0.0F, 1.0F, 3.0F}) {
      const Vec3 way = normalize(Vec3(slope, 0.1F, -1));
      const Vec3 middle(0.3F, -0.2F, 0);  // off the diagonal: there both triangles are met
      const Vec3 start = middle - way * 0.5F;
      const Spectrum passage = world.caster.transmittance(start, middle + way * 0.5F);
      RunningStatistics on;
      std::array<RunningStatistics, 3> past, stopped;
      for (int i = 0; i < kRays; ++i) {
        const auto hit = world.caster.closest({start, way}, combine(9, static_cast<std::uint64_t>(i)));
        ASSERT_TRUE(hit);
        const bool is_on = hit->instance == 1;
        on.add(is_on ? 1 : 0);
        const SpectrumD weight(hit->weight);
        const std::array<double, 3> w = {weight.r, weight.g, weight.b};
        for (std::size_t k = 0; k < 3; ++k) {
          past[k].add(is_on ? w[k] : 0);
          stopped[k].add(is_on ? 0 : w[k]);
        }
      }
      expect_mean(on, static_cast<double>(max_component(passage)));
      expect_mean(past[0], static_cast<double>(passage.r));
      expect_mean(past[1], static_cast<double>(passage.g));
      expect_mean(past[2], static_cast<double>(passage.b));
      // What stops there meets the pane itself, as often as it covers, in every colour.
      for (const RunningStatistics& channel : stopped) expect_mean(channel, static_cast<double>(pane.coverage));
    }
  }
}

}  // namespace
}  // namespace radfarm
