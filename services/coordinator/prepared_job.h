#pragma once

#include <vector>

#include "frame/round.h"
#include "frame/task.h"
#include "rpc/messages.h"

namespace radfarm {

/// What a preparation leaves for a job.
struct PreparedJob {
  TaskInputs inputs;
  std::vector<Task> tasks;
  Round round;
  std::vector<CostEstimate> estimates;
};

}  // namespace radfarm
