// The radiosity solver against closed forms: error against threshold, with links alone and with light paths.
//
//   closed_forms_table [SEEDS [--json]]
//
// Prints the tables of docs/radiosity-closed-forms.md, or one JSON object a run. The scenes are made by
// tests/support/closed_scenes.cpp; there is nothing else to be read.

#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <string>
#include <vector>

#include <nlohmann/json.hpp>

#include "base/stopwatch.h"
#include "math/statistics.h"
#include "support/closed_scenes.h"

namespace radfarm {
namespace {

using test::ClosedForm;

constexpr float kThresholds[] = {1e-2F, 1e-3F, 1e-4F, 1e-5F};
constexpr double kTooSlow = 0.3;  // CPU seconds a run: finer thresholds are left out

std::vector<ClosedForm> all_forms() {
  using test::Furnace;
  using test::Sent;
  std::vector<ClosedForm> forms;
  for (const Sent sent : {Sent::kEmitted, Sent::kReflected}) {
    forms.push_back(test::parallel_plates(1, 1, 1, sent));
    forms.push_back(test::parallel_plates(1, 1.5, 0.5, sent));
    for (const double gap : {0.1, 0.01, 10.0, 100.0}) forms.push_back(test::parallel_plates(1, 1, gap, sent));
    forms.push_back(test::corner(1, 1, 1, sent));
    forms.push_back(test::corner(0.1, 1, 1, sent));
    forms.push_back(test::corner(1, 1, 10, sent));
    forms.push_back(test::corner(1, 1, 0.1, sent));
    forms.push_back(test::discs(1, 1, 1, sent));
    forms.push_back(test::discs(1, 2, 1, sent));
    forms.push_back(test::discs(1, 1, 0.1, sent));
  }
  for (const Furnace shape : {Furnace::kBox, Furnace::kSphere, Furnace::kCluttered}) {
    for (const float rho : {0.5F, 0.9F, 0.99F, 0.999F}) forms.push_back(test::furnace(shape, rho));
  }
  for (const float rho : {0.5F, 0.9F}) forms.push_back(test::integrating_sphere(rho));
  for (const float rho : {0.5F, 0.8F}) forms.push_back(test::dome_over_disc(rho));
  for (const float rho : {0.5F, 0.9F}) forms.push_back(test::concentric_spheres(rho));
  forms.push_back(test::wide_plates(0.5F));
  forms.push_back(test::coloured_box());
  return forms;
}

/// Runs of one scene at one threshold.
struct Cell {
  RunningStatistics error, unevenness, closure, seconds;
  std::size_t links = 0;
};

Cell measure(const ClosedForm& form, const World& world, float threshold, std::uint32_t hits, std::uint64_t seeds, bool as_json) {
  RadiositySettings settings;
  settings.max_link_error = threshold;
  settings.hits_per_patch = hits;
  Cell cell;
  for (std::uint64_t seed = 1; seed <= seeds; ++seed) {
    const Stopwatch watch;
    const RadiositySolution solution = solve_radiosity(world, settings, seed);
    cell.seconds.add(watch.cpu_seconds());
    cell.error.add(form.answer(world, solution) / form.truth - 1);
    cell.closure.add(solution.energy.closure_error);
    if (form.unevenness) cell.unevenness.add(form.unevenness(world, solution));
    cell.links = solution.links;
    if (!as_json) continue;
    const nlohmann::json run = {{"form", form.form}, {"case", form.name}, {"threshold", threshold}, {"hits_per_patch", hits},
                                {"seed", seed}, {"closed_form", form.closed_form}, {"truth", form.truth},
                                {"truth_error", form.truth_error}, {"answer", form.answer(world, solution)},
                                {"links", solution.links}, {"iterations", solution.iterations},
                                {"closure_error", solution.energy.closure_error}, {"cpu_s", watch.cpu_seconds()}};
    std::printf("%s\n", run.dump().c_str());
  }
  return cell;
}

std::string cell_text(const Cell& cell) {
  char text[96];
  std::snprintf(text, sizeof text, "%+.2f ± %.2f", 100 * cell.error.mean(), 100 * cell.error.standard_deviation());
  std::string result = text;
  if (cell.unevenness.count() > 0) {
    std::snprintf(text, sizeof text, " (%.1f)", 100 * cell.unevenness.mean());
    result += text;
  }
  return result;
}

void print_row(const ClosedForm& form, const World& world, std::uint32_t hits, std::uint64_t seeds, bool as_json) {
  std::string row = "| " + form.form + " " + form.name + " | " + (hits == 0 ? "links" : "paths");
  char text[96];
  std::snprintf(text, sizeof text, " | %.6g | %+.2f ", form.truth, 100 * (form.closed_form / form.truth - 1));
  row += text;
  Cell cell;
  for (const float threshold : kThresholds) {
    if (cell.seconds.count() > 0 && cell.seconds.mean() > kTooSlow) {
      row += "| - ";
      continue;
    }
    cell = measure(form, world, threshold, hits, seeds, as_json);
    row += "| " + cell_text(cell) + " ";
  }
  std::snprintf(text, sizeof text, "| %+.1f | %zu | %.2f |", 100 * cell.closure.mean(), cell.links, cell.seconds.mean());
  if (!as_json) std::printf("%s%s\n", row.c_str(), text);
  std::fflush(stdout);
}

}  // namespace
}  // namespace radfarm

int main(int argc, char** argv) {
  const std::uint64_t seeds = argc > 1 ? std::strtoull(argv[1], nullptr, 10) : 8;
  const bool as_json = argc > 2 && std::strcmp(argv[2], "--json") == 0;
  if (!as_json) {
    std::printf("| case | | truth | ideal shape, %% | 1e-2 | 1e-3 | 1e-4 | 1e-5 | raw closure, %% | links | CPU s |\n");
    std::printf("|---|---|---|---|---|---|---|---|---|---|---|\n");
  }
  for (radfarm::test::ClosedForm& form : radfarm::all_forms()) {
    const radfarm::World world(std::move(form.scene));
    for (const std::uint32_t hits : {0U, radfarm::RadiositySettings().hits_per_patch}) {
      radfarm::print_row(form, world, hits, seeds, as_json);
    }
  }
  return 0;
}
