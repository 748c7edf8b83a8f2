#include "cli/report_page.h"

#include <vector>

#include <gmock/gmock.h>

namespace radfarm::cli {
namespace {

using nlohmann::json;
using testing::HasSubstr;
using testing::Not;

const std::vector<std::byte> kPng(3, std::byte{'a'});

TEST(ReportPage, SaysWhatTheReportSays) {
  const json report = {
      {"image", {{"path", "office.exr"}}},
      {"accuracy",
       {{"audited_pixels", 100}, {"relative_rmse", .021}, {"relative_rmse_ci95", {.018, .024}},
        {"map", {{"columns", 2}, {"share", {.75, .25}}}}}},
      {"stages", {{{"name", "radiosity"}, {"wall_s", 1.5}, {"cpu_s", 3}}, {{"name", "tasks"}, {"wall_s", 4}, {"cpu_s", 9}}}},
      {"effects", {{{"id", "caustics"}, {"active", false}, {"value", .001}, {"bound", .02}, {"bound_kind", "heuristic"}, {"test", "share > 0.005"}}}},
      {"next_halving", {{"cpu_s", 40.0}}},
      {"rounds", {{{"kind", "first"}, {"relative_rmse", .05}, {"cpu_s", 2.0}}}},
      {"warnings", {"framed <the> bulk"}}};
  const std::string page = report_page(report, kPng);
  EXPECT_THAT(page, HasSubstr("relative error 2.1 % (95 %: 1.8 % to 2.4 %)"));
  EXPECT_THAT(page, HasSubstr("data:image/png;base64,YWFh"));
  EXPECT_THAT(page, HasSubstr("radiosity"));
  EXPECT_THAT(page, HasSubstr("12.00")) << "the sum of CPU seconds";
  EXPECT_THAT(page, HasSubstr("75.0 %"));
  EXPECT_THAT(page, HasSubstr("<td>5 %</td>")) << "of the first round";
  EXPECT_THAT(page, HasSubstr("about 40 CPU s"));
  EXPECT_THAT(page, HasSubstr("framed &lt;the&gt; bulk"));
  EXPECT_THAT(page, Not(HasSubstr("http"))) << "needs nothing else";
}

TEST(ReportPage, LeavesOutWhatIsNotThere) {
  const std::string page = report_page(json::object(), {});
  EXPECT_THAT(page, HasSubstr("not measured"));
  EXPECT_THAT(page, Not(HasSubstr("<img")));
  EXPECT_THAT(page, Not(HasSubstr("Rounds")));
}

}  // namespace
}  // namespace radfarm::cli
