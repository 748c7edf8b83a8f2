#pragma once

#include <algorithm>

#include <nlohmann/json.hpp>

#include "base/stopwatch.h"

namespace radfarm {

/// Times stages for the report; one that comes again adds to what it took before.
class StageClock {
 public:
  void end_stage(const char* name) {
    add(stages_, name, watch_);
    watch_ = Stopwatch();
  }
  const nlohmann::json& stages() const { return stages_; }

  static void add(nlohmann::json& stages, const char* name, const Stopwatch& watch) {
    auto row = std::find_if(stages.begin(), stages.end(), [&](const auto& stage) { return stage["name"] == name; });
    if (row == stages.end()) {
      stages.push_back({{"name", name}, {"wall_s", 0.0}, {"cpu_s", 0.0}});
      row = stages.end() - 1;
    }
    (*row)["wall_s"] = row->at("wall_s").get<double>() + watch.wall_seconds();
    (*row)["cpu_s"] = row->at("cpu_s").get<double>() + watch.cpu_seconds();
  }

 private:
  Stopwatch watch_;
  nlohmann::json stages_ = nlohmann::json::array();
};

}  // namespace radfarm
