// The client's side of a farm: jobs that fail, repeat and are cancelled.
#include <atomic>
#include <thread>

#include <nlohmann/json.hpp>

#include "base/digest.h"
#include "integration/farm.h"
#include "rpc/blob_client.h"

namespace radfarm::test {
namespace {

std::span<const std::byte> bytes_of(const std::string& text) { return std::as_bytes(std::span(text)); }

class JobsTest : public FarmTest {
 protected:
  /// The specification of a scene with the given text, uploaded.
  JobSpec upload(const std::string& text) {
    const BlobRef blob = rpc::blob_ref(bytes_of(text));
    EXPECT_TRUE(client_->blobs().upload(blob, bytes_of(text)));
    return {"scene", {{"scene.gltf", blob}}, "scene.gltf", to_json(small_request()).dump()};
  }
};

TEST_F(JobsTest, ABadSceneFailsItsJobAndNothingElse) {
  const JobStatus bad = wait_for_end(client_->create("bad", upload("{\"asset\": 7}"))->id);
  EXPECT_EQ(bad.state, JobState::kFailed);
  EXPECT_EQ(bad.failure.reason, JobFailure::Reason::kSceneInvalid);
  EXPECT_EQ(bad.failure.error.message.substr(0, 11), "scene.gltf:") << bad.failure.error.message;
  const ChildProcess worker = start_worker("worker");
  EXPECT_EQ(wait_for_end(submit(small_request())).state, JobState::kSucceeded);
}

TEST_F(JobsTest, TheSameRequestIdIsTheSameJob) {
  const JobSpec spec = upload("{}");
  const JobStatus first = *client_->create("once", spec);
  EXPECT_EQ(client_->create("once", spec)->id, first.id);
  JobSpec other = spec;
  other.display_name = "another";
  EXPECT_EQ(client_->create("once", other).error().code, Code::kAlreadyExists);
}

TEST_F(JobsTest, MissingFilesAreNamed) {
  JobSpec spec = upload("{}");
  spec.files.push_back({"missing.bin", {sha256_hex("missing"), 7}});
  const Result<JobStatus> refused = client_->create("r", spec);
  ASSERT_FALSE(refused);
  EXPECT_EQ(refused.error().code, Code::kFailedPrecondition);
  EXPECT_NE(refused.error().message.find(sha256_hex("missing")), std::string::npos);
}

TEST_F(JobsTest, HostilePathsAreRefused) {
  for (const char* path : {"../scene.gltf", "/etc/scene.gltf", "a/../../scene.gltf", ""}) {
    JobSpec spec = upload("{}");
    spec.files[0].path = spec.entry_path = path;
    EXPECT_EQ(client_->create(std::string("r").append(path), spec).error().code, Code::kInvalidArgument) << path;
  }
}

TEST_F(JobsTest, ARequestThatNamesAFileWhichIsNotAttachedIsRefused) {
  RenderRequest with_map = small_request(), with_ies = small_request();
  with_map.env = "/etc/hostname";
  with_ies.ies = {{"lamp", "../lamp.ies"}};
  for (const RenderRequest& request : {with_map, with_ies}) {
    JobSpec spec = upload("{}");
    spec.render_request_json = to_json(request).dump();
    const Result<JobStatus> refused = client_->create("r", spec);
    ASSERT_FALSE(refused);
    EXPECT_EQ(refused.error().code, Code::kInvalidArgument);
    EXPECT_NE(refused.error().message.find("is not one of spec.files"), std::string::npos) << refused.error().message;
  }
  RenderRequest sky = small_request();
  sky.env = "sky:overcast";
  JobSpec spec = upload("{}");
  spec.render_request_json = to_json(sky).dump();
  EXPECT_TRUE(client_->create("sky", spec)) << "a sky needs no file";
}

TEST_F(JobsTest, ACancelledJobTellsItsWatchersAndKeepsNoLease) {
  RenderRequest request = small_request();
  request.samples = 100000;
  const std::string id = submit(request);
  const ChildProcess worker = start_worker("worker");
  ASSERT_TRUE(eventually([&] { return status(id).progress.tasks_leased > 0; }));
  std::atomic<bool> seen = false;
  std::thread watcher([&] {
    EXPECT_TRUE(client_->watch(id, [&](const JobStatus& job) { seen = job.state == JobState::kCancelled; }));
  });
  EXPECT_TRUE(client_->cancel(id));
  watcher.join();
  EXPECT_TRUE(seen);
  EXPECT_EQ(status(id).progress.tasks_leased, 0U);
  EXPECT_TRUE(client_->cancel(id)) << "again is fine";
}

TEST_F(JobsTest, AreListedOldestFirst) {
  std::vector<std::string> ids;
  for (int i = 0; i < 3; ++i) ids.push_back(submit(small_request()));
  const std::vector<JobStatus> jobs = *client_->list();
  ASSERT_EQ(jobs.size(), 3U);
  for (std::size_t i = 0; i < 3; ++i) EXPECT_EQ(jobs[i].id, ids[i]);
  EXPECT_EQ(client_->get("no such job").error().code, Code::kNotFound);
}

TEST_F(JobsTest, DamagedUploadsAreRefused) {
  const BlobRef promised{sha256_hex("light"), 5};
  EXPECT_EQ(client_->blobs().upload(promised, bytes_of("night")).error().code, Code::kDataLoss);
  EXPECT_EQ(client_->blobs().find_missing({promised.digest})->size(), 1U);
  EXPECT_EQ(client_->blobs().download("../lock", 100).error().code, Code::kInvalidArgument);
}

}  // namespace
}  // namespace radfarm::test
