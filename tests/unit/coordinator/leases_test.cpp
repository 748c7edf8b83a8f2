#include "coordinator/leases.h"

#include <gtest/gtest.h>

namespace radfarm {
namespace {

using namespace std::chrono_literals;
using Grant = Leases::Grant;

const Time kStart{};
const LeasePolicy kPolicy{30000ms, 3, 4};
const std::set<std::string> kBoth = {"a", "b"};
std::string token(char kind, int number) {
  std::string text(1, kind);
  return text += std::to_string(number);
}

const Error kError{Code::kInternal, "sums are not finite"};

TEST(Leases, GivesTheLowestWaitingTaskOnce) {
  Leases leases(2, kPolicy);
  EXPECT_EQ(leases.lease("a", kBoth, "t1", kStart), (Grant{0, 1}));
  EXPECT_EQ(leases.lease("b", kBoth, "t2", kStart), (Grant{1, 1}));
  EXPECT_EQ(leases.lease("a", kBoth, "t3", kStart), std::nullopt);
  EXPECT_EQ(leases.commit(0, "t1", "d0"), CommitOutcome::kCommitted);
  EXPECT_EQ(leases.commit(1, "t2", "d1"), CommitOutcome::kCommitted);
  EXPECT_TRUE(leases.finished());
}

TEST(Leases, TaskOfADeadWorkerGoesToTheNextOne) {
  Leases leases(1, kPolicy);
  leases.lease("a", kBoth, "t1", kStart);
  leases.expire(kStart + 29999ms);
  EXPECT_EQ(leases.lease("b", kBoth, "t2", kStart + 29999ms), std::nullopt);
  EXPECT_EQ(leases.next_expiry(), kStart + 30s);
  leases.expire(kStart + 30s);
  EXPECT_EQ(leases.lease("b", kBoth, "t2", kStart + 30s), (Grant{0, 2}));
  EXPECT_EQ(leases.counts().expired, 1U);
}

TEST(Leases, LateCommitOfAnExpiredLeaseChangesNothing) {
  Leases leases(1, kPolicy);
  leases.lease("a", kBoth, "t1", kStart);
  leases.expire(kStart + 30s);
  EXPECT_EQ(leases.commit(0, "t1", "late"), CommitOutcome::kSuperseded);  // waits for the next worker
  leases.lease("b", kBoth, "t2", kStart + 30s);
  EXPECT_EQ(leases.commit(0, "t1", "late"), CommitOutcome::kSuperseded);  // leased to the next worker
  EXPECT_FALSE(leases.finished());
  EXPECT_EQ(leases.commit(0, "t2", "good"), CommitOutcome::kCommitted);
}

TEST(Leases, TheSameResultAgainIsADuplicateAndAnotherOneIsCounted) {
  Leases leases(1, kPolicy);
  leases.lease("a", kBoth, "t1", kStart);
  EXPECT_EQ(leases.commit(0, "t1", "d"), CommitOutcome::kCommitted);
  EXPECT_EQ(leases.commit(0, "t1", "d"), CommitOutcome::kDuplicate);   // the answer was lost
  EXPECT_EQ(leases.commit(0, "old", "d"), CommitOutcome::kDuplicate);  // an earlier attempt, the same bits
  EXPECT_EQ(leases.counts().diverged, 0U);
  EXPECT_EQ(leases.commit(0, "old", "other"), CommitOutcome::kSuperseded);
  EXPECT_EQ(leases.counts().diverged, 1U);
}

TEST(Leases, UnknownSlotsAndTokensChangeNothing) {
  Leases leases(1, kPolicy);
  leases.lease("a", kBoth, "t1", kStart);
  EXPECT_EQ(leases.commit(7, "t1", "d"), CommitOutcome::kSuperseded);
  EXPECT_EQ(leases.commit(0, "guess", "d"), CommitOutcome::kSuperseded);
  EXPECT_FALSE(leases.fail(0, "guess", FailureClass::kTask, kError));
  EXPECT_FALSE(leases.fail(7, "t1", FailureClass::kTask, kError));
  EXPECT_FALSE(leases.renew("guess", kStart));
  EXPECT_EQ(leases.counts().leased, 1U);
}

TEST(Leases, RenewalKeepsALease) {
  Leases leases(1, kPolicy);
  leases.lease("a", kBoth, "t1", kStart);
  EXPECT_TRUE(leases.renew("t1", kStart + 20s));
  leases.expire(kStart + 30s);
  EXPECT_EQ(leases.counts().leased, 1U);
  leases.expire(kStart + 50s);
  EXPECT_FALSE(leases.renew("t1", kStart + 50s));
}

TEST(Leases, AFailedTaskGoesToAnotherWorkerFirst) {
  Leases leases(1, kPolicy);
  leases.lease("a", kBoth, "t1", kStart);
  EXPECT_TRUE(leases.fail(0, "t1", FailureClass::kTask, kError));
  EXPECT_EQ(leases.lease("a", kBoth, "t2", kStart), std::nullopt);
  EXPECT_EQ(leases.lease("b", kBoth, "t3", kStart), (Grant{0, 2}));
  EXPECT_TRUE(leases.fail(0, "t3", FailureClass::kTask, kError));
  EXPECT_EQ(leases.lease("a", kBoth, "t4", kStart), (Grant{0, 3})) << "it has failed on every live worker";
}

TEST(Leases, ThreeTaskFailuresFailTheJob) {
  Leases leases(2, kPolicy);
  for (const char* name : {"t1", "t2", "t3"}) {
    EXPECT_FALSE(leases.verdict());
    ASSERT_EQ(leases.lease("a", {"a"}, name, kStart)->slot, 0U);
    leases.fail(0, name, FailureClass::kTask, kError);
  }
  ASSERT_TRUE(leases.verdict());
  EXPECT_EQ(leases.verdict()->reason, JobFailure::Reason::kTaskFailed);
  EXPECT_EQ(leases.verdict()->error.message, "task 0: sums are not finite");
}

TEST(Leases, PreemptionsAndGoodbyesCountNowhere) {
  Leases leases(1, kPolicy);
  for (int i = 0; i < 20; ++i) {
    ASSERT_TRUE(leases.lease("a", {"a"}, token('t', i), kStart));
    if (i % 2 == 0)
      leases.fail(0, token('t', i), FailureClass::kPreempted, kError);
    else
      leases.release("a");
  }
  EXPECT_FALSE(leases.verdict());
  EXPECT_EQ(leases.counts().failed + leases.counts().expired, 0U);
}

TEST(Leases, WorkerFailuresDoNotFailTheJobButMissingDataDoesAtOnce) {
  Leases leases(1, kPolicy);
  for (int i = 0; i < 5; ++i) {
    leases.lease("a", {"a"}, token('w', i), kStart);
    leases.fail(0, token('w', i), FailureClass::kWorker, kError);
  }
  EXPECT_FALSE(leases.verdict());
  leases.lease("a", {"a"}, "d", kStart);
  leases.fail(0, "d", FailureClass::kData, kError);
  EXPECT_TRUE(leases.verdict());
}

TEST(Leases, ATaskThatSilencesWorkerAfterWorkerFailsTheJob) {
  Leases leases(1, kPolicy);
  Time now = kStart;
  for (int i = 0; i < kPolicy.losses; ++i, now += 30s) {
    EXPECT_FALSE(leases.verdict());
    ASSERT_TRUE(leases.lease(token('w', i), kBoth, token('t', i), now));
    leases.expire(now + 30s);
  }
  ASSERT_TRUE(leases.verdict());
  EXPECT_EQ(leases.verdict()->reason, JobFailure::Reason::kTaskLost);
}

TEST(Leases, CloseEndsAllLeases) {
  Leases leases(3, kPolicy);
  leases.lease("a", kBoth, "t1", kStart);
  leases.close();
  EXPECT_FALSE(leases.renew("t1", kStart));
  EXPECT_EQ(leases.next_expiry(), std::nullopt);
  EXPECT_EQ(leases.lease("b", kBoth, "t2", kStart), std::nullopt);
}

}  // namespace
}  // namespace radfarm
