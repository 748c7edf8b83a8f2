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

}  // namespace
}  // namespace radfarm
