#pragma once

#include <string>
#include <vector>

namespace radfarm::cli {

/// A point of a curve, its y with an interval where low < high. All above 0.
struct PlotPoint {
  double x = 0, y = 0;
  double low = 0, high = 0;
  std::string label = {};  // shown when pointed at
};

struct PlotCurve {
  std::string name;
  std::vector<PlotPoint> points;
  bool is_dashed = false;
  bool has_line = true;
};

struct LogPlot {
  std::string x_title, y_title;
  std::vector<PlotCurve> curves;
};

/// Both axes logarithmic, as an <svg> to stand in a page. Points that are not above 0 are left out; without any, a note.
std::string draw(const LogPlot& plot);

}  // namespace radfarm::cli
