#include "cli/log_plot.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

#include "cli/format.h"
#include "cli/html.h"

namespace radfarm::cli {
namespace {

constexpr double kWidth = 760, kHeight = 430, kLeft = 72, kRight = 190, kTop = 16, kBottom = 52;
// Okabe and Ito's colours: told apart by the colour blind.
constexpr std::array kColors = {"#0072b2", "#d55e00", "#009e73", "#cc79a7", "#e69f00", "#56b4e9", "#000000", "#8c6d31"};

bool is_shown(const PlotPoint& p) { return p.x > 0 && p.y > 0 && std::isfinite(p.x) && std::isfinite(p.y); }
bool has_interval(const PlotPoint& p) { return p.low > 0 && p.high > p.low; }

/// One axis: from its logarithms to the page.
struct Axis {
  double low = std::numeric_limits<double>::infinity(), high = -std::numeric_limits<double>::infinity();
  double from = 0, to = 0;  // on the page

  void include(double value) { low = std::min(low, std::log10(value)), high = std::max(high, std::log10(value)); }
  /// A tenth of a decade of room, and half a decade at least.
  void widen() {
    const double middle = (low + high) / 2, half = std::max((high - low) / 2 + 0.1, 0.25);
    low = middle - half, high = middle + half;
  }
  double at(double value) const { return from + (std::log10(value) - low) / (high - low) * (to - from); }
  /// 1, 2, 5 of each decade within.
  std::vector<double> ticks() const {
    std::vector<double> values;
    for (int decade = static_cast<int>(std::floor(low)); decade <= static_cast<int>(std::ceil(high)); ++decade) {
      for (const double digit : {1.0, 2.0, 5.0}) {
        const double value = digit * std::pow(10.0, decade);
        if (std::log10(value) >= low && std::log10(value) <= high) values.push_back(value);
      }
    }
    return values;
  }
};

std::string line(double x0, double y0, double x1, double y1, const char* style) {
  return format("<line x1=\"%.1f\" y1=\"%.1f\" x2=\"%.1f\" y2=\"%.1f\" ", x0, y0, x1, y1) + style + "/>";
}

std::string text_at(double x, double y, const char* anchor, const std::string& text, const char* more = "") {
  return format("<text x=\"%.1f\" y=\"%.1f\" text-anchor=\"%s\" %s>", x, y, anchor, more) + escaped(text) + "</text>";
}

std::string frame(const LogPlot& plot, const Axis& x, const Axis& y) {
  std::string svg;
  for (const double tick : x.ticks()) {
    svg += line(x.at(tick), kTop, x.at(tick), kHeight - kBottom, "stroke=\"#e6e9ec\"");
    svg += text_at(x.at(tick), kHeight - kBottom + 18, "middle", format("%g", tick));
  }
  for (const double tick : y.ticks()) {
    svg += line(kLeft, y.at(tick), kWidth - kRight, y.at(tick), "stroke=\"#e6e9ec\"");
    svg += text_at(kLeft - 8, y.at(tick) + 4, "end", format("%g", tick));
  }
  svg += text_at((kLeft + kWidth - kRight) / 2, kHeight - 10, "middle", plot.x_title);
  const double middle = (kTop + kHeight - kBottom) / 2;
  return svg + text_at(16, middle, "middle", plot.y_title, format("transform=\"rotate(-90 16 %.1f)\"", middle).c_str());
}

std::string curve_on(const PlotCurve& curve, const std::string& color, const Axis& x, const Axis& y) {
  std::string path, marks;
  for (const PlotPoint& p : curve.points) {
    if (!is_shown(p)) continue;
    path += format("%s%.1f,%.1f ", path.empty() ? "" : "L", x.at(p.x), y.at(p.y));
    if (has_interval(p)) {
      marks += line(x.at(p.x), y.at(p.low), x.at(p.x), y.at(p.high), ("stroke=\"" + color + "\" stroke-opacity=\".5\"").c_str());
    }
    marks += format("<circle cx=\"%.1f\" cy=\"%.1f\" r=\"4\" fill=\"", x.at(p.x), y.at(p.y)) + color + "\"><title>" +
             escaped(p.label) + "</title></circle>";
  }
  if (path.empty() || !curve.has_line) return marks;
  return "<path d=\"M" + path + "\" fill=\"none\" stroke=\"" + color + "\" stroke-width=\"1.6\"" +
         (curve.is_dashed ? " stroke-dasharray=\"5 4\"" : "") + "/>" + marks;
}

}  // namespace

std::string draw(const LogPlot& plot) {
  Axis x, y;
  bool has_points = false;
  for (const PlotCurve& curve : plot.curves) {
    for (const PlotPoint& p : curve.points) {
      if (!is_shown(p)) continue;
      has_points = true;
      x.include(p.x), y.include(p.y);
      if (has_interval(p)) y.include(p.low), y.include(p.high);
    }
  }
  if (!has_points) return "<p class=\"note\">nothing to plot</p>\n";
  x.widen(), y.widen();
  x.from = kLeft, x.to = kWidth - kRight, y.from = kHeight - kBottom, y.to = kTop;
  std::string svg = format("<svg viewBox=\"0 0 %g %g\" width=\"%g\" height=\"%g\" role=\"img\" font-family=\"system-ui, sans-serif\" "
                           "font-size=\"12\" fill=\"#24292f\">", kWidth, kHeight, kWidth, kHeight);
  svg += frame(plot, x, y);
  for (std::size_t i = 0; i < plot.curves.size(); ++i) {
    const std::string color = kColors[i % kColors.size()];
    svg += curve_on(plot.curves[i], color, x, y);
    const double at = kTop + 14 + 18 * static_cast<double>(i);
    svg += line(kWidth - kRight + 14, at - 4, kWidth - kRight + 34, at - 4, ("stroke=\"" + color + "\" stroke-width=\"3\"").c_str());
    svg += text_at(kWidth - kRight + 40, at, "start", plot.curves[i].name);
  }
  return svg + "</svg>\n";
}

}  // namespace radfarm::cli
