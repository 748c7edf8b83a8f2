#include "base/stopwatch.h"

#include <gtest/gtest.h>

namespace radfarm {
namespace {

TEST(Stopwatch, TimesDoNotRunBackwards) {
  const Stopwatch watch;
  const double thread_start = thread_cpu_seconds();
  double sum = 0;
  for (int i = 1; i < 100'000; ++i) sum += 1.0 / i;
  EXPECT_GT(sum, 0);
  EXPECT_GE(watch.wall_seconds(), 0);
  EXPECT_GT(watch.cpu_seconds(), 0);
  EXPECT_GT(thread_cpu_seconds(), thread_start);
}

TEST(Stopwatch, ThisProcessUsesMemory) { EXPECT_GT(peak_memory_bytes(), 100'000); }

}  // namespace
}  // namespace radfarm
