#include "scene/emitter_sampling.h"

#include <cmath>

#include <gtest/gtest.h>

#include "base/random.h"
#include "math/sampling.h"
#include "support/small_scenes.h"

namespace radfarm {
namespace {

constexpr std::uint64_t kKey = 1;

/// A random point that emitters may light, somewhere on the scene's surfaces, seen from a random direction.
SurfacePoint random_point(const World& world, RandomSequence& random) {
  const auto instance = static_cast<std::uint32_t>(random.bits() % world.scene.instances.size());
  const Mesh& mesh = world.scene.meshes[world.scene.instances[instance].mesh];
  const auto triangle = static_cast<std::uint32_t>(random.bits() % mesh.triangles.size());
  const Vec3 b = sample_uniform_triangle({random.uniform(), random.uniform()});
  SurfacePoint point = world.surfaces.at({instance, triangle, b.y, b.z, 0});
  face(point, sample_uniform_sphere({random.uniform(), random.uniform()}));
  return point;
}

class BalanceIn : public testing::TestWithParam<const char*> {};
INSTANTIATE_TEST_SUITE_P(Scenes, BalanceIn, testing::Values("furnace", "cornell", "emitters_reflect", "room"));

TEST_P(BalanceIn, TheTwoWeightsOfADirectionAddUpToOne) {
  const World world(test::own_scene(GetParam()));
  RandomSequence random(1);
  std::size_t compared = 0, elsewhere = 0;
  double sum = 0;
  for (int n = 0; n < 20'000; ++n) {
    const SurfacePoint point = random_point(world, random);
    const NextEvent event = sample_emitter(world, point, random.uniform(), {random.uniform(), random.uniform()});
    if (!(event.pdf > 0) || is_black(event.weight)) continue;
    const auto hit = world.caster.closest({leave(point), event.direction}, kKey);
    if (!hit || world.emitters.find(hit->instance, hit->triangle) == kNone) {
      ++elsewhere;  // a ray that passes an edge of the emitter by rounding
      continue;
    }
    const float other = dot(point.shading_normal, event.direction) * kInversePi;
    const float of_event = balance_of_event(event, other);
    const float of_hit = balance_of_hit(world, *hit, point.position, event.direction, other);
    EXPECT_GT(of_event, 0);
    EXPECT_LT(of_event, 1);
    // Distances and cosines of a grazing emitter are floats of few digits: 1e-3 of the smaller weight's complement.
    EXPECT_NEAR(of_event + of_hit, 1, 1e-3) << "at " << point.position << " along " << event.direction;
    sum += std::fabs(static_cast<double>(of_event + of_hit) - 1);
    ++compared;
  }
  ASSERT_GT(compared, 500U);
  EXPECT_LT(sum / static_cast<double>(compared), 1e-5);
  EXPECT_LT(elsewhere, compared / 1000 + 1);
}

TEST(Balance, OfWhatNextEventsCannotChooseIsOne) {
  const World world(test::own_scene("cornell"));
  for (std::uint32_t i = 0; i < world.scene.instances.size(); ++i) {
    if (world.emitters.find(i, 0) != kNone) continue;
    EXPECT_EQ(balance_of_hit(world, {i, 0, 0.3F, 0.3F, 1}, {0, 0, 0}, {0, 0, 1}, 0.25F), 1);
  }
  NextEvent punctual;
  punctual.pdf = 0;
  EXPECT_EQ(balance_of_event(punctual, 0.25F), 1);
}

TEST(Balance, GivesAllToTheOnlyStrategyLeft) {
  NextEvent event;
  event.pdf = 2;
  EXPECT_EQ(balance_of_event(event, 0), 1);
  EXPECT_EQ(balance_of_event(event, 2), 0.5F);
}

}  // namespace
}  // namespace radfarm
