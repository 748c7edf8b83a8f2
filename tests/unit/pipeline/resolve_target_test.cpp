#include "pipeline/resolve.h"

#include <cmath>

#include <gtest/gtest.h>

#include "pipeline/pipeline.h"

namespace radfarm {
namespace {

using Quality = RenderRequest::Quality;

RenderRequest of_error(double error) {
  RenderRequest request;
  request.error = error;
  return request;
}

TEST(ResolveTarget, AQualityIsALevelAndBetweenTwoLiesWhatIsBetween) {
  RenderRequest request;
  for (const Quality quality : {Quality::kPreview, Quality::kStandard, Quality::kHigh, Quality::kReference}) {
    request.quality = quality;
    EXPECT_EQ(resolve_settings(request, {}).level, static_cast<float>(quality));
  }
  request.quality = Quality::kStandard;
  const Settings standard = resolve_settings(request, {});
  request.quality = Quality::kHigh;
  const Settings high = resolve_settings(request, {}), between = resolve_settings(request, {}, {1.5F, false, 1});
  EXPECT_LT(between.radiosity.max_link_error, standard.radiosity.max_link_error);
  EXPECT_GT(between.radiosity.max_link_error, high.radiosity.max_link_error);
  EXPECT_GT(between.senders.columns, standard.senders.columns);
  EXPECT_LT(between.senders.columns, high.senders.columns);
  EXPECT_EQ(resolve_settings(request, {}, {2.0F, false, 1}).senders.columns, high.senders.columns);
}

TEST(ResolveTarget, ASmallerErrorHasFinerLightAndLessNoise) {
  float level = -1, share = 2;
  for (const double error : {0.3, 0.1, 0.05, 0.02, 0.01, 0.002}) {
    const Settings settings = resolve_settings(of_error(error), {});
    EXPECT_GE(settings.level, level);
    EXPECT_LE(settings.level, kMostLevel);
    EXPECT_LT(noise_share(of_error(error), settings), share);
    EXPECT_EQ(settings.target_error, static_cast<float>(error));
    level = settings.level, share = noise_share(of_error(error), settings);
  }
  RenderRequest counted = of_error(0.02);
  counted.samples = 3;
  EXPECT_EQ(noise_share(counted, resolve_settings(counted, {})), 0) << "the same number everywhere, as asked for";
}

TEST(ResolveTarget, PathsAloneAreTracedWhereRoundsDecideSo) {
  const Settings settings = resolve_settings(of_error(0.02), {}, {2.0F, true, 1});
  EXPECT_EQ(settings.integrator, Settings::Integrator::kPathTrace);
  EXPECT_EQ(settings.shares_light, 0);
}

TEST(ResolveTarget, PathsGetTheSamplesThatTheirVarianceNeeds) {
  PathPilot pilot;
  pilot.mean = 2;
  pilot.path_variance = 1;  // a quarter of the mean squared
  RenderRequest request = of_error(0.02);
  request.integrator = RenderRequest::Integrator::kPathTrace;
  Settings settings = resolve_settings(request, {});
  resolve_paths(request, pilot, 1, settings);
  // A pixel that scatters by 1 gets 1 / noise samples, and keeps a variance of `noise`.
  EXPECT_GT(settings.noise, 0);
  EXPECT_LT(static_cast<double>(settings.noise) * 0.7, 0.02 * 0.02 * 4);
  EXPECT_GE(settings.camera_samples, 8U);
  EXPECT_GT(settings.max_camera_samples, 1 / settings.noise);
}

TEST(ResolveTarget, ATargetIsWhatTheRequestSays) {
  EXPECT_FALSE(target_of(RenderRequest()).is_set());
  EXPECT_EQ(target_of(of_error(0.02)), (Target{0.02, 0}));
  RenderRequest request;
  request.time = 60;
  EXPECT_EQ(target_of(request), (Target{0, 60}));
}

}  // namespace
}  // namespace radfarm
