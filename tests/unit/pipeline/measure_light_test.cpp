#include "pipeline/measure_light.h"

#include <cmath>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "support/small_scenes.h"

namespace radfarm {
namespace {

using testing::HasSubstr;

MeasureRequest with_points(const std::string& csv) {
  MeasureRequest request;
  request.points = csv;
  request.samples = 4096;
  return request;
}

TEST(MeasureLight, PointsAreInTheFilesCoordinates) {
  const auto light = measure_light(test::own_scene_path("cornell"), with_points("0.5,0.5,0.5,0,1,0\n0.5,0.5,0.5,0,-1,0\n"));
  ASSERT_TRUE(light) << light.error().message;
  ASSERT_EQ(light->readings.size(), 2U);
  EXPECT_NEAR(static_cast<double>(light->meters[0].point.x) + light->origin.x, .5, 1e-6);
  EXPECT_GT(light->readings[0].lux(), light->readings[1].lux());  // the lamp is above
  EXPECT_GT(light->readings[1].lux(), 0);
}

TEST(MeasureLight, BothMethodsAgreeOnAWorkPlane) {
  MeasureRequest request;
  request.plane = {.3F, .25F, {}};
  request.picture = true;
  const auto gathered = measure_light(test::own_scene_path("cornell"), request);
  ASSERT_TRUE(gathered) << gathered.error().message;
  request.method = MeasureRequest::Method::kPaths;
  request.photons = 400000;
  const auto paths = measure_light(test::own_scene_path("cornell"), request);
  ASSERT_TRUE(paths) << paths.error().message;
  EXPECT_GE(gathered->summary.points, 9U);
  EXPECT_EQ(gathered->summary.points, paths->summary.points);
  EXPECT_NEAR(paths->summary.mean, gathered->summary.mean, .02 * gathered->summary.mean);
  EXPECT_GT(gathered->png.size(), 100U);
  EXPECT_FALSE(gathered->levels.empty());
}

TEST(MeasureLight, SaysWhatIsWrong) {
  const auto message = [](const std::string& scene, const MeasureRequest& request) {
    const auto light = measure_light(test::own_scene_path(scene), request);
    return light ? std::string("accepted") : light.error().message;
  };
  EXPECT_THAT(message("cornell", with_points("1,2\n")), HasSubstr("line 1"));
  EXPECT_THAT(message("no_such_scene", with_points("0,1,0\n")), HasSubstr("cannot open"));
}

}  // namespace
}  // namespace radfarm
