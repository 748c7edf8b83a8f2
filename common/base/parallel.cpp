#include "base/parallel.h"

#include <algorithm>

#include <tbb/global_control.h>
#include <tbb/parallel_for.h>
#include <tbb/task_arena.h>

#include "base/check.h"

namespace radfarm {

ThreadLimit::ThreadLimit(int threads)
    : control_(new tbb::global_control(tbb::global_control::max_allowed_parallelism,
                                       static_cast<std::size_t>(std::max(threads, 1)))) {}

ThreadLimit::~ThreadLimit() { delete static_cast<tbb::global_control*>(control_); }

void parallel_for(std::size_t count, std::size_t grain, const std::function<void(std::size_t, std::size_t)>& body) {
  RADFARM_CHECK(grain > 0);
  const std::size_t pieces = (count + grain - 1) / grain;
  // A thread that waits here takes up no other work: that might wait for what this thread is making (std::call_once).
  tbb::this_task_arena::isolate([&] {
    tbb::parallel_for(std::size_t{0}, pieces, [&](std::size_t piece) {
      body(piece * grain, std::min(count, (piece + 1) * grain));
    });
  });
}

}  // namespace radfarm
