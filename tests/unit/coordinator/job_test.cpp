#include "coordinator/job.h"

#include <utility>

#include <gtest/gtest.h>

namespace radfarm {
namespace {

const Time kNow{};
const std::set<std::string> kLive = {"w"};

Job make_job() { return Job("job1", {"room", {}, "room.gltf", "{}"}, 0, {}); }

Job rendering_job(std::size_t tasks) {
  Job job = make_job();
  job.start_preparing();
  job.start_rendering({"s", "", "v"}, std::vector<Task>(tasks));
  return job;
}

CommitHeader header_of(const Lease& lease, const std::string& digest) {
  return {"w", lease.job_id, lease.slot, lease.token, {digest, 1}, 0.5, 1000};
}

TEST(Job, GoesFromQueuedToSucceeded) {
  Job job = make_job();
  EXPECT_EQ(job.state(), JobState::kQueued);
  EXPECT_FALSE(job.accepts("class"));
  job.start_preparing();
  job.start_rendering({"s", "", "v"}, {{Task::Kind::kTile, 0}, {Task::Kind::kAudit, 0}});
  for (const char* token : {"t1", "t2"}) {
    const std::optional<Lease> lease = job.lease("w", kLive, token, kNow);
    ASSERT_TRUE(lease);
    EXPECT_EQ(job.commit(header_of(*lease, token), "worker-1", {std::byte{1}}), CommitOutcome::kCommitted);
  }
  ASSERT_TRUE(job.all_committed());
  job.start_assembling();
  EXPECT_EQ(job.take_results().size(), 2U);
  EXPECT_EQ(job.worker_facts().at(0).tasks, 2);
  EXPECT_DOUBLE_EQ(job.worker_facts().at(0).cpu_seconds, 1.0);
  job.succeed({{"image.exr", {"d", 1}}});
  EXPECT_EQ(job.status().state, JobState::kSucceeded);
  EXPECT_FALSE(job.cancel()) << "too late";
}

TEST(Job, TellsThePhaseOfItsPreparationAndOnlyOfThat) {
  Job job = make_job();
  EXPECT_FALSE(job.prepare_progress({"load", 0, 0}));
  job.start_preparing();
  const std::uint64_t before = job.status().revision;
  EXPECT_TRUE(job.prepare_progress({"senders", 3, 9}));
  EXPECT_GT(job.status().revision, before);
  EXPECT_EQ(job.status().progress.phase, (JobPhase{"senders", 3, 9}));
  job.start_rendering({"s", "", "v"}, std::vector<Task>(1));
  EXPECT_FALSE(job.prepare_progress({"senders", 9, 9})) << "said too late";
  EXPECT_EQ(job.status().progress.phase, JobPhase());
}

TEST(Job, KeepsResultsInTaskOrderWhateverOrderTheyComeIn) {
  Job job = rendering_job(2);
  const Lease first = *job.lease("w", kLive, "t1", kNow);
  const Lease second = *job.lease("w", kLive, "t2", kNow);
  job.commit(header_of(second, "d2"), "w", {std::byte{2}});
  job.commit(header_of(first, "d1"), "w", {std::byte{1}});
  const auto results = job.take_results();
  EXPECT_EQ(results[0], std::vector{std::byte{1}});
  EXPECT_EQ(results[1], std::vector{std::byte{2}});
}

TEST(Job, CancelEndsLeasesAtOnceWhileRendering) {
  Job job = rendering_job(1);
  const Lease lease = *job.lease("w", kLive, "t1", kNow);
  ASSERT_TRUE(job.cancel());
  EXPECT_EQ(job.state(), JobState::kCancelled);
  EXPECT_FALSE(job.renew("t1", kNow));
  EXPECT_EQ(job.commit(header_of(lease, "d"), "w", {}), CommitOutcome::kSuperseded);
  EXPECT_TRUE(job.cancel()) << "again is fine";
}

TEST(Job, CancelDoesNotWaitForTheAssembly) {
  Job job = rendering_job(1);
  const Lease lease = *job.lease("w", kLive, "t1", kNow);
  ASSERT_EQ(job.commit(header_of(lease, "d"), "w", {}), CommitOutcome::kCommitted);
  job.start_assembling();
  ASSERT_TRUE(job.cancel());
  EXPECT_EQ(job.state(), JobState::kCancelled);
}

TEST(Job, CancelWaitsUntilThePreparationHasStopped) {
  Job job = make_job();
  job.start_preparing();
  ASSERT_TRUE(job.cancel());
  EXPECT_EQ(job.state(), JobState::kCancelling);
  job.confirm_cancel();
  EXPECT_EQ(job.state(), JobState::kCancelled);
}

TEST(Job, EveryChangeRaisesTheRevision) {
  Job job = make_job();
  std::uint64_t last = job.status().revision;
  const auto raised = [&] { return std::exchange(last, job.status().revision) < last; };
  job.start_preparing();
  EXPECT_TRUE(raised());
  job.start_rendering({"s", "", "v"}, std::vector<Task>(1));
  EXPECT_TRUE(raised());
  const Lease lease = *job.lease("w", kLive, "t1", kNow);
  EXPECT_TRUE(raised());
  job.commit(header_of(lease, "d"), "w", {});
  EXPECT_TRUE(raised());
}

TEST(Job, OneClassOfWorkersRunsAJob) {
  Job job = rendering_job(2);
  EXPECT_TRUE(job.accepts("x"));
  job.lease("w", kLive, "t1", kNow);
  job.set_worker_class("x");
  EXPECT_TRUE(job.accepts("x"));
  EXPECT_FALSE(job.accepts("y"));
  job.release("w");
  EXPECT_TRUE(job.accepts("y")) << "nothing is leased or committed: any class may start over";
}

}  // namespace
}  // namespace radfarm
