#include "scene/camera.h"

#include <cmath>

#include <gmock/gmock.h>

#include "base/random.h"
#include "support/small_scenes.h"
#include "unit/scene/scene_builder.h"

namespace radfarm {
namespace {

using testing::HasSubstr;

void expect_near(const Vec3& a, const Vec3& b) { EXPECT_LT(length(a - b), 1e-5F) << a << " is not " << b; }

TEST(Camera, TheCentreRayRunsForwardAndCornersSpanTheFieldOfView) {
  const Camera camera = *place_camera({0, 0, 0}, {0, 0, -5}, {0, 1, 0}, kPi / 2);
  expect_near(camera_ray(camera, 200, 100, 100, 50).direction, {0, 0, -1});
  expect_near(camera_ray(camera, 200, 100, 0, 0).direction, normalize(Vec3(-2, 1, -1)));
  expect_near(camera_ray(camera, 200, 100, 200, 100).direction, normalize(Vec3(2, -1, -1)));
}

TEST(Camera, RaysThroughTheLensMeetAtThePlaneOfFocus) {
  Camera camera = *place_camera({1, 2, 3}, {4, 1, -5}, {0, 1, 0}, kPi / 2);
  camera.lens_diameter = 0.5F;
  camera.focus_distance = 4;
  RandomSequence random(1);
  for (const Vec2& film : {Vec2(100, 50), Vec2(0, 0), Vec2(173, 91)}) {
    const Ray pinhole = camera_ray(camera, 200, 100, film.x, film.y);
    const Vec3 focus = pinhole.origin + pinhole.direction * (4 / dot(pinhole.direction, camera.forward));
    EXPECT_NEAR(dot(focus - camera.position, camera.forward), 4, 1e-5F);
    for (int i = 0; i < 100; ++i) {
      const float u = random.uniform();
      const Ray ray = camera_ray(camera, 200, 100, film.x, film.y, {u, random.uniform()});
      const Vec3 across = ray.origin - camera.position;
      EXPECT_LE(length(across), 0.25F * (1 + 1e-6F));
      EXPECT_NEAR(dot(across, camera.forward), 0, 1e-6F);
      EXPECT_NEAR(length(ray.direction), 1, 1e-6F);
      EXPECT_LT(length(cross(focus - ray.origin, ray.direction)), 4e-6F);
    }
  }
}

TEST(Camera, WithoutALensIsThePinholeBitForBit) {
  Camera camera = *place_camera({1, 2, 3}, {4, 1, -5}, {0, 1, 0}, 0.7F);
  for (const auto kind : {Camera::Kind::kPerspective, Camera::Kind::kOrthographic}) {
    camera.kind = kind;
    camera.lens_diameter = kind == Camera::Kind::kPerspective ? 0.0F : 1.0F;
    for (float x = 0.3F; x < 200; x += 7.1F) {
      const Ray pinhole = camera_ray(camera, 200, 100, x, x / 3);
      const Ray lens = camera_ray(camera, 200, 100, x, x / 3, {0.9F, 0.1F});
      EXPECT_EQ(pinhole.origin, lens.origin);
      EXPECT_EQ(pinhole.direction, lens.direction);
    }
  }
}

TEST(Camera, OrthographicRaysAreParallel) {
  Camera camera;
  camera.kind = Camera::Kind::kOrthographic;
  camera.half_height = 2;
  const Ray corner = camera_ray(camera, 200, 100, 0, 0);
  expect_near(corner.direction, {0, 0, -1});
  expect_near(corner.origin, {-4, 2, 0});
}

TEST(Camera, AnUpVectorAlongTheViewIsReplaced) {
  const auto camera = place_camera({0, 5, 0}, {0, 0, 0}, {0, 1, 0}, 1);
  ASSERT_TRUE(camera);
  expect_near(camera->forward, {0, -1, 0});
  EXPECT_NEAR(length(camera->right), 1, 1e-6);
  expect_near(cross(camera->right, camera->up), -camera->forward);
}

TEST(Camera, LookingAtItsOwnPlaceIsAnError) {
  EXPECT_FALSE(place_camera({1, 2, 3}, {1, 2, 3}, {0, 1, 0}, 1));
  EXPECT_FALSE(place_camera({1, 2, 3}, {0, 0, 0}, {0, 1, 0}, 0));
}

TEST(Camera, IsFoundByNameOrIndex) {
  Scene scene;
  scene.cameras.resize(2);
  scene.cameras[1].name = "door";
  EXPECT_EQ(find_camera(scene, "door")->name, "door");
  EXPECT_EQ(find_camera(scene, "1")->name, "door");
  const auto none = find_camera(scene, "roof");
  ASSERT_FALSE(none);
  EXPECT_EQ(none.error().code, Code::kNotFound);
  EXPECT_THAT(none.error().message, HasSubstr("0 '', 1 'door'"));
}

TEST(FrameScene, LooksIntoARoomFromInsideAndAtAnObjectFromOutside) {
  const std::filesystem::path scenes = std::filesystem::path(RADFARM_SOURCE_DIR) / "tests" / "scenes";
  const Result<Scene> room = load_scene(scenes / "room.gltf");
  ASSERT_TRUE(room) << room.error().message;
  const Vec3d eye = to_double(frame_scene(*room).position) + room->origin;
  EXPECT_TRUE(eye.x > 0 && eye.x < 6 && eye.y > 0 && eye.y < 2.8 && eye.z > 0 && eye.z < 5) << eye;
  Scene object = *load_scene(scenes / "furnace.gltf");
  for (auto& t : object.meshes[0].triangles) std::swap(t[1], t[2]);
  EXPECT_GT(length(to_double(frame_scene(object).position) + object.origin), 2);
}

/// Which side of a room from (0, 0, 0) to (4, 3, 5) a test leaves open, in the order of SceneMaker::room().
Scene room_without(const std::vector<std::size_t>& sides) {
  test::SceneMaker maker;
  const std::uint32_t grey = maker.material(Spectrum(0.5F));
  Scene scene = maker.room(std::vector<std::uint32_t>(6, grey), {0, 0, 0}, {4, 3, 5}).take();
  for (const std::size_t side : sides) scene.meshes[side].triangles.clear();
  return scene;
}

TEST(FrameScene, LooksThroughTheOpenSideOfARoomFromOutside) {
  const struct {
    std::size_t side;
    Vec3 forward;
  } rooms[] = {{2, {1, 0, 0}}, {3, {-1, 0, 0}}, {4, {0, 0, 1}}, {5, {0, 0, -1}}};
  for (const auto& [side, forward] : rooms) {
    const Camera camera = frame_scene(room_without({side}));
    expect_near(camera.forward, forward);
    // The opening is as high as the film.
    const Vec3 opening = Vec3(2, 1.5F, 2.5F) - forward * (side < 4 ? 2.0F : 2.5F);
    expect_near(camera.position, opening - forward * (1.5F / std::tan(camera.vertical_fov / 2)));
  }
}

TEST(FrameScene, AnOpenSideGoesBeforeAnOpenTopWhichAloneKeepsTheViewFromInside) {
  expect_near(frame_scene(room_without({1, 4})).forward, {0, 0, 1});
  const auto is_inside = [](const Vec3& p) { return p.x > 0 && p.x < 4 && p.y > 0 && p.y < 3 && p.z > 0 && p.z < 5; };
  EXPECT_TRUE(is_inside(frame_scene(room_without({1})).position));
  EXPECT_TRUE(is_inside(frame_scene(room_without({})).position));
}

TEST(FrameScene, LooksIntoTheCornellBoxFromItsOpenFront) {
  const Scene box = *load_scene(std::filesystem::path(RADFARM_SOURCE_DIR) / "tests" / "scenes" / "cornell.gltf");
  const Camera camera = frame_scene(box);
  expect_near(camera.forward, {0, 0, 1});
  EXPECT_LT((to_double(camera.position) + box.origin).z, -5);
}

TEST(FrameScene, AnEmptySceneHasAViewToo) { EXPECT_TRUE(is_finite(frame_scene(Scene{}).position)); }

}  // namespace
}  // namespace radfarm
