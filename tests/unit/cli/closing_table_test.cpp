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

}  // namespace
}  // namespace radfarm::cli
