#include "cli/ladder_page.h"

#include <algorithm>
#include <cmath>

#include "cli/format.h"
#include "cli/html.h"
#include "cli/log_plot.h"

namespace radfarm::cli {
namespace {

std::string percent(double share) { return format("%.3g %%", 100 * share); }

std::vector<std::string> curves_of(const std::vector<LadderRow>& rows) {
  std::vector<std::string> names;
  for (const LadderRow& row : rows) {
    if (std::find(names.begin(), names.end(), row.curve) == names.end()) names.push_back(row.curve);
  }
  return names;
}

std::string plot(const LadderPage& page) {
  LogPlot plot{"CPU seconds", "relative error, %", {}};
  for (const std::string& name : curves_of(page.rows)) {
    PlotCurve curve{name, {}};
    for (const LadderRow& r : page.rows) {
      if (r.curve != name) continue;
      curve.points.push_back({r.cpu_s, 100 * r.error.relative, 100 * r.error.relative_low, 100 * r.error.relative_high,
                              r.name + ": " + percent(r.error.relative) + format(" in %.3g CPU s", r.cpu_s)});
    }
    std::sort(curve.points.begin(), curve.points.end(), [](const PlotPoint& a, const PlotPoint& b) { return a.x < b.x; });
    plot.curves.push_back(std::move(curve));
  }
  PlotCurve front{"cheapest", {}, true};
  for (const LadderRow& r : page.rows) {
    if (r.is_best) front.points.push_back({r.cpu_s, 100 * r.error.relative, 0, 0, r.name});
  }
  std::sort(front.points.begin(), front.points.end(), [](const PlotPoint& a, const PlotPoint& b) { return a.x < b.x; });
  plot.curves.push_back(std::move(front));
  return draw(plot);
}

std::string cheapest(const LadderPage& page) {
  std::vector<std::vector<std::string>> rows;
  for (const double error : {0.2, 0.1, 0.05, 0.02, 0.01}) {
    const LadderRow* row = cheapest_for(page.rows, error);
    if (row == nullptr) {
      rows.push_back({percent(error), "none of these", "", ""});
    } else {
      rows.push_back({percent(error), escaped(row->name), format("%.3g", row->cpu_s), format("%.3g", row->wall_s)});
    }
  }
  return "<h2>The cheapest setting for an error</h2>\n" + html_table({"error at most", "setting", "CPU s", "s on this machine"}, rows);
}

std::string steps(const LadderPage& page) {
  std::vector<std::vector<std::string>> rows;
  for (const std::string& name : curves_of(page.rows)) {
    const double slope = slope_of(page.rows, name);
    if (!(slope < 0)) continue;
    rows.push_back({escaped(name), format("%.2f", slope), format("%.3g", std::pow(2.0, -1 / slope))});
  }
  if (rows.empty()) return "";
  return "<h2>What the next step costs</h2>\n<p class=\"note\">Error falls as CPU seconds to the power of the slope (−0.5 is pure noise): "
         "half the error takes so many times the time.</p>\n" + html_table({"integrator", "slope", "half the error: time ×"}, rows);
}

std::string all_rows(const LadderPage& page) {
  std::vector<std::vector<std::string>> rows;
  for (const LadderRow& r : page.rows) {
    const std::string interval = percent(r.error.relative_low) + " to " + percent(r.error.relative_high);
    rows.push_back({escaped(r.name) + (r.is_best ? " ★" : ""), format("%.3g", r.cpu_s), format("%.3g", r.wall_s),
                    percent(r.error.relative), interval, format("%.4f", r.error.ratio_of_means), format("%.4f", r.flip)});
  }
  return "<h2>All settings</h2>\n<p class=\"note\">★: nothing cheaper has less error. FLIP at 67 pixels a degree, of the tone-mapped images.</p>\n" +
         html_table({"setting", "CPU s", "s", "relative error", "95 %", "ratio of means", "FLIP"}, rows);
}

std::string figure(const std::vector<std::byte>& png, const std::string& caption) {
  return "<figure>" + png_image(png, caption) + "<figcaption>" + escaped(caption) + "</figcaption></figure>\n";
}

std::string pictures(const LadderPage& page) {
  std::string text = "<h2>Images</h2>\n<p class=\"note\">Beside each image by how much of the reference's luminance it is off: violet 0, yellow " +
                     percent(page.most_difference) + " or more.</p>\n" + figure(page.reference, "reference");
  for (std::size_t i = 0; i < page.rows.size() && i < page.pictures.size(); ++i) {
    text += "<div>" + figure(page.pictures[i].image, page.rows[i].name + format(", %.3g CPU s", page.rows[i].cpu_s)) +
            figure(page.pictures[i].difference, percent(page.rows[i].error.relative)) + "</div>\n";
  }
  return text;
}

}  // namespace

std::string ladder_page(const LadderPage& page) {
  std::string body = "<h1>What accuracy costs: " + escaped(page.title) + "</h1>\n" + plot(page);
  body += "<p class=\"note\">Relative RMSE of reflected luminance against two independent path-traced halves, whose own noise (" +
          percent(page.reference_relative) + " of the two together) cancels; bars are 95 % intervals.</p>\n";
  body += cheapest(page) + steps(page) + all_rows(page) + pictures(page);
  body += "<p class=\"note\"><code>" + escaped(page.command) + "</code></p>\n";
  return html_page("ladder: " + page.title, body);
}

}  // namespace radfarm::cli
