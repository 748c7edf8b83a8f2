#pragma once

#include <memory>
#include <string>
#include <vector>

#include <gtest/gtest.h>

#include "base/file.h"
#include "cli/farm_client.h"
#include "frame/request.h"
#include "integration/processes.h"
#include "process/child_process.h"

namespace radfarm::test {

/// A coordinator with short leases in a folder of its own, a client, and as many workers as a test starts.
class FarmTest : public testing::Test {
 protected:
  FarmTest();

  ChildProcess start_worker(const std::string& name);
  /// A small render of cornell.gltf, queued.
  std::string submit(const RenderRequest& request);
  std::string submit(const std::filesystem::path& scene_file, const RenderRequest& request);
  JobStatus status(const std::string& id) { return *client_->get(id); }
  JobStatus wait_for_end(const std::string& id);
  /// The digest of a finished job's pixels.
  std::string image_digest_of(const JobStatus& job);

  /// Enough work to be interrupted: some hundred tasks of some milliseconds.
  static RenderRequest small_request();

  TemporaryDirectory folder_ = *TemporaryDirectory::create("farm-test");
  std::unique_ptr<ChildProcess> coordinator_;
  std::string worker_address_;
  std::unique_ptr<cli::FarmClient> client_;
};

}  // namespace radfarm::test
