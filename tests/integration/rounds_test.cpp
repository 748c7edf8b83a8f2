// Jobs of several rounds on a farm, and jobs that are extended.
#include <nlohmann/json.hpp>

#include "integration/farm.h"

namespace radfarm::test {
namespace {

class RoundsTest : public FarmTest {
 protected:
  static RenderRequest asked(std::optional<double> error) {
    RenderRequest request;
    request.width = 48;
    request.height = 36;
    request.quality = RenderRequest::Quality::kPreview;
    request.integrator = RenderRequest::Integrator::kPathTrace;
    if (!error) request.samples = 4;
    request.error = error;
    return request;
  }
  nlohmann::json report_of(const JobStatus& job) {
    for (const Artifact& artifact : job.artifacts) {
      if (artifact.name != "report.json") continue;
      const std::vector<std::byte> bytes = *client_->blobs().download(artifact.blob.digest, 1 << 24);
      return nlohmann::json::parse(reinterpret_cast<const char*>(bytes.data()),
                                   reinterpret_cast<const char*>(bytes.data()) + bytes.size());
    }
    return {};
  }
};

TEST_F(RoundsTest, AFinishedJobGoesOnFromItsSumsWhenItIsExtended) {
  const ChildProcess worker = start_worker("worker");
  const std::string id = submit(asked({}));
  const JobStatus first = wait_for_end(id);
  ASSERT_EQ(first.state, JobState::kSucceeded);
  EXPECT_EQ(first.progress.round, 1U);
  EXPECT_FALSE(first.estimates.empty());
  const nlohmann::json before = report_of(first);
  ASSERT_TRUE(client_->extend(id, 0.1));
  const JobStatus extended = wait_for_end(id);
  ASSERT_EQ(extended.state, JobState::kSucceeded) << extended.failure.error.message;
  EXPECT_FALSE(extended.target_missed);
  EXPECT_GE(extended.progress.round, 2U);
  EXPECT_GT(extended.cpu_seconds, first.cpu_seconds);
  const nlohmann::json after = report_of(extended);
  EXPECT_EQ(after["accuracy"]["target"], 0.1);
  EXPECT_EQ(after["accuracy"]["target_met"], true);
  EXPECT_LT(after["accuracy"]["relative_rmse_ci95"][1], 0.1);
  EXPECT_EQ(after["rounds"][0]["relative_rmse"], before["rounds"][0]["relative_rmse"]) << "what stood is not done again";
  EXPECT_EQ(after["rounds"].size(), extended.progress.round);
  EXPECT_NE(after["image"]["digest"], before["image"]["digest"]);
  EXPECT_TRUE(client_->extend(id, 0.1)) << "again is fine";
  EXPECT_EQ(status(id).state, JobState::kSucceeded);
}

TEST_F(RoundsTest, RoundsOfAJobAreTheSameWhoeverRendersThem) {
  std::string digest;
  for (int workers = 1; workers <= 2; ++workers) {
    std::vector<ChildProcess> running;
    for (int i = 0; i < workers; ++i) running.push_back(start_worker("worker"));
    const JobStatus job = wait_for_end(submit(asked(0.06)));
    ASSERT_EQ(job.state, JobState::kSucceeded) << job.failure.error.message;
    const std::string found = image_digest_of(job);
    if (digest.empty()) digest = found;
    EXPECT_EQ(found, digest) << workers;
  }
}

TEST_F(RoundsTest, OnlyAFinishedJobIsExtendedAndOnlyToWhatMakesSense) {
  EXPECT_EQ(client_->extend("no such job", 0.1).error().code, Code::kNotFound);
  const std::string waiting = submit(asked({}));
  EXPECT_EQ(client_->extend(waiting, 0.1).error().code, Code::kFailedPrecondition);
  const ChildProcess worker = start_worker("worker");
  ASSERT_EQ(wait_for_end(waiting).state, JobState::kSucceeded);
  for (const double error : {0.0, -1.0, 2.0, 1e-9}) {
    EXPECT_EQ(client_->extend(waiting, error).error().code, Code::kInvalidArgument) << error;
  }
}

TEST_F(RoundsTest, AnExtensionCanBeCancelled) {
  std::unique_ptr<ChildProcess> worker = std::make_unique<ChildProcess>(start_worker("worker"));
  const std::string id = submit(asked({}));
  ASSERT_EQ(wait_for_end(id).state, JobState::kSucceeded);
  worker.reset();  // nobody renders what follows
  ASSERT_TRUE(client_->extend(id, 0.02));
  ASSERT_TRUE(eventually([&] { return status(id).state == JobState::kRendering; }));
  ASSERT_TRUE(client_->cancel(id));
  const JobStatus cancelled = wait_for_end(id);
  EXPECT_EQ(cancelled.state, JobState::kCancelled);
  EXPECT_EQ(cancelled.artifacts.size(), 2U) << "the image that it had";
}

}  // namespace
}  // namespace radfarm::test
