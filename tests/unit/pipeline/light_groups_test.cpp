// One image a light group: they add up to the image, each is what its lights alone give, and none is mixed up with another.
#include "pipeline/light_groups.h"

#include <algorithm>
#include <cmath>
#include <fstream>
#include <set>

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include "base/file.h"
#include "base/parallel.h"
#include "frame/light_layers.h"
#include "frame/view.h"
#include "image/digest.h"
#include "image/rgb.h"
#include "pipeline/pipeline.h"
#include "support/small_scenes.h"

namespace radfarm {
namespace {

using Integrator = RenderRequest::Integrator;
using nlohmann::json;
using testing::HasSubstr;

/// Of the Cornell box with a point light, under a sky: which of the three shine.
struct Lights {
  bool area = true, point = true, sky = true;
};

RenderRequest request_of(Integrator integrator, const Lights& lights = {}) {
  RenderRequest request;
  request.integrator = integrator;
  request.quality = RenderRequest::Quality::kPreview;
  request.width = request.height = 20;
  request.samples = 4;
  request.tile = 8;
  request.audit = false;
  request.link_error = 1e-3F;  // the light of many small solves
  request.aov = {"light"};
  if (lights.sky) request.env = "sky:overcast,lux=20";
  return request;
}

class LightGroups : public testing::Test {
 protected:
  /// The box as a file: with a point light "bulb.1", or with `bulbs` of these.
  std::filesystem::path box(const Lights& lights = {}, int bulbs = 1) {
    std::ifstream in(test::own_scene_path("cornell"));
    json document = json::parse(in);
    json& lamp = document["materials"][3];
    if (!lights.area) lamp.erase("emissiveFactor"), lamp.erase("extensions");
    for (int i = 0; lights.point && i < bulbs; ++i) {
      document["extensions"]["KHR_lights_punctual"]["lights"].push_back(
          {{"type", "point"}, {"name", "bulb." + std::to_string(i + 1)}, {"intensity", 3}});
      const json on_node = {{"KHR_lights_punctual", {{"light", i}}}};
      document["scenes"][0]["nodes"].push_back(document["nodes"].size());
      document["nodes"].push_back({{"translation", {0.3, 0.6, 0.3}}, {"extensions", on_node}});
    }
    if (lights.point) document["extensionsUsed"].push_back("KHR_lights_punctual");
    const std::filesystem::path file = folder_.path() / ("box" + std::to_string(files_++) + ".gltf");
    std::ofstream(file) << document;
    return file;
  }

  PreparedFiles prepared(const std::filesystem::path& scene, const RenderRequest& request, bool keeps = false) const {
    PrepareContext context;
    if (keeps) context.solutions = SolutionStore(folder_.path() / "solved", 1U << 30U);
    Result<PreparedFiles> files = prepare(scene, request, context);
    EXPECT_TRUE(files) << files.error().message;
    return std::move(*files);
  }

  static Finished finished(const PreparedFiles& files) {
    const Result<Prepared> prepared = Prepared::open(files.scene, files.solution, files.view);
    EXPECT_TRUE(prepared) << prepared.error().message;
    const std::vector<Task> tasks = *cut_tasks(files.view);
    std::vector<std::vector<std::byte>> results(tasks.size());
    // The last first: no result may depend on what ran before.
    parallel_for(tasks.size(), 1, [&](std::size_t begin, std::size_t end) {
      for (std::size_t i = begin; i < end; ++i) {
        const std::size_t last = tasks.size() - 1 - i;
        results[last] = *run_task(*prepared, tasks[last]);
      }
    });
    Result<Finished> done = finish(files.view, results, {});
    EXPECT_TRUE(done) << done.error().message;
    return std::move(*done);
  }

  Finished render(const std::filesystem::path& scene, const RenderRequest& request) const {
    return finished(prepared(scene, request));
  }

  TemporaryDirectory folder_ = *TemporaryDirectory::create("radfarm-light-groups");
  int files_ = 0;
};

const std::vector<std::string> kGroups = {"bulb_1", "environment", "light"};  // by name; rendered: light, bulb_1, environment

std::vector<float> luminances(const Image& image, const std::string& layer) {
  const RgbLayer light = rgb_layer(image, layer).value();
  std::vector<float> values;
  for (std::size_t i = 0; i < image.pixel_count(); ++i) values.push_back(luminance(light.at(i)));
  return values;
}

double mean_of(const Image& image, const std::string& layer) {
  double sum = 0;
  for (const float value : luminances(image, layer)) sum += static_cast<double>(value);
  return sum / static_cast<double>(image.pixel_count());
}

/// All but emission, channel by channel: what the layers light.NAME must add up to, within the rounding of as many floats.
void expect_to_add_up(const Image& image, const std::vector<std::string>& groups) {
  for (const char* color : {".R", ".G", ".B"}) {
    for (std::size_t i = 0; i < image.pixel_count(); ++i) {
      double reflected = 0, sum = 0;
      for (const char* part : {"direct", "indirect", "specular"}) {
        reflected += static_cast<double>(image.channels.at(std::string(part) + color)[i]);
      }
      for (const std::string& group : groups) sum += static_cast<double>(image.channels.at("light." + group + color)[i]);
      const double beauty = static_cast<double>(image.channels.at(color + 1)[i]);
      const double emission = static_cast<double>(image.channels.at(std::string("emission") + color)[i]);
      ASSERT_NEAR(sum, reflected, 1e-6 * reflected) << i;
      ASSERT_NEAR(sum + emission, beauty, 1e-6 * beauty) << i;
    }
  }
}

class EveryIntegrator : public LightGroups, public testing::WithParamInterface<std::pair<Integrator, Gather>> {};
INSTANTIATE_TEST_SUITE_P(LightGroups, EveryIntegrator,
                         testing::Values(std::pair(Integrator::kPathTrace, Gather::kDefault),
                                         std::pair(Integrator::kGather, Gather::kDefault),
                                         std::pair(Integrator::kGather, Gather::kPaper),
                                         std::pair(Integrator::kFullGather, Gather::kDefault),
                                         std::pair(Integrator::kPaths, Gather::kDefault),
                                         std::pair(Integrator::kRadiosity, Gather::kDefault)));

TEST_P(EveryIntegrator, LayersAddUpToAllButEmission) {
  RenderRequest request = request_of(GetParam().first);
  request.gather = GetParam().second;
  const Finished done = render(box(), request);
  EXPECT_EQ(light_groups_of(done.image), kGroups);
  expect_to_add_up(done.image, kGroups);
  double shares = 0;
  for (const json& row : (*done.report)["light_groups"]) {
    EXPECT_GT(row["power_lm"], 0);
    EXPECT_GT(row["share_of_image"], 0.02) << row;
    shares += row["share_of_image"].get<double>();
  }
  EXPECT_NEAR(shares, 1, 1e-9);
  EXPECT_GT(mean_of(done.image, "emission"), 0) << "the lamp is seen";
}

/// A layer's mean against those of renders with other seeds of a scene that has only its lights: Student's t of 5 of these and
/// one more, 4 degrees of freedom, where |t| > 8.61 in one of 1000.
TEST_P(EveryIntegrator, LayersAreWhatTheirLightsAloneGive) {
  constexpr int kSeeds = 5;
  RenderRequest request = request_of(GetParam().first);
  request.gather = GetParam().second;
  const Image image = render(box(), request).image;
  const std::pair<const char*, Lights> cases[] = {
      {"light.light", {true, false, false}}, {"light.bulb_1", {false, true, false}}, {"light.environment", {false, false, true}}};
  for (const auto& [layer, lights] : cases) {
    double sum = 0, squares = 0;
    for (int seed = 0; seed < kSeeds; ++seed) {
      RenderRequest alone = request_of(GetParam().first, lights);
      alone.gather = GetParam().second;
      alone.aov.clear();
      alone.seed = 100 + static_cast<std::uint64_t>(seed);
      const Image other = render(box(lights), alone).image;
      const double mean = mean_of(other, "direct") + mean_of(other, "indirect") + mean_of(other, "specular");
      sum += mean, squares += mean * mean;
    }
    const double mean = sum / kSeeds, variance = (squares - sum * mean) / (kSeeds - 1);
    EXPECT_NEAR(mean_of(image, layer), mean, 8.61 * std::sqrt(variance * (1 + 1.0 / kSeeds))) << layer;
    EXPECT_LT(std::sqrt(variance), 0.1 * mean) << layer << ": too noisy to tell";
  }
}

TEST_F(LightGroups, OfOneGroupAreTheImageThatItIsWithoutThem) {
  for (const Integrator integrator : {Integrator::kPathTrace, Integrator::kGather, Integrator::kRadiosity}) {
    RenderRequest request = request_of(integrator, {true, false, false});
    Image image = render(test::own_scene_path("cornell"), request).image;
    expect_to_add_up(image, {"light"});
    request.aov.clear();
    const Image plain = render(test::own_scene_path("cornell"), request).image;
    for (const auto& [name, values] : plain.channels) EXPECT_EQ(image.channels.at(name), values) << name;
  }
}

TEST_F(LightGroups, AreTheSameBitsForAnyTilesAndThreads) {
  const std::filesystem::path scene = box();
  for (const Integrator integrator : {Integrator::kPathTrace, Integrator::kGather, Integrator::kRadiosity}) {
    std::set<std::string> digests;
    for (const int threads : {1, 2}) {
      const ThreadLimit limit(threads);
      RenderRequest request = request_of(integrator);
      request.tile = threads == 1 ? 7 : 32;
      digests.insert(image_digest(render(scene, request).image));
    }
    EXPECT_EQ(digests.size(), 1U) << static_cast<int>(integrator);
  }
}

TEST_F(LightGroups, AreAuditedAsOneImage) {
  RenderRequest request = request_of(Integrator::kGather);
  request.audit = true;
  const PreparedFiles files = prepared(box(), request);
  const std::vector<Task> tasks = *cut_tasks(files.view);
  const auto is_audit = [](const Task& task) { return task.kind == Task::Kind::kAudit; };
  request.aov.clear();
  const PreparedFiles plain = prepared(box(), request);
  const std::vector<Task> others = *cut_tasks(plain.view);
  EXPECT_EQ(std::count_if(tasks.begin(), tasks.end(), is_audit), std::count_if(others.begin(), others.end(), is_audit));
  // The audit's paths see all emitters: groups together are not further off than the image by all of them.
  const auto error = [](const PreparedFiles& of) { return (*finished(of).report)["accuracy"]["relative_rmse_ci95"]; };
  const json together = error(files), at_once = error(plain);
  EXPECT_LT(together[0], at_once[1]) << together << " " << at_once;
}

TEST_F(LightGroups, AddUpTheOtherAovs) {
  RenderRequest request = request_of(Integrator::kPathTrace);
  request.aov = {"all", "light"};
  const Image image = render(box(), request).image;
  request.aov = {"all"};
  const Image plain = render(box(), request).image;
  for (const auto& [name, values] : plain.channels) EXPECT_TRUE(image.channels.contains(name)) << name;
  EXPECT_EQ(image.channels.at("depth.Z"), plain.channels.at("depth.Z"));
  EXPECT_EQ(image.channels.at("samples.camera")[5], 3 * plain.channels.at("samples.camera")[5]);
}

TEST_F(LightGroups, AboveTheLimitAreOneClearError) {
  const Result<PreparedFiles> files = prepare(box({}, 15), request_of(Integrator::kPathTrace));
  ASSERT_FALSE(files);
  EXPECT_EQ(files.error().code, Code::kResourceExhausted);
  EXPECT_THAT(files.error().message, HasSubstr("17 light groups, at most 16"));
  EXPECT_TRUE(prepare(box({}, 14), request_of(Integrator::kPathTrace)));
}

TEST_F(LightGroups, WithoutPowerAreNone) {
  RenderRequest request = request_of(Integrator::kGather, {false, false, false});
  std::ifstream in(test::own_scene_path("cornell"));
  json document = json::parse(in);
  document["materials"][3]["extensions"]["KHR_materials_emissive_strength"]["emissiveStrength"] = 0;
  const std::filesystem::path scene = folder_.path() / "dark.gltf";
  std::ofstream(scene) << document << std::flush;
  const Finished done = render(scene, request);
  EXPECT_EQ(light_groups_of(done.image), std::vector<std::string>());
  EXPECT_EQ((*done.report)["light_groups"], json::array());
}

TEST_F(LightGroups, KeepSolutionsThatAreNotMixedUp) {
  const std::filesystem::path scene = box();
  const RenderRequest request = request_of(Integrator::kRadiosity);
  const PreparedFiles first = prepared(scene, request, true);
  const json facts = json::parse(decode_views(first.view)->at(0).facts);
  EXPECT_FALSE(facts["solution"]["reused"]);
  std::set<std::string> digests;
  for (const json& row : facts["light_groups"]) {
    EXPECT_FALSE(row["solution"]["reused"]);
    digests.insert(row["solution"]["digest"]);
  }
  EXPECT_EQ(digests.size(), 3U);
  const PreparedFiles second = prepared(scene, request, true);
  EXPECT_EQ(second.solution, first.solution);
  EXPECT_TRUE(json::parse(decode_views(second.view)->at(0).facts)["solution"]["reused"]);
  RenderRequest plain = request;
  plain.aov.clear();
  const PreparedFiles all = prepared(scene, plain, true);
  EXPECT_FALSE(json::parse(decode_views(all.view)->at(0).facts)["solution"]["reused"]) << "all light is no group's";
  EXPECT_EQ(finished(second).image.channels, finished(prepared(scene, request)).image.channels);
}

TEST_F(LightGroups, OfAnotherSceneOrDamagedAreRefused) {
  const PreparedFiles files = prepared(box(), request_of(Integrator::kRadiosity));
  const PreparedFiles other = prepared(test::own_scene_path("cornell"), request_of(Integrator::kRadiosity, {true, false, false}));
  EXPECT_EQ(Prepared::open(other.scene, files.solution, files.view).error().code, Code::kDataLoss);
  EXPECT_EQ(Prepared::open(files.scene, other.solution, files.view).error().code, Code::kDataLoss);
  std::vector<std::vector<std::byte>> results(cut_tasks(files.view)->size() - 1);
  EXPECT_EQ(finish(files.view, results, {}).error().code, Code::kDataLoss);
}

TEST_F(LightGroups, ExplainSaysWhatTheyCost) {
  const std::filesystem::path scene = box();
  RenderRequest request = request_of(Integrator::kPathTrace);
  const json plan = explain(scene, request).value();
  ASSERT_EQ(plan["light_groups"].size(), 3U);
  EXPECT_EQ(plan["light_groups"][1]["name"], "bulb_1");
  request.aov.clear();
  const json plain = explain(scene, request).value();
  EXPECT_FALSE(plain.contains("light_groups"));
  // Both are measured: about three times as much.
  EXPECT_GT(plan["expected"]["cpu_s"][1], 1.5 * plain["expected"]["cpu_s"][1].get<double>());
}

}  // namespace
}  // namespace radfarm
