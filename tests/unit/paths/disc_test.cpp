#include "paths/disc.h"

#include <algorithm>

#include <gtest/gtest.h>

#include "base/random.h"
#include "support/small_scenes.h"

namespace radfarm {
namespace {

TEST(DiscCaster, FindsEachDiscOnce) {
  // Against all pairs in double, away from the discs' edges.
  RandomSequence random(1);
  const auto number = [&] { return 2 * random.uniform() - 1; };
  std::vector<OrientedDisc> discs;
  for (int i = 0; i < 2000; ++i) {
    discs.push_back({{number(), number(), number()},
                     normalize(Vec3(number(), number(), number() + .01F)),
                     .02F + .1F * random.uniform()});
  }
  const DiscCaster caster(discs);
  int found = 0;
  for (int r = 0; r < 300; ++r) {
    const Ray ray{{number(), number(), number()}, normalize(Vec3(number(), number(), number() + .01F))};
    std::vector<std::uint32_t> seen;
    caster.crossed(
        ray, 0, 10,
        [](void* user, std::uint32_t disc) { static_cast<std::vector<std::uint32_t>*>(user)->push_back(disc); }, &seen);
    std::sort(seen.begin(), seen.end());
    EXPECT_EQ(std::adjacent_find(seen.begin(), seen.end()), seen.end());
    for (std::uint32_t i = 0; i < discs.size(); ++i) {
      const Vec3d n = to_double(discs[i].normal), o = to_double(ray.origin) - to_double(discs[i].centre),
                  d = to_double(ray.direction);
      const double t = -dot(o, n) / dot(d, n), off = length(o + d * t) / static_cast<double>(discs[i].radius);
      if (std::fabs(dot(d, n)) < 1e-4 || std::fabs(t) < 1e-5) continue;
      const bool has = std::binary_search(seen.begin(), seen.end(), i);
      if (t > 0 && off < 1) {
        EXPECT_TRUE(has) << off;
      } else if (t < 0 || off > 1.001) {
        EXPECT_FALSE(has) << off;
      }
      found += has ? 1 : 0;
    }
  }
  EXPECT_GT(found, 300);
}

TEST(Disc, WallsCutItAndFloorsDoNot) {
  test::SceneMaker maker;
  const auto grey = maker.material(Spectrum(.5F));
  maker.room(std::vector<std::uint32_t>(6, grey), {0, 0, 0}, {4, 3, 4});
  const World world(maker.take());
  const auto reach_at = [&](float x) {
    const auto hit = world.caster.closest({{x, 1, 2}, {0, -1, 0}}, 0);
    return measure_reach(world, disc_at(world.surfaces.at(*hit), 0, .2F));
  };
  const Reach open = reach_at(2), cut = reach_at(.1F);
  EXPECT_TRUE(std::all_of(open.begin(), open.end(), [](auto share) { return share == kWhole; }));
  const double half = 255 * .5;
  EXPECT_NEAR(*std::min_element(cut.begin(), cut.end()), half, 6);
  EXPECT_EQ(std::count(cut.begin(), cut.end(), kWhole),
            10);  // within 60 degrees of the wall's foot, to whole sectors, it is cut
}

}  // namespace
}  // namespace radfarm
