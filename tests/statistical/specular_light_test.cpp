// DESIGN 3, E_specular: a gather carries what diffuse surfaces have from specular ones by photon paths, once.
#include <cmath>
#include <string>

#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include "statistical/rendered_request.h"

namespace radfarm {
namespace {

using Integrator = RenderRequest::Integrator;

// Links, interpolation and the width of discs: budgets of a share of the light.
constexpr double kBias = 0.03;
constexpr double kErrors = 4;  // one false alarm in 16000

RenderRequest request_of(Integrator integrator, int samples) {
  RenderRequest request;
  request.integrator = integrator;
  request.width = 32, request.height = 24;
  if (integrator == Integrator::kAuto) request.photons = 400000;
  request.samples = samples;
  request.audit = false;
  return request;
}

/// Mean of a layer over the image, luminance.
double mean(const Image& image, const std::string& layer) {
  double sum = 0;
  const float weights[] = {.2126F, .7152F, .0722F};
  const char* channels[] = {"R", "G", "B"};
  for (int c = 0; c < 3; ++c) {
    for (const float value : image.channels.at(layer + channels[c])) sum += static_cast<double>(weights[c] * value);
  }
  return sum / static_cast<double>(image.channels.at(layer + "R").size());
}

struct Means {
  double all = 0, specular = 0, error = 0;  // standard error of `all`
};

/// Over independent renders.
Means means_of(const std::string& scene, RenderRequest request, int renders) {
  Means m;
  double squared = 0;
  for (int i = 0; i < renders; ++i) {
    request.seed = static_cast<std::uint64_t>(i) + 1;
    const Finished finished = test::rendered(scene, request);
    const double all = mean(finished.image, "direct.") + mean(finished.image, "indirect.") + mean(finished.image, "specular.");
    m.all += all / renders, squared += all * all / renders;
    m.specular += mean(finished.image, "specular.") / renders;
  }
  m.error = std::sqrt(std::max(0.0, squared - m.all * m.all) / (renders - 1));
  return m;
}

class SpecularLightOf : public testing::TestWithParam<const char*> {};
INSTANTIATE_TEST_SUITE_P(Scenes, SpecularLightOf, testing::Values("globe", "mirror_faces_wall", "glass_sphere", "mirror"),
                         [](const auto& p) { return std::string(p.param); });

TEST_P(SpecularLightOf, IsWhatPathTracingFinds) {
  const std::string scene = std::string("effects/") + GetParam();
  constexpr int kRenders = 6;
  const Means traced = means_of(scene, request_of(Integrator::kPathTrace, 128), kRenders);
  const Means gathered = means_of(scene, request_of(Integrator::kAuto, 4), kRenders);
  ASSERT_GT(traced.specular, 0);
  const double noise = std::hypot(traced.error, gathered.error);
  RecordProperty("ratio", std::to_string(gathered.all / traced.all));
  RecordProperty("noise", std::to_string(noise / traced.all));
  EXPECT_LT(noise, 0.03 * traced.all);  // else the test says little
  EXPECT_NEAR(gathered.all, traced.all, kBias * traced.all + kErrors * noise);
  // A part by itself: what is lost in one must not be made good by another.
  EXPECT_NEAR(gathered.specular, traced.specular, kBias * traced.all + kErrors * noise);
}

TEST(SpecularLight, IsNeitherLostNorCountedTwiceInAClosedBox) {
  // L / (1 - rho) = 2 everywhere; emission seen is 1, by the mirror too.
  const Finished finished = test::rendered("effects/glowing_box", request_of(Integrator::kAuto, 4));
  const double all = mean(finished.image, "emission.") + mean(finished.image, "direct.") +
                     mean(finished.image, "indirect.") + mean(finished.image, "specular.");
  EXPECT_NEAR(all, 2, kBias);
  for (const auto& effect : (*finished.report)["effects"]) {
    EXPECT_TRUE(effect["id"] != "caustics" || effect["active"]);
  }
}

TEST(SpecularLight, IsLostBehindGlassWhereCausticsAreOff) {
  RenderRequest request = request_of(Integrator::kAuto, 4);
  request.effects = "-caustics";
  const Finished off = test::rendered("effects/globe", request);
  const Finished on = test::rendered("effects/globe", request_of(Integrator::kAuto, 4));
  EXPECT_LT(mean(off.image, "indirect.") + mean(off.image, "direct."), 0.5 * mean(on.image, "specular."));
  EXPECT_EQ((*off.report)["counts"]["photon_paths"], 0);
}

}  // namespace
}  // namespace radfarm
