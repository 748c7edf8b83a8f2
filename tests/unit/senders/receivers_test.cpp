#include "senders/receivers.h"

#include <algorithm>

#include <gtest/gtest.h>

#include "base/parallel.h"
#include "support/small_scenes.h"

namespace radfarm {
namespace {

struct Seen {
  Seen() : world(test::own_scene("cornell")), lookup(world, nothing), camera(world.scene.cameras.at(0)) {
    points = find_visible_points(world, lookup, film()).points;
    grid = fit_grid(camera, 24, 24, points, settings);
  }
  Prepass film() const { return {camera, 24, 24, 2, 1}; }
  World world;
  SenderTree nothing;
  ReflectorLookup lookup;
  Camera camera;
  SenderSettings settings;
  std::vector<ReceiverPoint> points;
  PerspectiveGrid grid;
};

bool same(const ReceiverPoint& a, const ReceiverPoint& b) {
  return a.position == b.position && a.normal == b.normal && a.reflectance == b.reflectance;
}

TEST(Receivers, AreVisiblePointsThatFaceTheCamera) {
  const Seen seen;
  EXPECT_GT(seen.points.size(), 900U);
  EXPECT_LE(seen.points.size(), 24U * 24 * 2);
  for (const ReceiverPoint& point : seen.points) {
    EXPECT_NEAR(length(point.normal), 1, 1e-5);
    EXPECT_GT(dot(point.normal, seen.camera.position - point.position), 0);
    EXPECT_EQ(seen.world.caster.transmittance(point.position, seen.camera.position), Spectrum(1.0F));
  }
}

TEST(Receivers, AreTheSameForAnyNumberOfThreads) {
  const Seen seen;
  const ThreadLimit limit(1);
  const std::vector<ReceiverPoint> again = find_visible_points(seen.world, seen.lookup, seen.film()).points;
  EXPECT_TRUE(std::equal(again.begin(), again.end(), seen.points.begin(), seen.points.end(), same));
}

TEST(Receivers, LieBetweenTheGridsNearAndFar) {
  const Seen seen;
  for (const ReceiverPoint& point : seen.points) {
    const float z = dot(point.position - seen.camera.position, seen.camera.forward);
    EXPECT_TRUE(z > seen.grid.near && z < seen.grid.far);
  }
  EXPECT_GT(fit_grid(seen.camera, 24, 24, {}, seen.settings).far, fit_grid(seen.camera, 24, 24, {}, seen.settings).near);
}

TEST(Receivers, AreSortedIntoTheirCells) {
  const Seen seen;
  constexpr std::uint32_t kPerCell = 5;
  const Receivers sorted = sort_into_cells(seen.grid, seen.points, kPerCell);
  std::vector<std::size_t> expected(seen.grid.cell_count());
  for (const ReceiverPoint& point : seen.points) ++expected[seen.grid.cell_at(point.position)];
  ASSERT_EQ(sorted.first_of_cell.size(), seen.grid.cell_count() + 1);
  EXPECT_EQ(sorted.first_of_cell.back(), sorted.points.size());
  for (std::uint32_t cell = 0; cell < seen.grid.cell_count(); ++cell) {
    const std::uint32_t begin = sorted.first_of_cell[cell], end = sorted.first_of_cell[cell + 1];
    EXPECT_EQ(end - begin, std::min<std::size_t>(expected[cell], kPerCell));
    for (std::uint32_t p = begin; p < end; ++p) EXPECT_EQ(seen.grid.cell_at(sorted.points[p].position), cell);
  }
}

TEST(Receivers, AroundAVertexComeFromTheCellsThatTouchIt) {
  const Seen seen;
  const Receivers sorted = sort_into_cells(seen.grid, seen.points, 16);
  std::size_t met = 0;
  for (std::uint32_t vertex = 0; vertex < seen.grid.vertex_count(); ++vertex) {
    const std::vector<ReceiverPoint> around = receivers_around(seen.grid, sorted, vertex, 8);
    ASSERT_FALSE(around.empty());
    EXPECT_LE(around.size(), 8U);
    if (around[0].normal == Vec3(0, 0, 0)) {
      EXPECT_EQ(around[0].position, seen.grid.vertex_position(vertex));
      continue;
    }
    ++met;
    const auto [i, j, k] = seen.grid.vertex_indices(vertex);
    for (const ReceiverPoint& point : around) {
      const Vec3 at = seen.grid.locate(point.position);
      EXPECT_LE(std::abs(at.x - static_cast<float>(i)), 1);
      EXPECT_LE(std::abs(at.y - static_cast<float>(j)), 1);
      EXPECT_LE(std::abs(at.z - static_cast<float>(k)), 1);
    }
  }
  EXPECT_GT(met, 0U);
}

}  // namespace
}  // namespace radfarm
