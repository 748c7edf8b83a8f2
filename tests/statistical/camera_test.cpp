#include "scene/camera.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <vector>

#include <gtest/gtest.h>

#include "base/random.h"
#include "support/statistics.h"

namespace radfarm {
namespace {

TEST(CameraLens, IsUsedEvenly) {
  Camera camera;
  camera.lens_diameter = 0.1F;
  camera.focus_distance = 3;
  constexpr int kDraws = 400'000, kRings = 10, kTurns = 40;
  std::vector<double> observed(kRings * kTurns);
  const std::vector<double> expected(observed.size(),
                                     static_cast<double>(kDraws) / static_cast<double>(observed.size()));
  RandomSequence random(1);
  for (int i = 0; i < kDraws; ++i) {
    const float u = random.uniform();
    const Vec3d at = to_double(camera_ray(camera, 64, 48, 10, 7, {u, random.uniform()}).origin) / 0.05;
    const double ring = (at.x * at.x + at.y * at.y) * kRings,
                 turn = (std::atan2(at.y, at.x) / (2 * std::numbers::pi) + 0.5) * kTurns;
    ++observed[static_cast<std::size_t>(std::min(static_cast<int>(ring), kRings - 1) * kTurns +
                                        std::min(static_cast<int>(turn), kTurns - 1))];
  }
  EXPECT_GT(test::chi_square(observed, expected).p_value, 1e-6);
}

}  // namespace
}  // namespace radfarm
