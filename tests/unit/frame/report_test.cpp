#include "frame/report.h"

#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

namespace radfarm {
namespace {

using nlohmann::json;

json facts() {
  return {{"scene", {{"digest", "d"}}}, {"settings", {{"requested", json::object()}}}, {"stages", json::array()},
          {"counts", {{"links", 7}}},   {"warnings", json::array()},                   {"peak_memory_bytes", 5}};
}

Settings of_size(int width, int height) {
  Settings settings;
  settings.width = width, settings.height = height;
  return settings;
}

Raster kept_and_dropped() {
  Raster raster;
  raster.pixels.resize(2);
  raster.pixels[0].samples = 3;
  raster.pixels[1].samples = 4;
  raster.pixels[1].dropped = 1;
  return raster;
}

TEST(Report, KeepsTheFactsAndAddsWhatTheTasksCounted) {
  Counters counters;
  counters.camera_rays = 8;
  counters.visibility_rays = 30;
  counters.dropped_samples = 1;
  const FarmFacts farm{{{"a", 2, 1.5, 10}, {"b", 3, 2, 4}}, 3};
  const json report = make_report(facts(), of_size(5, 2), kept_and_dropped(), counters, std::nullopt, "image", farm);
  EXPECT_EQ(report["scene"]["digest"], "d");
  EXPECT_EQ(report["counts"]["links"], 7);
  EXPECT_EQ(report["counts"]["camera_rays"], 8);
  EXPECT_EQ(report["counts"]["visibility_samples_per_pixel"], 3);
  EXPECT_EQ(report["dropped_samples"]["count"], 1);
  EXPECT_EQ(report["dropped_samples"]["share"], 0.125);
  EXPECT_EQ(report["image"]["digest"], "image");
  EXPECT_EQ(report["workers"].size(), 2U);
  EXPECT_EQ(report["peak_memory_bytes"], 10);
  EXPECT_EQ(report["stages"].back()["name"], "tasks");
  EXPECT_EQ(report["stages"].back()["cpu_s"], 3.5);
}

TEST(Report, WithoutAuditItSaysNothingOfTheError) {
  const json report = make_report(facts(), of_size(2, 1), kept_and_dropped(), {}, std::nullopt, "", {});
  EXPECT_EQ(report["accuracy"]["audited_pixels"], 0);
  for (const char* key : {"mean", "rmse", "rmse_ci95", "relative_rmse", "relative_rmse_ci95"}) {
    EXPECT_TRUE(report["accuracy"].contains(key) && report["accuracy"][key].is_null()) << key;
  }
}

TEST(Report, AnErrorBelowResolutionHasAnIntervalButNoValue) {
  Accuracy accuracy;
  accuracy.audited_pixels = 9;
  accuracy.mean = 4;
  accuracy.rmse = MeasuredError{std::nullopt, 0, 0.5};
  accuracy.relative_rmse = MeasuredError{0.25, 0.125, 0.5};
  const json report = make_report(facts(), of_size(2, 1), kept_and_dropped(), {}, accuracy, "", {});
  EXPECT_TRUE(report["accuracy"]["rmse"].is_null());
  EXPECT_EQ(report["accuracy"]["rmse_ci95"], json::array({0, 0.5}));
  EXPECT_EQ(report["accuracy"]["relative_rmse"], 0.25);
  EXPECT_EQ(report["accuracy"]["audited_pixels"], 9);
}

TEST(Report, SettingsOfAPathTraceHaveNoGather) {
  Settings settings = of_size(2, 1);
  EXPECT_TRUE(to_json(settings).contains("radiosity"));
  EXPECT_TRUE(to_json(settings).contains("senders"));
  settings.integrator = Settings::Integrator::kPathTrace;
  EXPECT_FALSE(to_json(settings).contains("senders"));
  EXPECT_EQ(to_json(settings)["integrator"], "path-trace");
}

}  // namespace
}  // namespace radfarm
