#include "base/stopwatch.h"

#include <sys/resource.h>

#include <ctime>

namespace radfarm {
namespace {

double seconds(clockid_t clock) {
  timespec time{};
  clock_gettime(clock, &time);
  return static_cast<double>(time.tv_sec) + 1e-9 * static_cast<double>(time.tv_nsec);
}

}  // namespace

double Stopwatch::wall_now() { return seconds(CLOCK_MONOTONIC); }
double Stopwatch::cpu_now() { return seconds(CLOCK_PROCESS_CPUTIME_ID); }

double thread_cpu_seconds() { return seconds(CLOCK_THREAD_CPUTIME_ID); }

long long peak_memory_bytes() {
  rusage usage{};
  getrusage(RUSAGE_SELF, &usage);
  return 1024LL * usage.ru_maxrss;  // Linux counts in KiB
}

}  // namespace radfarm
