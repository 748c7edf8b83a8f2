#pragma once

#include <optional>
#include <string>
#include <vector>

#include <nlohmann/json_fwd.hpp>

#include "estimate/settings.h"
#include "frame/assemble.h"
#include "frame/audit.h"

namespace radfarm {

/// What the farm measured while the tasks ran; goes into the report as it is.
struct FarmFacts {
  struct Worker {
    std::string name;
    int tasks = 0;
    double cpu_seconds = 0;
    long long peak_memory_bytes = 0;
  };
  std::vector<Worker> workers;
  double tasks_wall_seconds = 0;
};

/// The report of DESIGN section 9: `facts` (what prepare() knew) completed with what the tasks and the audit found.
nlohmann::json make_report(nlohmann::json facts, const Settings& settings, const Raster& raster,
                           const Counters& counters, const std::optional<Accuracy>& accuracy,
                           const std::string& image_digest, const FarmFacts& farm);

/// The resolved settings as the report and the image's header show them.
nlohmann::json to_json(const Settings& settings);

}  // namespace radfarm
