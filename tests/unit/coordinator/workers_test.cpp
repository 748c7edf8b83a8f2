#include "coordinator/workers.h"

#include <gtest/gtest.h>

namespace radfarm {
namespace {

using namespace std::chrono_literals;

const Time kStart{};

WorkerHello hello(const std::string& fingerprint) { return {"name", "build", fingerprint, 1, 1}; }

TEST(Workers, AreForgottenWhenSilent) {
  Workers workers({60s, 3});
  workers.add("a", hello("f"), kStart);
  workers.add("b", hello("f"), kStart);
  EXPECT_TRUE(workers.touch("a", kStart + 30s));
  EXPECT_EQ(workers.next_silence(), kStart + 60s);
  EXPECT_EQ(workers.threads(), 2);
  EXPECT_EQ(workers.forget_silent(kStart + 60s), std::set<std::string>{"b"});
  EXPECT_EQ(workers.touch("b", kStart + 60s).error().code, Code::kNotFound);
  EXPECT_EQ(workers.count(), 1U);
}

TEST(Workers, AreQuarantinedAfterThreeFailuresOfTheirOwn) {
  Workers workers({60s, 3});
  workers.add("a", hello("f"), kStart);
  const std::string worker_class = (*workers.touch("a", kStart))->worker_class();
  EXPECT_FALSE(workers.count_own_failure("a"));
  EXPECT_FALSE(workers.count_own_failure("a"));
  EXPECT_EQ(workers.live(worker_class).size(), 1U);
  EXPECT_TRUE(workers.count_own_failure("a"));
  EXPECT_TRUE(workers.live(worker_class).empty());
}

TEST(Workers, OfAnotherFingerprintAreOfAnotherClass) {
  Workers workers({60s, 3});
  workers.add("a", hello("f"), kStart);
  workers.add("b", hello("g"), kStart);
  EXPECT_EQ(workers.live((*workers.touch("b", kStart))->worker_class()), std::set<std::string>{"b"});
}

}  // namespace
}  // namespace radfarm
