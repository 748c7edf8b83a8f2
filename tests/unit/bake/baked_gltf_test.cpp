#include "bake/baked_gltf.h"

#include <cmath>
#include <cstring>
#include <map>
#include <string>

#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include "base/file.h"
#include "scene/load_scene.h"
#include "support/small_scenes.h"

namespace radfarm {
namespace {

using nlohmann::json;

/// A scene of tests/scenes, solved coarsely and baked.
struct Baked {
  explicit Baked(const std::string& name) : Baked(test::own_scene(name)) {}
  explicit Baked(Scene loaded) : world(std::move(loaded)) {
    RadiositySettings settings;
    settings.max_link_error = 1e-3F;
    const RadiositySolution solution = solve_radiosity(world, settings, 1);
    mesh = make_element_mesh(world, solution.hierarchy, gather_irradiance(world, solution, 16, 1));
    scene = bake_mesh(world, mesh, auto_exposure(world, mesh));
    Result<std::vector<std::byte>> bytes = encode_baked_glb(scene, world, {{"seed", 1}});
    EXPECT_TRUE(bytes) << bytes.error().message;
    glb = std::move(*bytes);
  }

  World world;
  ElementMesh mesh;
  BakedScene scene;
  std::vector<std::byte> glb;
};

std::uint32_t word_at(const std::vector<std::byte>& bytes, std::size_t at) {
  std::uint32_t word = 0;
  std::memcpy(&word, bytes.data() + at, 4);
  return word;
}

json json_of(const std::vector<std::byte>& glb) {
  const auto* text = reinterpret_cast<const char*>(glb.data()) + 20;
  return json::parse(text, text + word_at(glb, 12));
}

Result<Scene> load(const std::vector<std::byte>& glb) {
  RADFARM_TRY(const TemporaryDirectory folder, TemporaryDirectory::create("bake"));
  RADFARM_TRY_STATUS(write_file_atomically(folder.path() / "baked.glb", glb));
  return load_scene(folder.path() / "baked.glb");
}

/// Area and area-weighted middle in the source file's coordinates.
struct Extent {
  double area = 0;
  Vec3d middle{0, 0, 0};
};

void add(const TriangleVertices& v, Extent& extent) {
  const auto area = static_cast<double>(area_of(v));
  extent.area += area;
  extent.middle += to_double((v[0] + v[1] + v[2]) / 3) * area;
}

Extent finished(Extent extent, const Vec3d& origin) {
  extent.middle = extent.middle / extent.area + origin;
  return extent;
}

Extent extent_of(const Scene& scene) {
  const Surfaces surfaces(scene);
  Extent extent;
  for (std::uint32_t i = 0; i < scene.instances.size(); ++i) {
    for (std::uint32_t t = 0; t < scene.meshes[scene.instances[i].mesh].triangles.size(); ++t) {
      add(surfaces.triangle(i, t), extent);
    }
  }
  return finished(extent, scene.origin);
}

/// Of the sides that light reaches.
Extent extent_of(const World& world, const ElementMesh& mesh) {
  const SideNumbers sides(world.scene);
  Extent extent;
  for (std::uint32_t i = 0; i < world.scene.instances.size(); ++i) {
    for (std::uint32_t t = 0; t < world.scene.meshes[world.scene.instances[i].mesh].triangles.size(); ++t) {
      for (const bool is_front : {true, false}) {
        if (mesh.sides[sides.of(i, t, is_front)] != kNone) add(world.surfaces.triangle(i, t), extent);
      }
    }
  }
  return finished(extent, world.scene.origin);
}

class BakedGltf : public testing::TestWithParam<const char*> {};
INSTANTIATE_TEST_SUITE_P(Scenes, BakedGltf, testing::Values("cornell", "room", "sheet", "cameras_far"));

/// "cameras_far": the room, a hundred kilometres off.
Scene scene_of(const std::string& name) {
  if (name != "cameras_far") return test::own_scene(name);
  Scene scene = test::own_scene("room");
  scene.origin += Vec3d(100e3, 0, 0.125);
  return scene;
}

TEST_P(BakedGltf, LoadsAgainWithTheSameGeometryAndCameras) {
  const Baked baked(scene_of(GetParam()));
  const Result<Scene> again = load(baked.glb);
  ASSERT_TRUE(again) << again.error().message;
  const Extent before = extent_of(baked.world, baked.mesh), after = extent_of(*again);
  // Sums of thousands of triangles of float vertices.
  EXPECT_NEAR(after.area, before.area, 1e-4 * before.area);
  EXPECT_LT(length(after.middle - before.middle), 1e-4 * static_cast<double>(baked.world.radius));
  ASSERT_EQ(again->cameras.size(), baked.world.scene.cameras.size());
  for (std::size_t i = 0; i < again->cameras.size(); ++i) {
    const Camera &a = again->cameras[i], &b = baked.world.scene.cameras[i];
    EXPECT_EQ(a.name, b.name);
    EXPECT_LT(length(to_double(a.position) + again->origin - to_double(b.position) - baked.world.scene.origin),
              1e-4 * static_cast<double>(baked.world.radius));
    EXPECT_LT(length(a.forward - b.forward), 1e-5F);
    EXPECT_FLOAT_EQ(a.vertical_fov, b.vertical_fov);
  }
}

TEST_P(BakedGltf, IsWellFormed) {
  const Baked baked(scene_of(GetParam()));
  ASSERT_EQ(word_at(baked.glb, 0), 0x46546c67U);
  ASSERT_EQ(word_at(baked.glb, 8), baked.glb.size());
  EXPECT_EQ(word_at(baked.glb, 12) % 4, 0U);
  const json gltf = json_of(baked.glb);
  const std::size_t buffer = gltf["buffers"][0]["byteLength"];
  EXPECT_EQ(20 + word_at(baked.glb, 12) + 8 + buffer, baked.glb.size());
  std::size_t end = 0;
  for (const json& view : gltf["bufferViews"]) {
    EXPECT_EQ(view["byteOffset"].get<std::size_t>() % 4, 0U);
    EXPECT_GE(view["byteOffset"].get<std::size_t>(), end);
    end = view["byteOffset"].get<std::size_t>() + view["byteLength"].get<std::size_t>();
    EXPECT_LE(end, buffer);
  }
  const std::map<std::string, std::size_t> sizes = {{"SCALAR", 1}, {"VEC2", 2}, {"VEC3", 3}, {"VEC4", 4}};
  for (const json& accessor : gltf["accessors"]) {
    const std::size_t component = accessor["componentType"] == 5123 ? 2 : 4;
    const std::size_t bytes = accessor["count"].get<std::size_t>() * sizes.at(accessor["type"]) * component;
    EXPECT_EQ(gltf["bufferViews"][accessor["bufferView"].get<std::size_t>()]["byteLength"], bytes);
  }
  for (const json& mesh : gltf["meshes"]) {
    const json& position = gltf["accessors"][mesh["primitives"][0]["attributes"]["POSITION"].get<std::size_t>()];
    EXPECT_EQ(position["min"].size(), 3U);
    EXPECT_EQ(position["max"].size(), 3U);
  }
}

TEST(BakedScene, ColoursAreExposedRadiance) {
  const Baked baked("cornell");
  const float gain = std::exp2(baked.scene.exposure_ev);
  bool has_lamp = false;
  for (const BakedMesh& mesh : baked.scene.meshes) {
    const Material& material = baked.world.scene.materials[baked.scene.materials[mesh.material].material];
    for (const BakedVertex& vertex : mesh.vertices) {
      const Spectrum light = material.emission + material.base_color * vertex.irradiance * kInversePi;
      has_lamp |= !is_black(material.emission) && vertex.color[1] == 65535;
      // The lamp's back is black; half a step of rounding.
      if (!is_black(material.emission)) continue;
      EXPECT_NEAR(static_cast<float>(vertex.color[0]) / 65535, std::min(1.0F, gain * light.r), 1.0F / 65535);
      EXPECT_NEAR(static_cast<float>(vertex.color[1]) / 65535, std::min(1.0F, gain * light.g), 1.0F / 65535);
    }
  }
  EXPECT_TRUE(has_lamp) << "emitters are shown bright";
}

}  // namespace
}  // namespace radfarm
