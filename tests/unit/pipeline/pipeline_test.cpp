#include "pipeline/pipeline.h"

#include <algorithm>
#include <fstream>

#include <gmock/gmock.h>
#include <nlohmann/json.hpp>

#include "base/file.h"
#include "base/parallel.h"
#include "image/digest.h"
#include "support/small_scenes.h"

namespace radfarm {
namespace {

using nlohmann::json;
using Results = std::vector<std::vector<std::byte>>;

RenderRequest small_request() {
  RenderRequest request;
  request.quality = RenderRequest::Quality::kPreview;
  request.width = request.height = 24;
  request.samples = 2;
  request.tile = 8;
  return request;
}

/// Runs all tasks of prepared files, in order or in reverse.
enum class Order { kForward, kReverse };
Results run_all(const PreparedFiles& files, Order order = Order::kForward) {
  const Result<Prepared> prepared = Prepared::open(files.scene, files.solution, files.view);
  EXPECT_TRUE(prepared.has_value()) << prepared.error().message;
  const std::vector<Task> tasks = *cut_tasks(files.view);
  Results results(tasks.size());
  for (std::size_t n = 0; n < tasks.size(); ++n) {
    const std::size_t i = order == Order::kForward ? n : tasks.size() - 1 - n;
    results[i] = *run_task(*prepared, tasks[i]);
  }
  return results;
}

/// The same on two threads, each with every other task.
Results run_on_two_threads(const PreparedFiles& files) {
  const Result<Prepared> prepared = Prepared::open(files.scene, files.solution, files.view);
  EXPECT_TRUE(prepared.has_value());
  const std::vector<Task> tasks = *cut_tasks(files.view);
  Results results(tasks.size());
  const ThreadLimit limit(2);
  parallel_for(tasks.size(), 1, [&](std::size_t begin, std::size_t end) {
    for (std::size_t i = begin; i < end; ++i) results[i] = *run_task(*prepared, tasks[i]);
  });
  return results;
}

PreparedFiles prepared_files(const std::string& scene, const RenderRequest& request) {
  Result<PreparedFiles> files = prepare(test::own_scene_path(scene), request);
  EXPECT_TRUE(files.has_value()) << files.error().message;
  return std::move(*files);
}

Finished render(const std::filesystem::path& scene, const RenderRequest& request) {
  const Result<PreparedFiles> files = prepare(scene, request);
  EXPECT_TRUE(files.has_value()) << files.error().message;
  Result<Finished> finished = finish(files->view, run_all(*files), {});
  EXPECT_TRUE(finished.has_value()) << finished.error().message;
  return std::move(*finished);
}

/// One of our scenes, changed, as a file.
class ChangedScene {
 public:
  template <typename Change>
  ChangedScene(const std::string& name, Change change) : folder_(std::move(*TemporaryDirectory::create("radfarm-pipeline"))) {
    std::ifstream in(test::own_scene_path(name));
    json document = json::parse(in);
    change(document);
    std::ofstream(path()) << document;
  }
  std::filesystem::path path() const { return folder_.path() / "scene.gltf"; }

 private:
  TemporaryDirectory folder_;
};

TEST(Pipeline, TasksGiveTheSameBytesWheneverAndWhereverTheyRun) {
  for (const auto integrator : {RenderRequest::Integrator::kGather, RenderRequest::Integrator::kRadiosity, RenderRequest::Integrator::kPathTrace}) {
    RenderRequest request = small_request();
    request.integrator = integrator;
    const PreparedFiles files = prepared_files("cornell", request);
    const Results once = run_all(files);
    EXPECT_EQ(run_all(files), once);
    EXPECT_EQ(run_all(files, Order::kReverse), once);
    EXPECT_EQ(run_on_two_threads(files), once);
  }
}

TEST(Pipeline, PreparesTheSameSceneAndSolutionForAnyNumberOfThreads) {
  const auto with = [](int threads) {
    const ThreadLimit limit(threads);
    return prepared_files("cornell", small_request());
  };
  const PreparedFiles one = with(1), two = with(2);
  EXPECT_EQ(one.scene, two.scene);
  EXPECT_EQ(one.solution, two.solution);
  EXPECT_EQ(run_all(one), run_all(two));
}

class TileSizeOf : public testing::TestWithParam<RenderRequest::Integrator> {};
INSTANTIATE_TEST_SUITE_P(Pipeline, TileSizeOf,
                         testing::Values(RenderRequest::Integrator::kGather, RenderRequest::Integrator::kRadiosity));

TEST_P(TileSizeOf, NeverChangesTheImage) {
  std::vector<std::string> digests;
  for (const int tile : {8, 17, 64}) {
    RenderRequest request = small_request();
    request.integrator = GetParam();
    request.mesh = GetParam() == RenderRequest::Integrator::kRadiosity;
    request.tile = tile;
    request.audit = false;
    const Finished finished = render(test::own_scene_path("cornell"), request);
    digests.push_back(image_digest(finished.image));
    EXPECT_EQ((*finished.report)["image"]["digest"], digests.back());
  }
  EXPECT_EQ(digests[0], digests[1]);
  EXPECT_EQ(digests[0], digests[2]);
}

TEST(Pipeline, MeasuresItsAccuracy) {
  const Finished finished = render(test::own_scene_path("cornell"), small_request());
  const json& accuracy = (*finished.report)["accuracy"];
  EXPECT_GT(accuracy["audited_pixels"], 400);
  EXPECT_GT(accuracy["mean"], 0);
  EXPECT_GT(accuracy["rmse_ci95"][1], 0);
  EXPECT_EQ((*finished.report)["dropped_samples"]["count"], 0);
  EXPECT_EQ(finished.image.pixel_count(), 24U * 24);
}

TEST(Pipeline, ASceneWithoutEmitterIsAnErrorThatSaysWhatToDo) {
  const ChangedScene dark("cornell", [](json& document) {
    for (json& material : document["materials"]) material.erase("emissiveFactor");
  });
  const Result<PreparedFiles> files = prepare(dark.path(), small_request());
  ASSERT_FALSE(files);
  EXPECT_EQ(files.error().code, Code::kInvalidArgument);
  EXPECT_THAT(files.error().message, testing::HasSubstr("--env"));
}

void expect_black(const Finished& finished) {
  for (const auto& [name, channel] : finished.image.channels) {
    EXPECT_TRUE(std::all_of(channel.begin(), channel.end(), [](float v) { return v == 0; })) << name;
  }
  EXPECT_THAT((*finished.report)["warnings"].dump(), testing::HasSubstr("black"));
}

TEST(Pipeline, EmittersWithoutPowerGiveABlackImageAndAWarning) {
  const ChangedScene off("point_light", [](json& document) {
    document["extensions"]["KHR_lights_punctual"]["lights"][0]["intensity"] = 0;
  });
  for (const auto integrator : {RenderRequest::Integrator::kGather, RenderRequest::Integrator::kRadiosity, RenderRequest::Integrator::kPathTrace}) {
    RenderRequest request = small_request();
    request.integrator = integrator;
    const Finished finished = render(off.path(), request);
    expect_black(finished);
    const json& report = *finished.report;
    EXPECT_TRUE(report["accuracy"]["rmse"].is_null());
    EXPECT_TRUE(report["accuracy"]["relative_rmse"].is_null());
  }
}

TEST(Pipeline, AnEmitterSwitchedOffByItsStrengthGivesABlackImageAndAWarning) {
  const ChangedScene off("cornell", [](json& document) {
    for (json& material : document["materials"]) {
      material["extensions"]["KHR_materials_emissive_strength"]["emissiveStrength"] = 0;
    }
  });
  for (const auto integrator : {RenderRequest::Integrator::kGather, RenderRequest::Integrator::kRadiosity, RenderRequest::Integrator::kPathTrace}) {
    RenderRequest request = small_request();
    request.integrator = integrator;
    const Finished finished = render(off.path(), request);
    expect_black(finished);
  }
}

TEST(Pipeline, ASceneWithoutSurfacesIsRefusedForThat) {
  const auto folder = TemporaryDirectory::create("radfarm-pipeline");
  ASSERT_TRUE(folder.has_value());
  const auto path = folder->path() / "points.obj";
  ASSERT_TRUE(write_file_atomically(path, std::string("mtllib none.mtl\nv 0 0 0\np 1\n")).has_value());
  const auto files = prepare(path, small_request());
  ASSERT_FALSE(files);
  EXPECT_EQ(files.error().code, Code::kInvalidArgument);
  EXPECT_THAT(files.error().message, testing::HasSubstr("no triangles"));
}

double mean_of(const Image& image, const std::string& channel) {
  const auto found = image.channels.find(channel);
  EXPECT_NE(found, image.channels.end()) << channel;
  double sum = 0;
  for (const float value : found->second) sum += static_cast<double>(value);
  return sum / static_cast<double>(image.pixel_count());
}

TEST(Pipeline, WithoutInterreflectionNothingIsSolvedAndDirectLightIsTheSame) {
  RenderRequest request = small_request();
  request.audit = false;
  request.samples = 16;
  const Finished whole = render(test::own_scene_path("cornell"), request);
  request.effects = "-interreflection";
  const Finished direct = render(test::own_scene_path("cornell"), request);
  EXPECT_GT((*whole.report)["counts"]["radiosity_iterations"], 0);
  EXPECT_EQ((*direct.report)["counts"]["radiosity_iterations"], 0);
  EXPECT_EQ((*direct.report)["counts"]["links"], 0);
  const double expected = mean_of(whole.image, "direct.G");
  EXPECT_GT(expected, 0);
  EXPECT_NEAR(mean_of(direct.image, "direct.G"), expected, 0.03 * expected);
  EXPECT_EQ(mean_of(direct.image, "indirect.G"), 0);
}

TEST(Pipeline, TheSkyOfAClosedSceneCostsNothing) {
  for (const auto integrator : {RenderRequest::Integrator::kGather, RenderRequest::Integrator::kRadiosity, RenderRequest::Integrator::kPathTrace}) {
    RenderRequest request = small_request();
    request.integrator = integrator;
    request.audit = false;
    const std::string dark = image_digest(render(test::own_scene_path("effects/closed_box_env"), request).image);
    request.env = "sky:overcast";
    const Finished finished = render(test::own_scene_path("effects/closed_box_env"), request);
    EXPECT_EQ(image_digest(finished.image), dark);
    EXPECT_GT((*finished.report)["effects_bound"]["mean"], 0) << "a small hole may have been missed";
  }
}

TEST(Pipeline, WhatIsForcedOffShowsInTheAudit) {
  for (const auto integrator : {RenderRequest::Integrator::kGather, RenderRequest::Integrator::kRadiosity, RenderRequest::Integrator::kPathTrace}) {
    RenderRequest request = small_request();
    request.integrator = integrator;
    request.samples = 16;
    request.effects = "-gloss";  // a mirror that fills much of the view
    const Finished finished = render(test::own_scene_path("effects/mirror"), request);
    const json& error = (*finished.report)["accuracy"]["relative_rmse_ci95"];
    EXPECT_GT(error[0], 0.1) << error.dump();
  }
}

TEST(Pipeline, ALensIsPartOfTheView) {
  RenderRequest request = small_request();
  request.audit = false;
  request.lens_diameter = 0.3F;
  request.focus_distance = 1;
  const Finished blurred = render(test::own_scene_path("effects/depth_of_field"), request);
  request.effects = "-depth_of_field";
  const std::string off = image_digest(render(test::own_scene_path("effects/depth_of_field"), request).image);
  request.effects.clear();
  request.lens_diameter = 0.0F;
  EXPECT_NE(image_digest(blurred.image), off);
  EXPECT_EQ(image_digest(render(test::own_scene_path("effects/depth_of_field"), request).image), off);
}

TEST(Pipeline, RefusesTasksThatTheViewDoesNotHaveAndResultsThatAreMissing) {
  RenderRequest request = small_request();
  request.audit = false;
  const PreparedFiles files = prepared_files("plates", request);
  const Result<Prepared> prepared = Prepared::open(files.scene, files.solution, files.view);
  ASSERT_TRUE(prepared);
  EXPECT_EQ(run_task(*prepared, {Task::Kind::kTile, 9}).error().code, Code::kInvalidArgument);
  EXPECT_EQ(run_task(*prepared, {Task::Kind::kAudit, 0}).error().code, Code::kInvalidArgument);
  Results results = run_all(files);
  results.pop_back();
  EXPECT_EQ(finish(files.view, results, {}).error().code, Code::kDataLoss);
  results.push_back({});
  EXPECT_EQ(finish(files.view, results, {}).error().code, Code::kDataLoss);
}

TEST(Pipeline, RefusesAClosedSceneThatCanLoseNoLight) {
  const auto text = read_file(test::own_scene_path("furnace"), 1U << 20U);
  ASSERT_TRUE(text.has_value());
  json gltf = json::parse(*text);
  for (json& material : gltf["materials"]) material["pbrMetallicRoughness"]["baseColorFactor"] = {1, 1, 1, 1};
  const auto folder = TemporaryDirectory::create("radfarm-test");
  ASSERT_TRUE(folder.has_value());
  const auto path = folder->path() / "white.gltf";
  ASSERT_TRUE(write_file_atomically(path, gltf.dump()).has_value());
  const auto files = prepare(path, small_request());
  ASSERT_FALSE(files.has_value());
  EXPECT_EQ(files.error().code, Code::kInvalidArgument);
  EXPECT_THAT(files.error().message, testing::HasSubstr("no light can be lost"));
}

}  // namespace
}  // namespace radfarm
