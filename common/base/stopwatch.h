#pragma once

namespace radfarm {

/// Seconds of wall clock and of CPU (all threads of this process) since construction.
class Stopwatch {
 public:
  Stopwatch() : wall_start_(wall_now()), cpu_start_(cpu_now()) {}
  double wall_seconds() const { return wall_now() - wall_start_; }
  double cpu_seconds() const { return cpu_now() - cpu_start_; }

 private:
  static double wall_now();
  static double cpu_now();
  double wall_start_;
  double cpu_start_;
};

/// CPU seconds of the calling thread alone: what a task cost when tasks run on several threads.
double thread_cpu_seconds();

/// The largest resident set this process has had, in bytes.
long long peak_memory_bytes();

}  // namespace radfarm
