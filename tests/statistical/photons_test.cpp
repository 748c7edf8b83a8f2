// --integrator paths from end to end.
#include <algorithm>
#include <cmath>

#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include "base/parallel.h"
#include "frame/report.h"
#include "image/digest.h"
#include "image/rgb.h"
#include "statistical/rendered_request.h"

namespace radfarm {
namespace {

RenderRequest request_of(RenderRequest::Integrator integrator) {
  RenderRequest request;
  request.integrator = integrator;
  request.quality = RenderRequest::Quality::kPreview;
  request.width = request.height = 24;
  request.samples = 4;
  request.tile = 8;
  request.audit = false;
  return request;
}

RenderRequest paths(std::uint64_t photons) {
  RenderRequest request = request_of(RenderRequest::Integrator::kPaths);
  request.photons = photons;
  return request;
}

Finished render(const std::string& scene, const RenderRequest& request, int threads = 1) {
  const ThreadLimit limit(threads);
  return test::rendered(scene, request);
}

double mean(const Image& image, const std::string& layer) {
  double sum = 0;
  for (const float value : image.channels.at(layer)) sum += static_cast<double>(value);
  return sum / static_cast<double>(image.channels.at(layer).size());
}

TEST(Photons, BringTheLightThatPathTracingFinds) {
  // By class, too. Noise of both, and the bias of radii at edges: the means of 576 pixels agree to 3 %.
  RenderRequest reference = request_of(RenderRequest::Integrator::kPathTrace);
  reference.samples = 256;
  const Finished photons = render("cornell", paths(400000)), traced = render("cornell", reference);
  for (const char* layer : {"direct.R", "direct.G", "indirect.R", "indirect.G", "indirect.B"}) {
    const double truth = mean(traced.image, layer);
    EXPECT_NEAR(mean(photons.image, layer), truth, .03 * truth) << layer;
  }
  EXPECT_EQ((*photons.report)["counts"]["photon_paths"], 400000);
  EXPECT_EQ((*photons.report)["settings"]["resolved"]["integrator"], "paths");
}

TEST(Photons, BringCaustics) {
  const Finished photons = render("effects/caustic", paths(400000));
  RenderRequest reference = request_of(RenderRequest::Integrator::kPathTrace);
  reference.samples = 1024;
  const Finished traced = render("effects/caustic", reference);
  const double truth = mean(traced.image, "specular.G");
  EXPECT_GT(truth, 0);
  EXPECT_NEAR(mean(photons.image, "specular.G"), truth, .15 * truth);  // the path tracer's noise
}

TEST(Photons, TheSameBitsForAnyTilesAndThreads) {
  const RenderRequest request = paths(20000);
  RenderRequest other = request;
  other.tile = 5;
  const std::string digest = image_digest(render("cornell", request).image);
  EXPECT_EQ(image_digest(render("cornell", request, 2).image), digest);
  EXPECT_EQ(image_digest(render("cornell", other, 2).image), digest);
  RenderRequest reseeded = request;
  reseeded.seed = 2;
  EXPECT_NE(image_digest(render("cornell", reseeded).image), digest);
}

RenderRequest photon_map(std::uint64_t photons) {
  RenderRequest request = paths(photons);
  request.integrator = RenderRequest::Integrator::kPhotonMap;
  return request;
}

TEST(PhotonMap, AgreesWithPathTracingOnAFlatFloor) {
  RenderRequest::PlacedCamera above;
  above.eye = {0, 1.5, 0};
  above.look_at = {0, 0, 0};
  above.up_vector = {0, 0, -1};
  RenderRequest request = photon_map(400000), reference = request_of(RenderRequest::Integrator::kPathTrace);
  request.camera = reference.camera = above;
  const double truth = mean(render("point_light", reference).image, "direct.G");
  EXPECT_GT(truth, 0);
  // 43 photons a disc at 576 pixels, and the falling off of a lamp 2 m above within .14 m: .5 % and .3 %.
  EXPECT_NEAR(mean(render("point_light", request).image, "direct.G"), truth, .02 * truth);
  request.radius = .2F;
  EXPECT_NEAR(mean(render("point_light", request).image, "direct.G"), truth, .02 * truth);
}

TEST(PhotonMap, TheSameBitsForAnyTilesAndThreads) {
  const RenderRequest request = photon_map(20000);
  RenderRequest other = request;
  other.tile = 5;
  const std::string digest = image_digest(render("cornell", request).image);
  EXPECT_EQ(image_digest(render("cornell", other, 2).image), digest);
  EXPECT_NE(image_digest(render("cornell", paths(20000)).image), digest);
}

TEST(PhotonMap, IsDarkerThanTheTruthWhereSurfacesMeet) {
  // Cornell: all of it within a few percent, less than the truth, for edges lose light.
  RenderRequest reference = request_of(RenderRequest::Integrator::kPathTrace);
  reference.samples = 256;
  const Finished photons = render("cornell", photon_map(400000)), traced = render("cornell", reference);
  for (const char* layer : {"direct.G", "indirect.G"}) {
    const double share = mean(photons.image, layer) / mean(traced.image, layer);
    EXPECT_LT(share, 1) << layer;
    EXPECT_GT(share, .85) << layer;
  }
}

TEST(Photons, OnePathIsEnoughForAnImage) {
  const Finished finished = render("cornell", paths(1));
  for (const auto& [name, values] : finished.image.channels) {
    EXPECT_TRUE(std::all_of(values.begin(), values.end(), [](float v) { return std::isfinite(v) && v >= 0; })) << name;
  }
}

}  // namespace
}  // namespace radfarm
