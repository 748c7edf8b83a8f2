#include "cli/progress.h"

#include <gtest/gtest.h>

namespace radfarm::cli {
namespace {

TEST(ProgressLine, ShowsStateBarAndTime) {
  JobStatus job;
  job.state = JobState::kPreparing;
  EXPECT_EQ(progress_line(job, 1.25), "preparing  1.2 s");
  job.progress.phase = {"load", 0, 0};
  EXPECT_EQ(progress_line(job, 1.25), "preparing  load  1.2 s");
  job.progress.phase = {"radiosity: links", 512, 20480};
  EXPECT_EQ(progress_line(job, 1.25), "preparing  radiosity: links 512/20480  1.2 s");
  job.progress.phase = {"radiosity: solving", 17, 0};
  EXPECT_EQ(progress_line(job, 1.25), "preparing  radiosity: solving 17  1.2 s");
  job.progress.phase = {std::string(100, 'x'), ~0ULL, ~0ULL};
  EXPECT_LE(progress_line(job, 1e6).size(), 79U);
  job.progress.phase = {};
  job.state = JobState::kRendering;
  job.progress.tasks_total = 30;
  job.progress.tasks_committed = 15;
  EXPECT_EQ(progress_line(job, 3), "rendering  [###############---------------] 15/30 tasks  3.0 s");
  job.progress.tasks_total = job.progress.tasks_committed = 4000000000U;
  EXPECT_LE(progress_line(job, 1e6).size(), 79U);
}

}  // namespace
}  // namespace radfarm::cli
