#include "scene/scene_file.h"

#include <limits>

#include "base/random.h"
#include "scene/texture_uses.h"
#include "unit/scene/scene_builder.h"

namespace radfarm {
namespace {

/// A scene with something in every array.
Scene full_scene() {
  Scene scene;
  scene.textures.push_back({2, 1, true, Texture::Wrap::kClamp, Texture::Wrap::kMirror, {{1, 2, 3, 4}, {5, 6, 7, 8}}});
  scene.materials.resize(2);
  scene.materials[0].name = "oak";
  scene.materials[0].base_texture.texture = 0;
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
  mesh.tangents = {{1, 0, 0, 1}, {0, 1, 0, -1}, {1, 0, 0, -1}};
  scene.meshes.push_back(mesh);
  scene.instances = {{1, Matrix4(), "a"}, {0, Matrix4(), ""}};
  scene.instances[0].to_world[3][1] = 7;
  scene.lights.emplace_back();
  scene.lights[0].photometry = 0;
  scene.photometries.push_back({"lamp.ies", {0, 45, 90}, {0, 180}, {6, 5, 4, 3, 2, 1}});
  scene.environment = {2, 1, {Spectrum(1, 2, 3), Spectrum(4, 5, 6)}, {{0, 1, 0}, 0.5F, Spectrum(7, 8, 9)}};
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

/// A field changed from its default; where the file left it out, the bytes would be the same.
struct Field {
  const char* name;
  void (*change)(Scene& scene);
};

const std::vector<Field> kFields = {
    {"base color", [](Scene& s) { s.materials[0].base_color = {0.1F, 0.2F, 0.3F}; }},
    {"metallic", [](Scene& s) { s.materials[0].metallic = 0.4F; }},
    {"roughness", [](Scene& s) { s.materials[0].roughness = 0.4F; }},
    {"specular", [](Scene& s) { s.materials[0].specular = 0.4F; }},
    {"specular color", [](Scene& s) { s.materials[0].specular_color = {0.1F, 0.2F, 0.3F}; }},
    {"ior", [](Scene& s) { s.materials[0].ior = 1.7F; }},
    {"transmission", [](Scene& s) { s.materials[0].transmission = 0.4F; }},
    {"volume", [](Scene& s) { s.materials[0].has_volume = true; }},
    {"attenuation color", [](Scene& s) { s.materials[0].attenuation_color = {0.1F, 0.2F, 0.3F}; }},
    {"attenuation distance", [](Scene& s) { s.materials[0].attenuation_distance = 0.4F; }},
    {"clearcoat", [](Scene& s) { s.materials[0].clearcoat = 0.4F; }},
    {"clearcoat roughness", [](Scene& s) { s.materials[0].clearcoat_roughness = 0.4F; }},
    {"sheen color", [](Scene& s) { s.materials[0].sheen_color = {0.1F, 0.2F, 0.3F}; }},
    {"sheen roughness", [](Scene& s) { s.materials[0].sheen_roughness = 0.4F; }},
    {"anisotropy", [](Scene& s) { s.materials[0].anisotropy = 0.4F; }},
    {"anisotropy rotation", [](Scene& s) { s.materials[0].anisotropy_rotation = 0.4F; }},
    {"normal scale", [](Scene& s) { s.materials[0].normal_scale = -2; }},
    {"emission", [](Scene& s) { s.materials[0].emission = {0.1F, 0.2F, 0.3F}; }},
    {"both sides", [](Scene& s) { s.materials[0].emits_from_both_sides = true; }},
    {"alpha mode", [](Scene& s) { s.materials[0].alpha_mode = Material::Alpha::kBlend; }},
    {"alpha", [](Scene& s) { s.materials[0].alpha = 0.4F; }},
    {"alpha cutoff", [](Scene& s) { s.materials[0].alpha_cutoff = 0.4F; }},
    {"handedness", [](Scene& s) { s.meshes[1].tangents[0][3] = -1; }},
    {"right", [](Scene& s) { s.lights[0].right = {0, 1, 0}; }},
    {"photometry of a light", [](Scene& s) { s.lights[0].photometry = kNone; }},
    {"name of a photometry", [](Scene& s) { s.photometries[0].name = "other"; }},
    {"gamma", [](Scene& s) { s.photometries[0].gamma[1] = 30; }},
    {"C", [](Scene& s) { s.photometries[0].c[1] = 360; }},
    {"candela", [](Scene& s) { s.photometries[0].candela[4] = 20; }},
    {"map", [](Scene& s) { s.environment.radiance[1].g = 50; }},
    {"no map", [](Scene& s) { s.environment.width = s.environment.height = 0, s.environment.radiance.clear(); }},
    {"sun", [](Scene& s) { s.environment.sun.direction = {1, 0, 0}; }},
    {"size of the sun", [](Scene& s) { s.environment.sun.cos_radius = 0.25F; }},
    {"sunlight", [](Scene& s) { s.environment.sun.radiance.b = 1; }},
    {"lens", [](Scene& s) { s.cameras[0].lens_diameter = 0.1F; }},
    {"focus", [](Scene& s) { s.cameras[0].focus_distance = 3; }},
};

TEST(SceneFile, KeepsEveryField) {
  const std::vector<std::byte> before = encode_scene(full_scene());
  for (const Field& field : kFields) {
    Scene scene = full_scene();
    field.change(scene);
    const std::vector<std::byte> bytes = encode_scene(scene);
    EXPECT_NE(bytes, before) << field.name;
    const Result<Scene> again = decode_scene(bytes);
    ASSERT_TRUE(again) << field.name << ": " << again.error().message;
    EXPECT_EQ(encode_scene(*again), bytes) << field.name;
  }
}

TEST(SceneFile, KeepsEveryUseOfATexture) {
  Scene scene = full_scene();
  float next = 0;
  for (TextureUse* use : texture_uses(scene.materials[0])) {
    use->texture = 0;
    use->uv_set = 1;
    for (float& m : use->map) m = next++;
  }
  const Scene again = *decode_scene(encode_scene(scene));
  const auto uses = texture_uses(scene.materials[0]);
  const auto found = texture_uses(again.materials[0]);
  for (std::size_t k = 0; k < uses.size(); ++k) EXPECT_EQ(*uses[k], *found[k]) << k;
}

TEST(SceneFile, RefusesWhatNoLoaderMakes) {
  const std::vector<Field> faults = {
      {"transmission", [](Scene& s) { s.materials[0].transmission = 2; }},
      {"ior", [](Scene& s) { s.materials[0].ior = 0.5F; }},
      {"sheen", [](Scene& s) { s.materials[0].sheen_color.r = std::numeric_limits<float>::quiet_NaN(); }},
      {"texture", [](Scene& s) { s.materials[0].sheen_color_texture.texture = 1; }},
      {"uv set", [](Scene& s) { s.materials[0].base_texture.uv_set = 2; }},
      {"map", [](Scene& s) { s.materials[0].base_texture.map[5] = std::numeric_limits<float>::infinity(); }},
      {"handedness", [](Scene& s) { s.meshes[1].tangents[0][3] = 0.5F; }},
      {"tangents", [](Scene& s) { s.meshes[1].tangents.pop_back(); }},
      {"photometry", [](Scene& s) { s.lights[0].photometry = 1; }},
      {"right", [](Scene& s) { s.lights[0].right = {0, 0, 1}; }},
      {"gamma", [](Scene& s) { s.photometries[0].gamma[2] = 200; }},
      {"order of gamma", [](Scene& s) { s.photometries[0].gamma[1] = 100; }},
      {"C", [](Scene& s) { s.photometries[0].c[1] = 100; }},
      {"candela", [](Scene& s) { s.photometries[0].candela[0] = -1; }},
      {"size of the table", [](Scene& s) { s.photometries[0].candela.pop_back(); }},
      {"size of the map", [](Scene& s) { s.environment.radiance.pop_back(); }},
      {"radiance", [](Scene& s) { s.environment.radiance[0].r = -1; }},
      {"sun", [](Scene& s) { s.environment.sun.direction = {0, 2, 0}; }},
      {"size of the sun", [](Scene& s) { s.environment.sun.cos_radius = 2; }},
      {"lens", [](Scene& s) { s.cameras[0].lens_diameter = -1; }},
      {"focus", [](Scene& s) { s.cameras[0].focus_distance = 0; }},
  };
  for (const Field& fault : faults) {
    Scene scene = full_scene();
    fault.change(scene);
    EXPECT_FALSE(decode_scene(encode_scene(scene))) << fault.name;
  }
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
