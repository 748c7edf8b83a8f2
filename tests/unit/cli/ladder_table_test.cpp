#include "cli/ladder_table.h"

#include <gmock/gmock.h>

#include "cli/ladder_page.h"

namespace radfarm::cli {
namespace {

using testing::HasSubstr;

LadderRow row(const char* name, const char* curve, double cpu_s, double error) {
  LadderRow r;
  r.name = name, r.curve = curve, r.cpu_s = cpu_s, r.wall_s = cpu_s / 2;
  r.error.relative = error, r.error.relative_low = .9 * error, r.error.relative_high = 1.1 * error;
  return r;
}

std::vector<LadderRow> ladder() {
  std::vector<LadderRow> rows = {row("a-1", "a", 1, .2), row("a-2", "a", 4, .1), row("b-1", "b", 2, .3), row("b-2", "b", 16, .05)};
  mark_best(rows);
  return rows;
}

TEST(Ladder, TheFrontHasWhatNothingCheaperBeats) {
  const std::vector<LadderRow> rows = ladder();
  EXPECT_TRUE(rows[0].is_best);
  EXPECT_TRUE(rows[1].is_best);
  EXPECT_FALSE(rows[2].is_best) << "a-1 is cheaper and better";
  EXPECT_TRUE(rows[3].is_best);
}

TEST(Ladder, FindsTheCheapestForAnErrorAndTheSlope) {
  const std::vector<LadderRow> rows = ladder();
  EXPECT_EQ(cheapest_for(rows, .1)->name, "a-2");
  EXPECT_EQ(cheapest_for(rows, .06)->name, "b-2");
  EXPECT_EQ(cheapest_for(rows, .01), nullptr);
  EXPECT_NEAR(slope_of(rows, "a"), -.5, 1e-12);
  EXPECT_EQ(slope_of(rows, "none"), 0);
}

TEST(Ladder, StandsInItsCsvAndItsPage) {
  const std::string csv = to_csv(ladder());
  EXPECT_THAT(csv, HasSubstr("\na-1,a,1.000,0.500,0.2,0.18,0.22,1,0,1\n"));
  const std::string page = ladder_page({"office.gltf", "radfarm ladder", ladder(), std::vector<RowPictures>(4), {}, .01, .2});
  EXPECT_THAT(page, HasSubstr("What accuracy costs: office.gltf"));
  EXPECT_THAT(page, HasSubstr("<td>10 %</td><td>a-2</td>"));
  EXPECT_THAT(page, HasSubstr("none of these"));
  EXPECT_THAT(page, HasSubstr("<td>a</td><td>-0.50</td><td>4</td>"));
  EXPECT_THAT(page, HasSubstr("<svg"));
}

}  // namespace
}  // namespace radfarm::cli
