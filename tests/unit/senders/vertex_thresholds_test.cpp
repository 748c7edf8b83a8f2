#include "senders/vertex_thresholds.h"

#include <gtest/gtest.h>

#include "unit/senders/solved_scene.h"

namespace radfarm {
namespace {

using test::SolvedScene;

struct Judged {
  explicit Judged(const SolvedScene& scene, float max_elevation, float scale = 1)
      : lookup(scene.world, scene.tree),
        film{scene.camera(), 48, 48, 2, 1},
        seen(find_visible_points(scene.world, lookup, film)),
        settings(scene.settings),
        grid(fit_grid(scene.camera(), 48, 48, seen.points, settings)) {
    settings.threshold_scale = scale;
    settings.max_elevation = max_elevation;
    thresholds = visible_thresholds(scene.world, film, grid, seen, settings);
  }
  ReflectorLookup lookup;
  Prepass film;
  VisiblePoints seen;
  SenderSettings settings;
  PerspectiveGrid grid;
  VertexThresholds thresholds;
};

TEST(VertexThresholds, AreAFewPercentOfTheRadianceThere) {
  const SolvedScene scene("cornell");
  const Judged judged(scene, 1);
  ASSERT_EQ(judged.thresholds.values.size(), judged.grid.vertex_count());
  const PilotImage pilot = make_pilot_image(scene.world, judged.film, judged.grid, judged.seen);
  // Weber's ratio is 5.56 % in daylight and more the darker it is; at 1 cd/m^2 on the display, a tenth of what is seen, 39 %.
  EXPECT_GT(judged.thresholds.mean, 0.05 * mean_of(pilot.radiance) / 4);
  EXPECT_LT(judged.thresholds.mean, 0.4 * mean_of(pilot.radiance));
  for (const float t : judged.thresholds.values) EXPECT_GT(t, 0);
}

TEST(VertexThresholds, GrowWithTheScaleAndWithDetail) {
  const SolvedScene scene("cornell");
  const Judged plain(scene, 1), twice(scene, 1, 2), masked(scene, 4);
  EXPECT_NEAR(twice.thresholds.mean, 2 * plain.thresholds.mean, 1e-6 * plain.thresholds.mean);
  EXPECT_EQ(masked.thresholds.mean_plain, plain.thresholds.mean);
  for (std::size_t v = 0; v < plain.thresholds.values.size(); ++v) {
    EXPECT_GE(masked.thresholds.values[v], plain.thresholds.values[v] * (1 - 1e-6F)) << "vertex " << v;
  }
  EXPECT_LE(masked.thresholds.mean, 4 * plain.thresholds.mean);
}

TEST(VertexThresholds, FollowTheLight) {
  // A thousand times the light: the display shows the same, so a thousand times the threshold (ALGORITHMS H38).
  Scene bright = test::own_scene("cornell");
  for (Material& material : bright.materials) material.emission = material.emission * 1024.0F;
  const SolvedScene dim("cornell"), lit(std::move(bright));
  const double ratio = Judged(lit, 4).thresholds.mean / Judged(dim, 4).thresholds.mean;
  EXPECT_NEAR(ratio, 1024, 1);
}

TEST(VertexThresholds, AreTheGivenOneWhereThePilotIsBlack) {
  Scene dark = test::own_scene("cornell");
  for (Material& material : dark.materials) material.emission = {};
  const SolvedScene scene("cornell");
  const World world(std::move(dark));
  const SenderTree nothing;
  const ReflectorLookup lookup(world, nothing);
  const Prepass film{scene.camera(), 16, 16, 2, 1};
  const VisiblePoints seen = find_visible_points(world, lookup, film);
  SenderSettings settings = scene.settings;
  settings.threshold_scale = 1, settings.threshold = 0.25F;
  const PerspectiveGrid grid = fit_grid(scene.camera(), 16, 16, seen.points, settings);
  for (const float t : visible_thresholds(world, film, grid, seen, settings).values) EXPECT_EQ(t, 0.25F);
}

}  // namespace
}  // namespace radfarm
