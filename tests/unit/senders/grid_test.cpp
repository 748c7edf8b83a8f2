#include "senders/grid.h"

#include <algorithm>
#include <cmath>
#include <map>

#include <gtest/gtest.h>

#include "base/random.h"

namespace radfarm {
namespace {

// Coordinates are floats of up to 32 cells, through a logarithm and a division: some 1e-5 cells.
constexpr float kCells = 1e-3F;

PerspectiveGrid perspective() {
  PerspectiveGrid grid;
  grid.camera.position = {1, 2, 3};
  grid.camera.vertical_fov = 0.9F;
  grid.film_aspect = 1.5F;
  grid.near = 0.2F, grid.far = 30;
  grid.columns = 7, grid.rows = 5, grid.slices = 6;
  return grid;
}

PerspectiveGrid orthographic() {
  PerspectiveGrid grid = perspective();
  grid.camera.kind = Camera::Kind::kOrthographic;
  grid.camera.half_height = 3;
  return grid;
}

/// The world position of continuous coordinates, as vertex_position() defines those of whole ones.
Vec3 position_of(const PerspectiveGrid& grid, const Vec3& at) {
  const float z = grid.near * std::pow(grid.far / grid.near, at.z / static_cast<float>(grid.slices));
  const bool is_perspective = grid.camera.kind == Camera::Kind::kPerspective;
  const float half = is_perspective ? z * std::tan(grid.camera.vertical_fov / 2) : grid.camera.half_height;
  const float x = (2 * at.x / static_cast<float>(grid.columns) - 1) * half * grid.film_aspect;
  const float y = (1 - 2 * at.y / static_cast<float>(grid.rows)) * half;
  return grid.camera.position + grid.camera.right * x + grid.camera.up * y + grid.camera.forward * z;
}

Vec3 random_cell_point(const PerspectiveGrid& grid, RandomSequence& random) {
  return {random.uniform() * static_cast<float>(grid.columns), random.uniform() * static_cast<float>(grid.rows),
          random.uniform() * static_cast<float>(grid.slices)};
}

Vec3 indices_of(const PerspectiveGrid& grid, std::uint32_t vertex) {
  const auto [i, j, k] = grid.vertex_indices(vertex);
  return {static_cast<float>(i), static_cast<float>(j), static_cast<float>(k)};
}

TEST(PerspectiveGrid, LocatesEveryVertexAtItsIndices) {
  for (const PerspectiveGrid& grid : {perspective(), orthographic()}) {
    for (std::uint32_t id = 0; id < grid.vertex_count(); ++id) {
      const auto [i, j, k] = grid.vertex_indices(id);
      EXPECT_EQ(grid.vertex_id(i, j, k), id);
      EXPECT_LT(length(grid.locate(grid.vertex_position(id)) - indices_of(grid, id)), kCells);
    }
  }
}

TEST(PerspectiveGrid, LocateInvertsPosition) {
  RandomSequence random(1);
  for (const PerspectiveGrid& grid : {perspective(), orthographic()}) {
    for (int n = 0; n < 2000; ++n) {
      const Vec3 at = random_cell_point(grid, random);
      EXPECT_LT(length(grid.locate(position_of(grid, at)) - at), kCells);
    }
  }
}

TEST(PerspectiveGrid, MovesPointsOutsideToItsBorder) {
  const PerspectiveGrid grid = perspective();
  RandomSequence random(2);
  for (int n = 0; n < 5000; ++n) {
    const Vec3 anywhere = (Vec3(random.uniform(), random.uniform(), random.uniform()) - Vec3(0.5F, 0.5F, 0.5F)) * 200.0F;
    const Vec3 at = grid.locate(anywhere);
    EXPECT_TRUE(at.x >= 0 && at.x <= 7 && at.y >= 0 && at.y <= 5 && at.z >= 0 && at.z <= 6) << at;
    EXPECT_LT(grid.cell_at(anywhere), grid.cell_count());
  }
  EXPECT_LT(grid.cell_at(grid.camera.position), grid.cell_count());
}

TEST(PerspectiveGrid, ACellIsAsWideAsNeighbouringVerticesAreApart) {
  // Positions are floats of up to 50 m whose difference is taken: 1e-4 of a cell at most near the far end.
  RandomSequence random(7);
  for (const PerspectiveGrid& grid : {perspective(), orthographic()}) {
    for (std::uint32_t k = 0; k <= grid.slices; ++k) {
      const auto at = [&](std::uint32_t i, std::uint32_t j) { return grid.vertex_position(grid.vertex_id(i, j, k)); };
      for (int n = 0; n < 50; ++n) {
        const auto i = static_cast<std::uint32_t>(random.bits() % grid.columns);
        const auto j = static_cast<std::uint32_t>(random.bits() % (grid.rows + 1));
        const float apart = length(at(i + 1, j) - at(i, j));
        // Anywhere in the slice, also beside the film.
        const Vec3 across = (grid.camera.right * (random.uniform() - 0.5F) + grid.camera.up * random.uniform()) * 20.0F;
        EXPECT_NEAR(grid.cell_width(at(i, j) + across), apart, 1e-4F * apart) << k;
      }
    }
  }
}

TEST(PerspectiveGrid, CellsAreAsWideInFrontAndBehindAsAtTheEnds) {
  const PerspectiveGrid grid = perspective();
  const auto width_at = [&](float depth) { return grid.cell_width(grid.camera.position + grid.camera.forward * depth); };
  // The camera's place is rounded: depths err by some ulps of 3 m, a millionth of the nearest depth.
  EXPECT_NEAR(width_at(-1), width_at(grid.near), 1e-5F * width_at(grid.near));
  EXPECT_NEAR(width_at(2 * grid.far), width_at(grid.far), 1e-5F * width_at(grid.far));
  EXPECT_NEAR(width_at(10), 10 * width_at(1), 1e-5F * width_at(10));
  const PerspectiveGrid even = orthographic();
  const auto even_at = [&](float depth) { return even.cell_width(even.camera.position + even.camera.forward * depth); };
  EXPECT_EQ(even_at(1), even_at(10));
  EXPECT_FLOAT_EQ(even_at(1), 2 * 3 * 1.5F / 7);
}

TEST(Interpolate, WeighsWithAPartitionOfUnityThatReproducesThePoint) {
  const PerspectiveGrid grid = perspective();
  RandomSequence random(3);
  for (int n = 0; n < 20000; ++n) {
    const Vec3 position = position_of(grid, random_cell_point(grid, random));
    const Interpolation result = interpolate(grid, position);
    float sum = 0;
    Vec3 reproduced(0, 0, 0);
    for (std::size_t i = 0; i < 4; ++i) {
      ASSERT_LT(result.vertices[i], grid.vertex_count());
      EXPECT_GE(result.weights[i], 0);
      sum += result.weights[i];
      reproduced += indices_of(grid, result.vertices[i]) * result.weights[i];
    }
    EXPECT_NEAR(sum, 1, 1e-5);
    EXPECT_LT(length(reproduced - grid.locate(position)), kCells);
  }
}

TEST(Interpolate, IsContinuousAcrossEveryFace) {
  // Random values at the vertices change by at most the step times the largest slope of one tetrahedron.
  const PerspectiveGrid grid = perspective();
  const auto value = [&](const Vec3& at) {
    const Interpolation result = interpolate(grid, position_of(grid, at));
    float sum = 0;
    for (std::size_t i = 0; i < 4; ++i) {
      sum += result.weights[i] * to_unit_float(combine(4, result.vertices[i]));
    }
    return sum;
  };
  constexpr float kStep = 2e-3F;
  // Values in [0, 1]: an odd corner's tetrahedron has slope at most 1 along each axis, the middle one too.
  constexpr float kMost = 2 * kStep + 4 * kCells;
  RandomSequence random(5);
  for (int n = 0; n < 20000; ++n) {
    Vec3 at = random_cell_point(grid, random);
    const int axis = static_cast<int>(random.bits() % 3);
    at[axis] = std::clamp(std::round(at[axis]), 1.0F, 3.0F);  // on a face between cells
    Vec3 below = at, above = at;
    below[axis] -= kStep / 2;
    above[axis] += kStep / 2;
    EXPECT_NEAR(value(below), value(above), kMost) << at;
  }
}

TEST(ChooseVertex, FollowsTheWeights) {
  const PerspectiveGrid grid = perspective();
  RandomSequence random(6);
  for (int n = 0; n < 20; ++n) {
    const Interpolation at = interpolate(grid, position_of(grid, random_cell_point(grid, random)));
    std::map<std::uint32_t, int> chosen;
    constexpr int kSteps = 10000;
    for (int i = 0; i < kSteps; ++i) ++chosen[choose_vertex(at, (static_cast<float>(i) + 0.5F) / kSteps)];
    for (std::size_t i = 0; i < 4; ++i) {
      // Even steps: a count is off by at most one at either end of its share.
      EXPECT_NEAR(chosen[at.vertices[i]], static_cast<double>(at.weights[i]) * kSteps, 2);
    }
  }
}

}  // namespace
}  // namespace radfarm
