#include "base/progress.h"

#include <atomic>

#include "base/parallel.h"

namespace radfarm {

Status Progress::check() const {
  if (is_cancelled()) return fail(Code::kCancelled, "cancelled");
  return {};
}

void parallel_for(const Progress& progress, std::string_view phase, std::size_t count, std::size_t grain,
                  const std::function<void(std::size_t, std::size_t)>& body) {
  progress.report(phase, 0, count);
  std::atomic<std::size_t> done = 0;
  parallel_for(count, grain, [&](std::size_t begin, std::size_t end) {
    if (progress.is_cancelled()) return;
    body(begin, end);
    progress.report(phase, done += end - begin, count);
  });
}

}  // namespace radfarm
