#include "cli/closing_table.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace radfarm::cli {
namespace {

using nlohmann::json;
using testing::HasSubstr;

json accuracy(const json& value, const json& interval) {
  return {{"accuracy", {{"audited_pixels", 256}, {"relative_rmse", value}, {"relative_rmse_ci95", interval}}}};
}

TEST(AccuracyLine, SaysTheErrorWithItsInterval) {
  EXPECT_EQ(accuracy_line(accuracy(0.012, {0.009, 0.016})),
            "relative error 1.2 % (95 %: 0.9 % to 1.6 %), 256 pixels audited");
}

TEST(AccuracyLine, NeverSaysZero) {
  EXPECT_EQ(accuracy_line(accuracy(nullptr, {0, 0.004})), "relative error < 0.4 % (95 %), 256 pixels audited");
}

TEST(AccuracyLine, SaysWhenThereIsNothingToSay) {
  EXPECT_THAT(accuracy_line(json::object()), HasSubstr("not measured"));
  EXPECT_THAT(accuracy_line(accuracy(nullptr, nullptr)), HasSubstr("black"));
}

TEST(ClosingTable, ShowsStagesCountsAndEffects) {
  const json report = {
      {"stages", {{{"name", "radiosity"}, {"wall_s", 1.5}, {"cpu_s", 3.25}}}},
      {"counts", {{"camera_rays", 1000}, {"photon_paths", 0}}},
      {"effects", {{{"id", "caustics"}, {"active", false}}, {{"id", "area_lights"}, {"active", true}}}},
      {"warnings", {"the image is black"}}};
  const std::string table = closing_table(report);
  EXPECT_THAT(table, HasSubstr("radiosity                      1.50       3.25"));
  EXPECT_THAT(table, HasSubstr("camera_rays"));
  EXPECT_THAT(table, testing::Not(HasSubstr("photon_paths")));
  EXPECT_THAT(table, HasSubstr("effects on:  area_lights"));
  EXPECT_THAT(table, HasSubstr("effects off: caustics"));
  EXPECT_THAT(table, HasSubstr("warning: the image is black"));
}

TEST(ClosingTable, SurvivesAReportOfAnotherShape) {
  EXPECT_NO_THROW(closing_table(json{{"stages", {1, "x"}}, {"effects", {nullptr}}, {"counts", {{"a", "b"}}}}));
}

TEST(RoundsTable, ShowsEachRoundTheTargetAndTheNextHalving) {
  const json report = {{"accuracy", {{"target", 0.02}, {"target_met", false}}},
                       {"rounds",
                        {{{"kind", "first"}, {"samples", 16.0}, {"cpu_s", 4.0}, {"wall_s", 2.0},
                          {"relative_rmse", 0.04}, {"ci95", {0.03, 0.05}}},
                         {{"kind", "more samples"}, {"samples", 64.0}, {"cpu_s", 9.0}, {"wall_s", 5.0},
                          {"relative_rmse", nullptr}, {"ci95", {0.0, 0.021}}}}},
                       {"next_halving", {{"cpu_s", 40.0}, {"wall_s", 20.0}, {"from", "the noise of the samples"}}}};
  const std::string table = rounds_table(report);
  EXPECT_THAT(table, HasSubstr("4 % (95 %: 3 % to 5 %)"));
  EXPECT_THAT(table, HasSubstr("2     more samples       64.0       9.00       5.00   < 2.1 %"));
  EXPECT_THAT(table, HasSubstr("relative error below 2 %: NOT met"));
  EXPECT_THAT(table, HasSubstr("half the error would cost about 40 CPU s more, 20 s of wall time (by the noise of the samples)"));
  EXPECT_EQ(rounds_table(json::object()), "");
  EXPECT_THAT(rounds_table({{"time", {{"target_s", 60.0}, {"elapsed_s", 51.3}}}}), HasSubstr("target: 60 s; it took 51.3 s"));
  EXPECT_NO_THROW(rounds_table({{"accuracy", {{"target", 0.1}}}, {"rounds", {1, nullptr}}, {"time", 7}}));
}

}  // namespace
}  // namespace radfarm::cli
