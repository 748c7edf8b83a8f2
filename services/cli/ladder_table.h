#pragma once

#include <string>
#include <vector>

#include <nlohmann/json.hpp>

#include "image/reference_error.h"

namespace radfarm::cli {

/// One measured setting.
struct LadderRow {
  std::string name, curve;
  double cpu_s = 0;   // preparing, rendering, finishing; no audit
  double wall_s = 0;  // on this machine
  ReferenceError error;
  double flip = 0;    // mean, against the mean of the halves
  nlohmann::json counts;
  bool is_best = false;  // nothing cheaper has less error
};

/// Seconds of all stages of a report.
double stage_seconds(const nlohmann::json& report, const char* key);

/// Marks the rows of which none is cheaper, in CPU seconds, and better: the Pareto front.
void mark_best(std::vector<LadderRow>& rows);

/// The cheapest row whose error is at most `error`; null: none.
const LadderRow* cheapest_for(const std::vector<LadderRow>& rows, double error);

/// d ln(error) / d ln(CPU seconds) of a curve by least squares: -0.5 for pure noise. 0 with fewer than two rows.
double slope_of(const std::vector<LadderRow>& rows, const std::string& curve);

std::string to_csv(const std::vector<LadderRow>& rows);
nlohmann::ordered_json to_json(const std::vector<LadderRow>& rows);

}  // namespace radfarm::cli
