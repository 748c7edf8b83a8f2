// Processes that die, stop and are told to end while they work. Every test proves that its fault took effect.
#include <csignal>
#include <functional>
#include <string>

#include "integration/farm.h"

namespace radfarm::test {
namespace {

using Exit = ChildProcess::Exit;

class FailuresTest : public FarmTest {
 protected:
  std::string digest_without_faults() {
    const ChildProcess worker = start_worker("undisturbed");
    return image_digest_of(wait_for_end(submit(small_request())));
  }
  bool is_working(const std::string& id) {
    const JobStatus job = status(id);
    return job.state == JobState::kRendering && job.progress.tasks_leased > 0;
  }
  /// Strikes the only worker until it held a lease at that moment, which its expiry proves: a strike may fall just
  /// after the last commit of what it held.
  bool until_a_lease_expires(const std::string& id, const std::function<void()>& strike) {
    for (int i = 0; i < 20 && status(id).state != JobState::kSucceeded; ++i) {
      strike();
      if (HasFatalFailure() || !eventually([&] { return !is_working(id); })) return false;
      if (status(id).progress.attempts_expired > 0) return status(id).state == JobState::kRendering;
    }
    return false;
  }
};

TEST_F(FailuresTest, AWorkerKilledInMidTaskChangesNothing) {
  const std::string expected = digest_without_faults();
  const std::string id = submit(small_request());
  ASSERT_TRUE(until_a_lease_expires(id, [&] {
    ChildProcess victim = start_worker("victim");
    ASSERT_TRUE(eventually([&] { return is_working(id); }));
    victim.signal(SIGKILL);
    ASSERT_EQ(victim.wait(kPatience), (Exit{true, SIGKILL}));
  }));
  const ChildProcess heir = start_worker("heir");
  const JobStatus job = wait_for_end(id);
  EXPECT_EQ(job.state, JobState::kSucceeded);
  EXPECT_EQ(job.progress.results_diverged, 0U);
  EXPECT_EQ(image_digest_of(job), expected);
}

TEST_F(FailuresTest, AFrozenWorkerThatComesBackChangesNothing) {
  const std::string expected = digest_without_faults();
  const std::string id = submit(small_request());
  const ChildProcess sleeper = start_worker("sleeper");
  ASSERT_TRUE(until_a_lease_expires(id, [&] {
    sleeper.signal(SIGCONT);
    ASSERT_TRUE(eventually([&] { return is_working(id); }));
    sleeper.signal(SIGSTOP);
  }));
  sleeper.signal(SIGCONT);
  const ChildProcess other = start_worker("other");
  const JobStatus job = wait_for_end(id);
  EXPECT_EQ(job.state, JobState::kSucceeded);
  EXPECT_EQ(image_digest_of(job), expected);
}

TEST_F(FailuresTest, AWorkerToldToEndHandsItsTasksBack) {
  const std::string id = submit(small_request());
  ChildProcess leaver = start_worker("leaver");
  ASSERT_TRUE(eventually([&] { return is_working(id); }));
  leaver.signal(SIGTERM);
  EXPECT_EQ(leaver.wait(kPatience), (Exit{false, 0}));
  const JobStatus left = status(id);
  EXPECT_EQ(left.progress.tasks_leased, 0U);
  ASSERT_EQ(left.state, JobState::kRendering) << "it left in the middle";
  const ChildProcess other = start_worker("other");
  const JobStatus job = wait_for_end(id);
  EXPECT_EQ(job.state, JobState::kSucceeded);
  EXPECT_EQ(job.progress.attempts_expired, 0U);
}

TEST_F(FailuresTest, ACoordinatorToldToEndEndsCleanlyAndItsWorkersFollow) {
  RenderRequest request = small_request();
  request.samples = 4096;
  const std::string id = submit(request);
  ChildProcess worker = start_worker("worker");
  ASSERT_TRUE(eventually([&] { return is_working(id); }));
  coordinator_->signal(SIGTERM);
  EXPECT_EQ(coordinator_->wait(kPatience), (Exit{false, 0}));
  EXPECT_EQ(worker.wait(kPatience), (Exit{false, 8})) << "it found nobody for longer than its patience";
  EXPECT_TRUE(processes_with((folder_.path() / "data").string()).empty());
}

TEST_F(FailuresTest, TwoCoordinatorsDoNotShareADataFolder) {
  ChildProcess second = std::move(*ChildProcess::start(program("radfarm-coordinator"),
                                                       {"serve", "--listen", "127.0.0.1:0", "--worker-listen",
                                                        "127.0.0.1:0", "--data", (folder_.path() / "data").string()},
                                                       ChildProcess::Stdout::kToStderr));
  EXPECT_EQ(second.wait(kPatience), (Exit{false, 3}));
}

}  // namespace
}  // namespace radfarm::test
