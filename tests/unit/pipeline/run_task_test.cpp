// AOVs of whole renders, in one process.
#include <array>
#include <cmath>
#include <numbers>

#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include "pipeline/pipeline.h"
#include "support/small_scenes.h"

namespace radfarm {
namespace {

using Integrator = RenderRequest::Integrator;

Image render(const std::string& scene, const RenderRequest& request) {
  const Result<PreparedFiles> files = prepare(test::own_scene_path(scene), request);
  EXPECT_TRUE(files.has_value()) << files.error().message;
  const Result<Prepared> prepared = Prepared::open(files->scene, files->solution, files->view);
  EXPECT_TRUE(prepared.has_value()) << prepared.error().message;
  std::vector<std::vector<std::byte>> results;
  const std::vector<Task> tasks = *cut_tasks(files->view);
  for (const Task& task : tasks) results.push_back(*run_task(*prepared, task));
  Result<Finished> finished = finish(files->view, results, {});
  EXPECT_TRUE(finished.has_value()) << finished.error().message;
  return std::move(finished->image);
}

std::string name_of(Integrator integrator) {
  if (integrator == Integrator::kPathTrace) return "PathTrace";
  return integrator == Integrator::kRadiosity ? "Radiosity" : "Gather";
}

class AovOf : public testing::TestWithParam<Integrator> {
 protected:
  RenderRequest small_request() const {
    RenderRequest request;
    request.integrator = GetParam();
    request.quality = RenderRequest::Quality::kPreview;
    request.width = request.height = 24;
    request.samples = 2;
    request.tile = 8;
    request.audit = false;
    request.aov = {"all"};
    return request;
  }
};

INSTANTIATE_TEST_SUITE_P(Integrators, AovOf,
                         testing::Values(Integrator::kGather, Integrator::kPathTrace, Integrator::kRadiosity),
                         [](const testing::TestParamInfo<Integrator>& of) { return name_of(of.param); });

TEST_P(AovOf, LeavesTheLightAsItIs) {
  RenderRequest request = small_request();
  const Image with = render("cornell", request);
  request.aov.clear();
  const Image without = render("cornell", request);
  EXPECT_GT(with.channels.size(), without.channels.size());
  for (const auto& [name, values] : without.channels) EXPECT_EQ(with.channels.at(name), values) << name;
}

TEST_P(AovOf, DoesNotDependOnTiles) {
  RenderRequest request = small_request();
  const Image first = render("cornell", request);
  request.tile = 11;
  EXPECT_EQ(render("cornell", request).channels, first.channels);
}

TEST_P(AovOf, PlainSurfacesHaveTheirBaseColourAndReflectWhatTheyReceive) {
  const RenderRequest request = small_request();
  const Image image = render("cornell", request);
  const std::array<std::array<float, 3>, 3> paints = {{{.73F, .73F, .73F}, {.63F, .065F, .05F}, {.14F, .45F, .091F}}};
  int painted = 0;
  for (std::size_t i = 0; i < image.pixel_count(); ++i) {
    EXPECT_EQ(image.channels.at("samples.camera")[i], 2);
    for (const auto& paint : paints) {
      if (std::fabs(image.channels.at("albedo.R")[i] - paint[0]) > 1e-6F) continue;
      ++painted;
      for (std::size_t c = 0; c < 3; ++c) {
        const std::string channel(1, "RGB"[c]);
        EXPECT_NEAR(image.channels.at("albedo." + channel)[i], paint[c], 1e-6F);
        const float reflected = image.channels.at("direct." + channel)[i] + image.channels.at("indirect." + channel)[i];
        const float expected = paint[c] / std::numbers::pi_v<float> * image.channels.at("irradiance." + channel)[i];
        // Rounding of a few float operations.
        EXPECT_NEAR(reflected, expected, 1e-5F * expected) << channel << i;
      }
      const auto square = [&](const char* n) { return std::pow(image.channels.at(n)[i], 2.0F); };
      EXPECT_LE(square("normal.X") + square("normal.Y") + square("normal.Z"), 1.0001F);
    }
  }
  EXPECT_GT(painted, 24 * 24 / 2);
}

TEST_P(AovOf, APointLightFollowsTheInverseSquareLaw) {
  RenderRequest request = small_request();
  request.width = request.height = 2;
  request.camera = RenderRequest::PlacedCamera{{1.5, 1, 0.25}, {1.5, 0, 0.25}, {0, 0, 1}, 45, 1e-4};
  const Image image = render("point_light", request);
  // 100 cd, 2 m above the floor: E = I cos / r^2. 1e-4: half a pixel, and float roundings.
  const double squared = 4 + 1.5 * 1.5 + 0.0625, lux = 100 * 2 / (squared * std::sqrt(squared));
  for (std::size_t i = 0; i < 4; ++i) {
    // Radiosity shows its elements, and a floor that lights nothing is not cut.
    if (GetParam() != Integrator::kRadiosity) {
      EXPECT_NEAR(image.channels.at("irradiance.G")[i] / lux, 1, 1e-4);
    }
    EXPECT_NEAR(image.channels.at("depth.Z")[i], 1, 1e-5);
    EXPECT_NEAR(image.channels.at("normal.Y")[i], 1, 1e-6);
    EXPECT_NEAR(image.channels.at("albedo.B")[i], 0.5, 1e-6);
  }
}

TEST(Aov, TheClassesOfAGatherAddUpAndACellIsThereWhereSomethingIsSeen) {
  RenderRequest request;
  request.quality = RenderRequest::Quality::kPreview;
  request.width = request.height = 24;
  request.samples = 2;
  request.audit = false;
  request.aov = {"classification", "grid", "depth", "samples.formfactor"};
  const Image image = render("cornell", request);
  double both = 0, form_factors = 0;
  for (std::size_t i = 0; i < image.pixel_count(); ++i) {
    const auto share = [&](const char* name) { return image.channels.at(std::string("classification.") + name)[i]; };
    const bool is_seen = image.channels.at("depth.Z")[i] > 0;
    const float sum = share("interpolated") + share("formfactor") + share("visibility") + share("both");
    EXPECT_NEAR(sum, is_seen ? 1 : 0, 1e-6F);
    EXPECT_EQ(image.channels.at("grid.cell")[i] >= 0, is_seen);
    both += static_cast<double>(share("both"));
    form_factors += static_cast<double>(image.channels.at("samples.formfactor")[i]);
  }
  EXPECT_GT(both, 0);
  EXPECT_GT(form_factors, 0);
}

}  // namespace
}  // namespace radfarm
