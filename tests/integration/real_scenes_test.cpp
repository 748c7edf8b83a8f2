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

TEST(RealScenes, EveryOneLoadsOrNamesTheExtensionItRequires) {
  REQUIRE_SHARED(scenes, "scenes");
  for (const path& file : scenes_below(*scenes)) {
    const Result<Scene> scene = load_scene(file);
    if (scene) continue;
    const bool needs_extension = scene.error().message.find("/extensionsRequired/") != std::string::npos;
    EXPECT_TRUE(needs_extension) << scene.error().message;
  }
}

TEST(RealScenes, HaveAsManyTrianglesAsTheirFilesSay) {
  REQUIRE_SHARED(scenes, "scenes");
  struct Count {
    const char* file;
    std::size_t triangles;  // with those that have no area, which are dropped
    std::size_t dropped;
  };
  for (const Count& count : {Count{"cornell-glb/CornellBox.glb", 36, 0}, Count{"classroom/classroom.obj", 111164, 3},
                             Count{"bookstore/bookstore.gltf", 117305, 0},
                             Count{"bookstore/bookstore_with_outlier.gltf", 117317, 0},
                             Count{"hospital/hospital.gltf", 151661, 0}}) {
    const Result<Scene> scene = load_scene(*scenes / count.file);
    ASSERT_TRUE(scene) << scene.error().message;
    EXPECT_EQ(summarize(*scene)["triangles"], count.triangles - count.dropped) << count.file;
    const std::vector<std::byte> bytes = encode_scene(*scene);
    const Result<Scene> again = decode_scene(bytes);
    ASSERT_TRUE(again) << again.error().message;
    EXPECT_EQ(encode_scene(*again), bytes);
  }
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
      EXPECT_FALSE(scene->materials[scene->meshes[instance.mesh].material].folds_gloss_into_diffuse) << name;
    }
  }
  EXPECT_NEAR(sample_surfaces(*load_scene(folder / "furnace.gltf")).signed_volume, -8, 1e-5);
  EXPECT_NEAR(sample_surfaces(*load_scene(folder / "emitters_reflect.gltf")).signed_volume, -4, 1e-5);
  const Scene cornell = *load_scene(folder / "cornell.gltf");
  EXPECT_LT(length(cornell.cameras[0].forward - Vec3(0, 0, 1)), 1e-6F);
}

}  // namespace
}  // namespace radfarm
