#include "coordinator/job.h"

#include <utility>

#include <gtest/gtest.h>

namespace radfarm {
namespace {

const Time kNow{};
const std::set<std::string> kLive = {"w"};

Job make_job() { return Job("job1", {"room", {}, "room.gltf", "{}"}, 0, {}, {0.02, 0}); }

PreparedJob prepared(std::vector<Task> tasks) { return {{"s", "", "v"}, std::move(tasks), {0, 512, 64, 1}, {}}; }

Job rendering_job(std::size_t tasks) {
  Job job = make_job();
  job.start_preparing();
  job.start_rendering(prepared(std::vector<Task>(tasks)));
  return job;
}

CommitHeader header_of(const Lease& lease, const std::string& digest) {
  return {"w", lease.job_id, lease.slot, lease.token, {digest, 1}, 0.5, 1000, lease.round.number};
}

TEST(Job, GoesFromQueuedToSucceeded) {
  Job job = make_job();
  EXPECT_EQ(job.state(), JobState::kQueued);
  EXPECT_FALSE(job.accepts("class"));
  job.start_preparing();
  job.start_rendering(prepared({{Task::Kind::kTile, 0}, {Task::Kind::kAudit, 0}}));
  for (const char* token : {"t1", "t2"}) {
    const std::optional<Lease> lease = job.lease("w", kLive, token, kNow);
    ASSERT_TRUE(lease);
    EXPECT_EQ(job.commit(header_of(*lease, token), "worker-1"), CommitOutcome::kCommitted);
  }
  ASSERT_TRUE(job.all_committed());
  job.start_assembling();
  EXPECT_EQ(job.results().size(), 2U);
  EXPECT_DOUBLE_EQ(job.light_cpu_seconds(), 0.5);
  EXPECT_DOUBLE_EQ(job.audit_cpu_seconds(), 0.5);
  EXPECT_EQ(job.worker_facts().at(0).tasks, 2);
  EXPECT_DOUBLE_EQ(job.worker_facts().at(0).cpu_seconds, 1.0);
  job.succeed({{"image.exr", {"d", 1}}}, false);
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
  job.start_rendering(prepared(std::vector<Task>(1)));
  EXPECT_FALSE(job.prepare_progress({"senders", 9, 9})) << "said too late";
  EXPECT_EQ(job.status().progress.phase, JobPhase());
}

TEST(Job, KeepsResultsInTaskOrderWhateverOrderTheyComeIn) {
  Job job = rendering_job(2);
  const Lease first = *job.lease("w", kLive, "t1", kNow);
  const Lease second = *job.lease("w", kLive, "t2", kNow);
  job.commit(header_of(second, "d2"), "w");
  job.commit(header_of(first, "d1"), "w");
  EXPECT_EQ(job.results()[0].digest, "d1");
  EXPECT_EQ(job.results()[1].digest, "d2");
}

TEST(Job, CancelEndsLeasesAtOnceWhileRendering) {
  Job job = rendering_job(1);
  const Lease lease = *job.lease("w", kLive, "t1", kNow);
  ASSERT_TRUE(job.cancel());
  EXPECT_EQ(job.state(), JobState::kCancelled);
  EXPECT_FALSE(job.renew("t1", kNow));
  EXPECT_EQ(job.commit(header_of(lease, "d"), "w"), CommitOutcome::kSuperseded);
  EXPECT_TRUE(job.cancel()) << "again is fine";
}

TEST(Job, CancelDoesNotWaitForTheAssembly) {
  Job job = rendering_job(1);
  const Lease lease = *job.lease("w", kLive, "t1", kNow);
  ASSERT_EQ(job.commit(header_of(lease, "d"), "w"), CommitOutcome::kCommitted);
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
  job.start_rendering(prepared(std::vector<Task>(1)));
  EXPECT_TRUE(raised());
  const Lease lease = *job.lease("w", kLive, "t1", kNow);
  EXPECT_TRUE(raised());
  job.commit(header_of(lease, "d"), "w");
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

/// A tile and an audit task, both committed in a round and assembled, with its leases.
struct OneRound {
  Job job;
  std::vector<Lease> leases;
};
void commit_all(OneRound& round, const std::string& mark) {
  for (int i = 0; i < 2; ++i) {
    const Lease lease = *round.job.lease("w", kLive, mark + std::to_string(i), kNow);
    round.leases.push_back(lease);
    EXPECT_EQ(round.job.commit(header_of(lease, mark + std::to_string(i)), "w"), CommitOutcome::kCommitted);
  }
  round.job.start_assembling();
  RoundFigures figures;
  figures.round = round.job.round();
  round.job.record(figures);
}
OneRound one_round() {
  OneRound round{make_job(), {}};
  round.job.start_preparing();
  round.job.set_worker_class("x");
  round.job.start_rendering(prepared({{Task::Kind::kTile, 0}, {Task::Kind::kAudit, 0}}));
  commit_all(round, "a");
  return round;
}
const std::vector<Task> kNextTasks = {{Task::Kind::kTile, 0}, {Task::Kind::kAudit, 0}, {Task::Kind::kAudit, 1}};

TEST(JobRounds, ASecondRoundGoesOnFromTheFirstsTilesButNotItsAudits) {
  OneRound first = one_round();
  EXPECT_EQ(first.job.status().progress.round, 1U);
  first.job.go_on({1, 1024, 64, 2}, kNextTasks);
  EXPECT_EQ(first.job.state(), JobState::kRendering);
  EXPECT_EQ(first.job.status().progress.round, 2U);
  const Lease tile = *first.job.lease("w", kLive, "b0", kNow), audit = *first.job.lease("w", kLive, "b1", kNow);
  EXPECT_EQ(tile.before, "a0");
  EXPECT_EQ(tile.round.scale, 2);
  EXPECT_EQ(audit.before, "");
}

TEST(JobRounds, NothingOfAnOldRoundChangesTheNext) {
  OneRound first = one_round();
  first.job.go_on({1, 1024, 64, 2}, kNextTasks);
  for (const Lease& old : first.leases) {
    EXPECT_FALSE(first.job.renew(old.token, kNow));
    EXPECT_EQ(first.job.commit(header_of(old, "other"), "w"), CommitOutcome::kSuperseded);
    EXPECT_EQ(first.job.commit(header_of(old, old.token), "w"), CommitOutcome::kSuperseded) << "not even the same bytes again";
  }
  const Lease fresh = *first.job.lease("w", kLive, "b0", kNow);
  EXPECT_EQ(first.job.commit(header_of(fresh, "new"), "w"), CommitOutcome::kCommitted);
  EXPECT_EQ(first.job.commit(header_of(first.leases[0], "other"), "w"), CommitOutcome::kSuperseded);
  EXPECT_EQ(first.job.status().progress.results_diverged, 0U) << "an old round's result is no other result of this one";
}

TEST(JobRounds, GoesOnOnWorkersOfTheSameClassAlone) {
  OneRound first = one_round();
  first.job.go_on({1, 1024, 64, 2}, kNextTasks);
  EXPECT_TRUE(first.job.accepts("x"));
  EXPECT_FALSE(first.job.accepts("y")) << "its sums are those of the first class";
}

TEST(JobRounds, NewLightIsPreparedAndStartsAnew) {
  OneRound first = one_round();
  first.job.prepare_anew({1, 1024, 64, 3}, {2.0F, false, 1});
  EXPECT_EQ(first.job.state(), JobState::kPreparing);
  EXPECT_EQ(first.job.status().progress.round, 2U);
  EXPECT_EQ(first.job.effort().level, 2.0F);
  PreparedJob again = prepared(kNextTasks);
  again.round = first.job.round();
  first.job.start_rendering(again);
  const Lease tile = *first.job.lease("w", kLive, "b0", kNow);
  EXPECT_EQ(tile.before, "");
  EXPECT_EQ(tile.round.number, 1U);
  EXPECT_EQ(first.job.round_kind(), RoundFigures::Kind::kNewLight);
}

TEST(JobRounds, MayBeCancelledInAnyOfThem) {
  OneRound first = one_round();
  first.job.go_on({1, 1024, 64, 2}, kNextTasks);
  ASSERT_TRUE(first.job.cancel());
  EXPECT_EQ(first.job.state(), JobState::kCancelled);
  OneRound anew = one_round();
  anew.job.prepare_anew({1, 1024, 64, 3}, {2.0F, false, 1});
  ASSERT_TRUE(anew.job.cancel());
  EXPECT_EQ(anew.job.state(), JobState::kCancelling);
}

TEST(JobRounds, AFinishedJobCanBeExtendedFromItsResults) {
  OneRound first = one_round();
  EXPECT_FALSE(first.job.extend({0.01, 0})) << "not finished";
  first.job.succeed({{"image.exr", {"d", 1}}}, false);
  EXPECT_FALSE(*first.job.extend({0.02, 0})) << "has that target already, and met it";
  ASSERT_TRUE(*first.job.extend({0.01, 0}));
  EXPECT_EQ(first.job.state(), JobState::kAssembling);
  EXPECT_EQ(first.job.rounds_left(), kMostRounds);
  EXPECT_FALSE(*first.job.extend({0.01, 0})) << "again is fine";
  EXPECT_EQ(first.job.extend({0.005, 0}).error().code, Code::kFailedPrecondition);
  EXPECT_EQ(first.job.results()[0].digest, "a0");
  RoundFigures again;
  again.round = first.job.round();
  first.job.record(again);
  EXPECT_EQ(first.job.rounds().size(), 1U) << "the same round, looked at again";
  first.job.go_on({1, 1024, 64, 2}, kNextTasks);
  EXPECT_EQ(first.job.lease("w", kLive, "b0", kNow)->before, "a0");
}

TEST(JobRounds, AMissedTargetShows) {
  OneRound first = one_round();
  first.job.succeed({}, true);
  EXPECT_TRUE(first.job.status().target_missed);
  EXPECT_EQ(first.job.status().state, JobState::kSucceeded);
}

}  // namespace
}  // namespace radfarm
