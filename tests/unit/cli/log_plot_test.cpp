#include "cli/log_plot.h"

#include <gmock/gmock.h>

namespace radfarm::cli {
namespace {

using testing::HasSubstr;
using testing::Not;

std::size_t count(const std::string& text, const std::string& what) {
  std::size_t n = 0;
  for (std::size_t at = text.find(what); at != std::string::npos; at = text.find(what, at + 1)) ++n;
  return n;
}

TEST(LogPlot, HasEachPointItsIntervalAndItsCurvesName) {
  const std::string svg = draw({"s", "error", {{"gather", {{1, .1, .05, .2, "preview"}, {10, .02, 0, 0, "standard"}}}}});
  EXPECT_EQ(count(svg, "<circle"), 2U);
  EXPECT_THAT(svg, HasSubstr("<title>preview</title>"));
  EXPECT_THAT(svg, HasSubstr(">gather</text>"));
  EXPECT_EQ(count(svg, "stroke-opacity"), 1U);
  EXPECT_THAT(svg, HasSubstr(">0.05</text>"));
  EXPECT_THAT(svg, HasSubstr(">10</text>"));
}

TEST(LogPlot, LeavesOutWhatHasNoLogarithm) {
  EXPECT_THAT(draw({"s", "error", {{"black", {{0, 1}, {1, 0}, {-1, 1}}}}}), HasSubstr("nothing to plot"));
  EXPECT_EQ(count(draw({"s", "error", {{"one", {{1, 1}, {0, 1}}}}}), "<circle"), 1U);
}

TEST(LogPlot, EscapesNames) { EXPECT_THAT(draw({"s", "e", {{"<b>", {{1, 1}}}}}), Not(HasSubstr("<b>"))); }

}  // namespace
}  // namespace radfarm::cli
