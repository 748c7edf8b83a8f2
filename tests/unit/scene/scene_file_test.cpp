#include "scene/scene_file.h"

#include "base/random.h"
#include "unit/scene/scene_builder.h"

namespace radfarm {
namespace {

/// A scene with something in every array.
Scene full_scene() {
  Scene scene;
  scene.textures.push_back({2, 1, true, Texture::Wrap::kClamp, Texture::Wrap::kMirror, {{1, 2, 3, 4}, {5, 6, 7, 8}}});
  scene.materials.resize(2);
  scene.materials[0].name = "oak";
  scene.materials[0].reflectance_texture = 0;
  scene.materials[1].emission = Spectrum(1, 2, 3);
  scene.materials[0].is_switched_off = true;
  Mesh mesh;
  mesh.name = "leaf";
  mesh.positions = {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}};
  mesh.triangles = {{0, 1, 2}};
  scene.meshes.push_back(mesh);
  mesh.material = 1;
  mesh.normals = {{0, 0, 1}, {0, 0, 1}, {0, 0, 1}};
  mesh.uv = {{{{0, 0}, {1, 0}, {0, 1}}, {{2, 2}, {3, 3}, {4, 4}}}};
  mesh.colors = {{1, 0, 0, 1}, {0, 1, 0, 1}, {0, 0, 1, 0.5F}};
  scene.meshes.push_back(mesh);
  scene.instances = {{1, Matrix4(), "a"}, {0, Matrix4(), ""}};
  scene.instances[0].to_world[3][1] = 7;
  scene.lights.emplace_back();
  scene.cameras.emplace_back();
  scene.cameras[0].name = "front";
  scene.origin = {1e6, 2, 3};
  scene.notes = {"first", "", "third"};
  return scene;
}

TEST(SceneFile, DecodingGivesBackTheSceneAndItsBytes) {
  const std::vector<std::byte> bytes = encode_scene(full_scene());
  const Result<Scene> scene = decode_scene(bytes);
  ASSERT_TRUE(scene) << scene.error().message;
  EXPECT_EQ(encode_scene(*scene), bytes);
  EXPECT_EQ(scene->meshes[1].uv[1][2], Vec2(4, 4));
  EXPECT_EQ(scene->materials[1].emission, Spectrum(1, 2, 3));
  EXPECT_TRUE(scene->materials[0].is_switched_off);
  EXPECT_EQ(scene->cameras[0].name, "front");
  EXPECT_EQ(scene->origin, Vec3d(1e6, 2, 3));
  EXPECT_EQ(scene->notes, full_scene().notes);
  EXPECT_EQ(scene->instances[0].to_world[3][1], 7);
}

TEST(SceneFile, AnEmptySceneSurvives) {
  const std::vector<std::byte> bytes = encode_scene(Scene{});
  const Result<Scene> scene = decode_scene(bytes);
  ASSERT_TRUE(scene) << scene.error().message;
  EXPECT_EQ(encode_scene(*scene), bytes);
}

TEST(SceneFile, EveryTruncationIsRefused) {
  const std::vector<std::byte> bytes = encode_scene(full_scene());
  for (std::size_t size = 0; size < bytes.size(); size += 7) {
    // What is cut off the padding after the last array is not missed.
    const std::vector<std::byte> cut(bytes.begin(), bytes.begin() + static_cast<std::ptrdiff_t>(size));
    if (size + 64 >= bytes.size()) break;
    EXPECT_FALSE(decode_scene(cut)) << size;
  }
}

TEST(SceneFile, FlippedBitsGiveAnErrorOrAValidScene) {
  const std::vector<std::byte> bytes = encode_scene(full_scene());
  RandomSequence random(20240229);
  for (std::size_t i = 0; i < bytes.size(); ++i) {
    for (int round = 0; round < 3; ++round) {
      std::vector<std::byte> damaged = bytes;
      damaged[i] ^= static_cast<std::byte>(1U << (random.bits() % 8));
      damaged[random.bits() % bytes.size()] = static_cast<std::byte>(random.bits());
      const Result<Scene> scene = decode_scene(damaged);
      if (!scene) continue;
      EXPECT_TRUE(validate(*scene));
    }
  }
}

}  // namespace
}  // namespace radfarm
