#pragma once

#include <nlohmann/json.hpp>

#include "pipeline/pipeline.h"

namespace radfarm {

/// Adds to a report what only a job's rounds tell: `rounds`, `next_halving`, the target and whether it was met, the audit's
/// share of the CPU time, and the round in the resolved settings. Requires: `job.rounds` has at least one.
void add_rounds(const JobFacts& job, nlohmann::json& report);

}  // namespace radfarm
