#include "estimate/gather.h"

#include <cmath>
#include <string>

#include <gtest/gtest.h>

#include "base/parallel.h"
#include "estimate/path_reference.h"
#include "estimate/render_tile.h"
#include "support/small_scenes.h"

namespace radfarm {
namespace {

constexpr int kWidth = 48;
constexpr int kHeight = 36;
// Radiosity (links, residual) and interpolation (threshold) are biased; their budgets add up to this share of the light.
constexpr double kBias = 0.03;
// Standard errors of noise on top: one false alarm in 16000 for one scene without any bias, and seeds are fixed.
constexpr double kErrors = 4;

struct Mean {
  double value = 0;   // of the image's reflected luminance, cd/m^2
  double error = 0;   // standard error
  double largest = 0; // pixel
  std::uint64_t dropped = 0;
};

Mean mean_of(const Film& film, std::uint32_t samples, const SampleRadiance& radiance) {
  std::vector<std::vector<PixelSums>> rows(kHeight);
  parallel_for(rows.size(), 1, [&](std::size_t begin, std::size_t end) {
    Counters counters;
    const PixelRect rect{0, static_cast<int>(begin), kWidth, static_cast<int>(end)};
    rows[begin] = render_tile(film, rect, samples, radiance, counters);
  });
  Mean mean;
  constexpr double kPixels = static_cast<double>(kWidth) * kHeight;
  double variance = 0;
  for (const auto& row : rows) {
    for (const PixelSums& p : row) {
      const double n = p.samples;
      const double pixel = luminance(p.direct + p.indirect) / n;
      mean.value += pixel / kPixels;
      variance += std::max(0.0, p.squared_luminance / n - pixel * pixel) / (n - 1) / (kPixels * kPixels);
      mean.largest = std::max(mean.largest, pixel);
      mean.dropped += p.dropped;
    }
  }
  mean.error = std::sqrt(variance);
  return mean;
}

/// A scene through both integrators, at the thresholds of standard quality.
struct Compared {
  explicit Compared(const std::string& name) {
    const World world(test::own_scene(name));
    const Film film{world.scene.cameras.at(0), kWidth, kHeight, 1};
    const RadiositySolution solution = solve_radiosity(world, RadiositySettings(), 1);
    const SenderTree tree = make_sender_tree(solution);
    SenderSettings settings;
    const float area = solution.hierarchy.nodes.at(0).area / 2;
    settings.threshold = 0.01F * luminance(solution.reflected_power.at(0)) / (kPi * area);
    const SenderGrid senders(classify_visible(world, tree, film.camera, kWidth, kHeight, settings, 1), world, tree,
                             settings, 1);
    const SenderLookup lookup(world, tree);
    const GatherContext context{world, tree, lookup, senders, settings};
    gathered = mean_of(film, 16, [&](const Ray& ray, const PixelSampler& sampler, Counters& counters) {
      return gather_radiance(context, ray, sampler, counters);
    });
    traced = mean_of(film, 128, [&](const Ray& ray, const PixelSampler& sampler, Counters& counters) {
      return trace_path(world, ray, sampler, counters);
    });
  }
  Mean gathered, traced;
};

class GatherOf : public testing::TestWithParam<const char*> {};
INSTANTIATE_TEST_SUITE_P(Scenes, GatherOf, testing::Values("furnace", "cornell", "room", "point_light"));

TEST_P(GatherOf, HasTheMeanLightOfAPathTrace) {
  const Compared both(GetParam());
  EXPECT_EQ(both.gathered.dropped + both.traced.dropped, 0U);
  ASSERT_GT(both.traced.value, 0);
  const double noise = std::hypot(both.gathered.error, both.traced.error) / both.traced.value;
  const double ratio = both.gathered.value / both.traced.value;
  RecordProperty("ratio", std::to_string(ratio));
  RecordProperty("noise", std::to_string(noise));
  EXPECT_NEAR(ratio, 1, kBias + kErrors * noise);
}

TEST(Gather, TheDarkChamberOfTheSheetIsBlack) {
  const Compared both("sheet");
  EXPECT_EQ(both.gathered.largest, 0);
  EXPECT_EQ(both.traced.largest, 0);
}

}  // namespace
}  // namespace radfarm
