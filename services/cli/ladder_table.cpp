#include "cli/ladder_table.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>

namespace radfarm::cli {

using nlohmann::json;

double stage_seconds(const json& report, const char* key) {
  double seconds = 0;
  const json stages = report.value("stages", json::array());
  for (const json& stage : stages) {
    if (stage.is_object() && stage.contains(key) && stage[key].is_number()) seconds += stage[key].get<double>();
  }
  return seconds;
}

void mark_best(std::vector<LadderRow>& rows) {
  for (LadderRow& row : rows) {
    row.is_best = std::none_of(rows.begin(), rows.end(), [&](const LadderRow& other) {
      const bool is_no_worse = other.cpu_s <= row.cpu_s && other.error.relative <= row.error.relative;
      return is_no_worse && (other.cpu_s < row.cpu_s || other.error.relative < row.error.relative);
    });
  }
}

const LadderRow* cheapest_for(const std::vector<LadderRow>& rows, double error) {
  const LadderRow* best = nullptr;
  for (const LadderRow& row : rows) {
    if (row.error.relative <= error && (best == nullptr || row.cpu_s < best->cpu_s)) best = &row;
  }
  return best;
}

double slope_of(const std::vector<LadderRow>& rows, const std::string& curve) {
  double n = 0, x = 0, y = 0, xx = 0, xy = 0;
  for (const LadderRow& row : rows) {
    if (row.curve != curve || !(row.cpu_s > 0) || !(row.error.relative > 0)) continue;
    const double a = std::log(row.cpu_s), b = std::log(row.error.relative);
    n += 1, x += a, y += b, xx += a * a, xy += a * b;
  }
  const double spread = n * xx - x * x;
  return n >= 2 && spread > 0 ? (n * xy - x * y) / spread : 0;
}

std::string to_csv(const std::vector<LadderRow>& rows) {
  std::string text = "name,integrator,cpu_s,wall_s,relative_rmse,relative_rmse_low,relative_rmse_high,ratio_of_means,flip,pareto\n";
  for (const LadderRow& r : rows) {
    std::array<char, 256> line{};
    std::snprintf(line.data(), line.size(), ",%.3f,%.3f,%.6g,%.6g,%.6g,%.6g,%.6g,%d\n", r.cpu_s, r.wall_s, r.error.relative,
                  r.error.relative_low, r.error.relative_high, r.error.ratio_of_means, r.flip, r.is_best ? 1 : 0);
    text += r.name + "," + r.curve + line.data();
  }
  return text;
}

nlohmann::ordered_json to_json(const std::vector<LadderRow>& rows) {
  nlohmann::ordered_json list = nlohmann::ordered_json::array();
  for (const LadderRow& r : rows) {
    list.push_back({{"name", r.name}, {"integrator", r.curve}, {"cpu_s", r.cpu_s}, {"wall_s", r.wall_s},
                    {"relative_rmse", r.error.relative}, {"relative_rmse_ci95", {r.error.relative_low, r.error.relative_high}},
                    {"ratio_of_means", r.error.ratio_of_means}, {"flip", r.flip}, {"pareto", r.is_best}, {"counts", r.counts}});
  }
  return list;
}

}  // namespace radfarm::cli
