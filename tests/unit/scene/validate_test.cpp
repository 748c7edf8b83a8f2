#include "scene/validate.h"

#include <gmock/gmock.h>

#include <functional>
#include <limits>

#include "unit/scene/scene_builder.h"

namespace radfarm {
namespace {

using testing::HasSubstr;

Scene valid_scene() {
  Scene scene = *test::load(test::triangle().document);
  scene.meshes[0].normals = {{0, 0, 1}, {0, 0, 1}, {0, 0, 1}};
  scene.cameras.emplace_back();
  scene.lights.emplace_back();
  return scene;
}

void expect_fault(const std::string& message, const std::function<void(Scene&)>& spoil) {
  Scene scene = valid_scene();
  ASSERT_TRUE(validate(scene));
  spoil(scene);
  const Status status = validate(scene);
  ASSERT_FALSE(status) << message;
  EXPECT_THAT(status.error().message, HasSubstr(message));
}

TEST(Validate, NamesWhatIsWrongAndWhere) {
  constexpr float kNan = std::numeric_limits<float>::quiet_NaN();
  expect_fault("meshes[0]: a triangle names", [](Scene& s) { s.meshes[0].triangles[0][1] = 3; });
  expect_fault("meshes[0]: a position", [](Scene& s) { s.meshes[0].positions[1].y = kNan; });
  expect_fault("meshes[0]: a position", [](Scene& s) { s.meshes[0].positions[1].y = 2e18F; });
  expect_fault("meshes[0]: a normal", [](Scene& s) { s.meshes[0].normals[1] = {0, 0, 2}; });
  expect_fault("meshes[0]: an attribute", [](Scene& s) { s.meshes[0].normals.pop_back(); });
  expect_fault("meshes[0]: material", [](Scene& s) { s.meshes[0].material = 9; });
  expect_fault("materials[0] 'paint': base colour", [](Scene& s) { s.materials[0].base_color.g = 1.5F; });
  expect_fault("materials[0] 'paint': emission", [](Scene& s) { s.materials[0].emission.g = -1; });
  expect_fault("materials[0] 'paint': texture", [](Scene& s) { s.materials[0].base_texture.texture = 0; });
  expect_fault("instances[0]: mesh", [](Scene& s) { s.instances[0].mesh = 1; });
  expect_fault("instances[0]: transform is not inv", [](Scene& s) { s.instances[0].to_world[1][1] = 0; });
  expect_fault("instances[0]: transform is not aff", [](Scene& s) { s.instances[0].to_world[1][3] = 1; });
  expect_fault("cameras[0]: axes", [](Scene& s) { s.cameras[0].up = s.cameras[0].right; });
  expect_fault("cameras[0]: field", [](Scene& s) { s.cameras[0].vertical_fov = 4; });
  expect_fault("lights[0]: direction", [](Scene& s) { s.lights[0].direction = {0, 0, 0}; });
  expect_fault("textures[0]: number of texels", [](Scene& s) {
    s.textures.emplace_back();
    s.textures[0].width = s.textures[0].height = 2;
  });
}

}  // namespace
}  // namespace radfarm
