#include <gmock/gmock.h>

#include <algorithm>
#include <cstdlib>
#include <optional>

#include "base/stopwatch.h"
#include "scene/scene_file.h"
#include "scene/summary.h"
#include "scene/surface_samples.h"
#include "unit/scene/scene_builder.h"

namespace radfarm {
namespace {

using std::filesystem::path;

/// The folder of assets that are not part of the repository: RADFARM_SHARED, or ../shared beside it.
std::optional<path> shared_folder(const char* folder) {
  const char* set = std::getenv("RADFARM_SHARED");
  const path shared = set != nullptr ? path(set) : path(RADFARM_SOURCE_DIR).parent_path() / "shared";
  const path found = shared / folder;
  return std::filesystem::is_directory(found) ? std::optional(found) : std::nullopt;
}

std::vector<path> scenes_below(const path& folder) {
  std::vector<path> scenes;
  for (const auto& entry : std::filesystem::recursive_directory_iterator(folder)) {
    const std::string extension = entry.path().extension().string();
    if (extension == ".gltf" || extension == ".glb" || extension == ".obj") scenes.push_back(entry.path());
  }
  std::sort(scenes.begin(), scenes.end());
  return scenes;
}

#define REQUIRE_SHARED(variable, folder)                                                              \
  const std::optional<path> variable = shared_folder(folder);                                         \
  if (!variable) GTEST_SKIP() << "no " << folder << " in $RADFARM_SHARED or ../shared; see docs/testing.md"

TEST(RealScenes, EveryOneLoads) {
  REQUIRE_SHARED(scenes, "scenes");
  for (const path& file : scenes_below(*scenes)) {
    const Result<Scene> scene = load_scene(file);
    EXPECT_TRUE(scene) << scene.error().message;
  }
}

TEST(RealScenes, HaveAsManyTrianglesAsTheirFilesSay) {
  REQUIRE_SHARED(scenes, "scenes");
  struct Count {
    const char* file;
    std::size_t triangles;  // with those that have no area or lie exactly on others, which are dropped
    std::size_t dropped;
  };
  for (const Count& count : {Count{"cornell-glb/CornellBox.glb", 36, 0}, Count{"classroom/classroom.obj", 111164, 3},
                             Count{"bookstore/bookstore.gltf", 117305, 0},
                             Count{"bookstore/bookstore_with_outlier.gltf", 117317, 0},
                             Count{"hospital/hospital.gltf", 151661, 967}}) {
    const Result<Scene> scene = load_scene(*scenes / count.file);
    ASSERT_TRUE(scene) << scene.error().message;
    EXPECT_EQ(summarize(*scene)["triangles"], count.triangles - count.dropped) << count.file;
    const std::vector<std::byte> bytes = encode_scene(*scene);
    const Result<Scene> again = decode_scene(bytes);
    ASSERT_TRUE(again) << again.error().message;
    EXPECT_EQ(encode_scene(*again), bytes);
  }
}

/// What a scene and its twin from the reference decoder must share.
void expect_same_shape(const path& file, const path& twin, double length_tolerance, double dropped_triangles) {
  const Result<Scene> scene = load_scene(file);
  const Result<Scene> expected = load_scene(twin);
  ASSERT_TRUE(scene) << scene.error().message;
  ASSERT_TRUE(expected) << expected.error().message;
  const nlohmann::json found = summarize(*scene);
  const nlohmann::json wanted = summarize(*expected);
  EXPECT_NEAR(found["triangles"].get<double>(), wanted["triangles"].get<double>(), dropped_triangles) << file;
  const auto area = wanted["surface_area_m2"].get<double>();
  EXPECT_NEAR(found["surface_area_m2"].get<double>(), area, area * 2e-4) << file;
  for (const char* side : {"min", "max"}) {
    for (std::size_t axis = 0; axis < 3; ++axis) {
      EXPECT_NEAR(found["bounds"][side][axis].get<double>(), wanted["bounds"][side][axis].get<double>(),
                  length_tolerance)
          << file;
    }
  }
}

TEST(RealScenes, CompressedOnesAreWhatTheReferenceDecodersMakeOfThem) {
  REQUIRE_SHARED(scenes, "scenes");
  const path folder = *scenes / "compressed";
  expect_same_shape(folder / "DenseSphere.glb", folder / "decoded_DenseSphere.glb", 1e-6, 0);
  expect_same_shape(folder / "pirate.glb", folder / "decoded_pirate.glb", 1e-6, 0);
  expect_same_shape(*scenes / "city-diorama/scene.glb", *scenes / "city-diorama/decoded_scene.glb", 1e-6, 0);
  // The original of the Draco file: quantisation moves vertices by up to 0.02 of its 743 m, and 17 triangles vanish.
  expect_same_shape(folder / "draco/2CylinderEngine.gltf", folder / "2CylinderEngine.glb", 0.05, 20);
}

TEST(RealScenes, InstancesOfTheGpuExtensionStandWhereItSays) {
  REQUIRE_SHARED(scenes, "scenes");
  const Result<Scene> few = load_scene(*scenes / "khronos-feature-tests/simple-instancing.glb");
  ASSERT_TRUE(few) << few.error().message;
  EXPECT_EQ(few->instances.size(), 125U);
  const Result<Scene> many = load_scene(*scenes / "blender-io-features/24_gpu_instancing/24_gpu_instancing.gltf");
  ASSERT_TRUE(many) << many.error().message;
  EXPECT_EQ(summarize(*many)["triangles"], 7656770);
}

TEST(RealScenes, AnOutlierDoesNotMoveTheBookstore) {
  REQUIRE_SHARED(scenes, "scenes");
  const Result<Scene> scene = load_scene(*scenes / "bookstore/bookstore_with_outlier.gltf");
  ASSERT_TRUE(scene) << scene.error().message;
  EXPECT_LT(length(scene->origin), 20);
}

TEST(RealScenes, MalformedInputsGiveOneLineWithinSeconds) {
  REQUIRE_SHARED(inputs, "bad-inputs");
  for (const path& file : scenes_below(*inputs)) {
    const Stopwatch watch;
    const Result<Scene> scene = load_scene(file);
    EXPECT_LT(watch.wall_seconds(), 5) << file;
    if (scene) continue;
    EXPECT_THAT(scene.error().message, testing::StartsWith(file.string()));
    EXPECT_EQ(scene.error().message.find('\n'), std::string::npos) << scene.error().message;
  }
}

TEST(OwnScenes, LoadAsExactlyLambertianAndClosed) {
  const path folder = path(RADFARM_SOURCE_DIR) / "tests" / "scenes";
  for (const char* name : {"cornell", "emitters_reflect", "furnace", "plates", "point_light", "room", "sheet"}) {
    const Result<Scene> scene = load_scene(folder / (std::string(name) + ".gltf"));
    ASSERT_TRUE(scene) << scene.error().message;
    EXPECT_TRUE(scene->notes.empty()) << name << ": " << scene->notes[0];
    EXPECT_EQ(scene->cameras.size(), 1U) << name;
    for (const Instance& instance : scene->instances) {
      EXPECT_TRUE(scene->materials[scene->meshes[instance.mesh].material].is_lambertian()) << name;
    }
  }
  EXPECT_NEAR(sample_surfaces(*load_scene(folder / "furnace.gltf")).signed_volume, -8, 1e-5);
  EXPECT_NEAR(sample_surfaces(*load_scene(folder / "emitters_reflect.gltf")).signed_volume, -4, 1e-5);
  const Scene cornell = *load_scene(folder / "cornell.gltf");
  EXPECT_LT(length(cornell.cameras[0].forward - Vec3(0, 0, 1)), 1e-6F);
}

}  // namespace
}  // namespace radfarm
