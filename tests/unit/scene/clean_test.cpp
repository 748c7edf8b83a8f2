#include "scene/clean.h"

#include <gtest/gtest.h>

namespace radfarm {
namespace {

TEST(Clean, TrianglesWithoutAreaAreThoseOfRepeatedOrCollinearCorners) {
  EXPECT_TRUE(is_degenerate({1, 2, 3}, {1, 2, 3}, {4, 5, 6}));
  EXPECT_TRUE(is_degenerate({0, 0, 0}, {1, 1, 1}, {3, 3, 3}));
  EXPECT_FALSE(is_degenerate({0, 0, 0}, {1e-20F, 0, 0}, {0, 1e-20F, 0}));
  EXPECT_FALSE(is_degenerate({0, 0, 0}, {1, 0, 0}, {0.5F, 1e-5F, 0}));
}

TEST(Clean, MeshesWithoutTrianglesGoAndInstancesAreRenumbered) {
  Scene scene;
  scene.materials.emplace_back();
  Mesh empty;
  Mesh mesh;
  mesh.positions = {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}};
  mesh.triangles = {{0, 1, 2}};
  scene.meshes = {empty, mesh};
  scene.instances = {{0, Matrix4(), "gone"}, {1, Matrix4(), "kept"}};
  clean_scene(scene);
  ASSERT_EQ(scene.instances.size(), 1U);
  EXPECT_EQ(scene.instances[0].name, "kept");
  EXPECT_EQ(scene.instances[0].mesh, 0U);
}

/// One instance of a mesh with corners 0 to 3 of a square, and copies of them as 4 to 7.
Scene square_of(const std::vector<std::array<std::uint32_t, 3>>& triangles) {
  Scene scene;
  scene.materials.emplace_back();
  Mesh mesh;
  for (int copy = 0; copy < 2; ++copy) {
    for (const Vec3& p : {Vec3(0, 0, 0), Vec3(1, 0, 0), Vec3(1, 1, 0), Vec3(0, 1, 0)}) mesh.positions.push_back(p);
  }
  mesh.triangles = triangles;
  scene.meshes = {mesh};
  scene.instances = {{0, Matrix4(), ""}};
  return scene;
}

TEST(Clean, TrianglesThatLieExactlyOnOthersGoAndTheFirstStays) {
  // Turned round, by other vertices in the same places, the other way round.
  Scene scene = square_of({{0, 1, 2}, {0, 2, 3}, {1, 2, 0}, {4, 5, 6}, {2, 1, 0}});
  clean_scene(scene);
  using Triangles = std::vector<std::array<std::uint32_t, 3>>;
  EXPECT_EQ(scene.meshes[0].triangles, (Triangles{{0, 1, 2}, {0, 2, 3}}));
  ASSERT_EQ(scene.notes.size(), 1U);
  EXPECT_EQ(scene.notes[0].substr(0, 11), "3 triangles");
}

TEST(Clean, TrianglesThatShareAnEdgeStay) {
  Scene scene = square_of({{0, 1, 2}, {0, 2, 3}, {0, 1, 3}});
  clean_scene(scene);
  EXPECT_EQ(scene.meshes[0].triangles.size(), 3U);
  EXPECT_TRUE(scene.notes.empty());
}

}  // namespace
}  // namespace radfarm
