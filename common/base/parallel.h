#pragma once

#include <cstddef>
#include <functional>

namespace radfarm {

/// Bounds the threads that parallel_for of this process uses while it lives. One per process, in main.
class ThreadLimit {
 public:
  explicit ThreadLimit(int threads);
  ~ThreadLimit();
  ThreadLimit(const ThreadLimit&) = delete;
  ThreadLimit& operator=(const ThreadLimit&) = delete;

 private:
  void* control_;
};

/// Calls body(begin, end) over disjoint pieces of [0, count), each at most `grain` long and cut at multiples of `grain`,
/// on all threads. The pieces do not depend on the number of threads, so a result kept per piece does not either.
void parallel_for(std::size_t count, std::size_t grain, const std::function<void(std::size_t, std::size_t)>& body);

}  // namespace radfarm
