#include "integration/farm.h"

#include <unistd.h>

#include <nlohmann/json.hpp>

#include "cli/upload.h"
#include "image/digest.h"
#include "image/exr.h"

namespace radfarm::test {

FarmTest::FarmTest() {
  coordinator_ = std::make_unique<ChildProcess>(std::move(*ChildProcess::start(
      program("radfarm-coordinator"),
      {"serve", "--listen", "127.0.0.1:0", "--worker-listen", "127.0.0.1:0", "--data",
       (folder_.path() / "data").string(), "--lease-ms", "1000", "--parent-pid", std::to_string(::getpid())},
      ChildProcess::Stdout::kCapture)));
  const nlohmann::json line = nlohmann::json::parse(coordinator_->read_line(kPatience).value_or("{}"));
  worker_address_ = line.value("worker_address", "");
  client_ = std::make_unique<cli::FarmClient>(line.value("address", ""));
}

ChildProcess FarmTest::start_worker(const std::string& name) {
  return std::move(*ChildProcess::start(
      program("radfarm-worker"),
      {"--coordinator", worker_address_, "--name", name, "--threads", "1", "--cache",
       (folder_.path() / "cache").string(), "--give-up-after", "1", "--parent-pid", std::to_string(::getpid())},
      ChildProcess::Stdout::kToStderr));
}

std::string FarmTest::submit(const std::filesystem::path& scene_file, const RenderRequest& request) {
  const Result<JobStatus> job = cli::submit_scene(*client_, scene_file, request);
  EXPECT_TRUE(job) << job.error().message;
  return job ? job->id : "";
}

std::string FarmTest::submit(const RenderRequest& request) { return submit(scene("cornell.gltf"), request); }

JobStatus FarmTest::wait_for_end(const std::string& id) {
  JobStatus last;
  EXPECT_TRUE(eventually([&] { return is_terminal((last = status(id)).state); }));
  return last;
}

std::string FarmTest::image_digest_of(const JobStatus& job) {
  for (const Artifact& artifact : job.artifacts) {
    if (artifact.name != "image.exr") continue;
    return image_digest(*decode_exr(*client_->blobs().download(artifact.blob.digest, 1 << 28)));
  }
  ADD_FAILURE() << "job " << job.id << " left no image: " << job.failure.error.message;
  return "";
}

RenderRequest FarmTest::small_request() {
  RenderRequest request;
  request.integrator = RenderRequest::Integrator::kPathTrace;
  request.width = 96;
  request.height = 64;
  request.tile = 8;
  request.samples = 64;
  return request;
}

}  // namespace radfarm::test
