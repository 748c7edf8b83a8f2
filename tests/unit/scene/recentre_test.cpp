#include "scene/recentre.h"

#include <gmock/gmock.h>

#include "unit/scene/scene_builder.h"

namespace radfarm {
namespace {

/// Unit squares of two triangles in z = 0 at the given places, as instances of one mesh.
DraftScene squares(const std::vector<Vec3d>& places) {
  DraftScene draft;
  draft.scene.materials.emplace_back();
  Mesh mesh;
  mesh.positions = {{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0}};
  mesh.triangles = {{0, 1, 2}, {0, 2, 3}};
  draft.scene.meshes.push_back(mesh);
  draft.positions.resize(1);
  for (const Vec3d& place : places) {
    draft.scene.instances.push_back({0, Matrix4(), ""});
    Matrix4d matrix;
    matrix.setTranslation(place);
    draft.instance_to_world.push_back(matrix);
  }
  return draft;
}

TEST(Recentre, OneStrayObjectDoesNotMoveTheScene) {
  std::vector<Vec3d> places;
  for (int i = 0; i < 9; ++i) places.emplace_back(i, 0.0, 5.0);
  const Vec3d without = recentre(squares(places)).origin;
  places.emplace_back(0.0, 0.0, 343582.0);
  const Vec3d with = recentre(squares(places)).origin;
  EXPECT_LT(length(with - without), 2);
  EXPECT_NEAR(with.z, 5, 0.5);
}

TEST(Recentre, DistancesFarFromZeroSurvive) {
  const double far = 5e6;
  DraftScene draft = squares({{far, far, 0}, {far + 1.0009765625, far, 0}});
  draft.scene.lights.emplace_back();
  draft.light_positions.push_back({far + 0.125, far, 2});
  draft.scene.cameras.emplace_back();
  draft.camera_positions.push_back({far, far - 3.0625, 0});
  const Scene scene = recentre(std::move(draft));
  const float x0 = scene.instances[0].to_world[3][0];
  const float x1 = scene.instances[1].to_world[3][0];
  EXPECT_EQ(x1 - x0, 1.0009765625F);
  EXPECT_EQ(scene.lights[0].position.x - x0, 0.125F);
  EXPECT_EQ(scene.cameras[0].position.y - scene.instances[0].to_world[3][1], -3.0625F);
}

TEST(Recentre, AMeshFarFromItsOwnZeroIsMovedThere) {
  DraftScene draft = squares({{-1e6, 0, 0}});
  for (Vec3& p : draft.scene.meshes[0].positions) p.x += 1e6F;
  const Scene scene = recentre(std::move(draft));
  EXPECT_LT(max_abs_component(scene.meshes[0].positions[0]), 1);
  EXPECT_NEAR(test::placed(scene, 0, 1).x, 1, 1e-6);
  EXPECT_LT(std::fabs(scene.instances[0].to_world[3][0]), 2);
}

TEST(Recentre, AnEmptySceneStaysWhereItIs) { EXPECT_EQ(recentre(DraftScene{}).origin, Vec3d(0.0)); }

}  // namespace
}  // namespace radfarm
