#pragma once

#include <functional>
#include <memory>
#include <mutex>
#include <string>
#include <vector>

#include "base/status.h"
#include "radfarm/v1/render_jobs.grpc.pb.h"
#include "rpc/blob_client.h"
#include "rpc/messages.h"

namespace radfarm::cli {

/// A coordinator's client side as plain functions; UNAVAILABLE is retried for 20 s. Thread-safe.
class FarmClient {
 public:
  explicit FarmClient(const std::string& address);

  Result<JobStatus> create(const std::string& request_id, const JobSpec& spec);
  Result<JobStatus> get(const std::string& id);
  Result<std::vector<JobStatus>> list();
  Result<JobStatus> cancel(const std::string& id);
  Result<JobStatus> extend(const std::string& id, double error);
  const rpc::BlobClient& blobs() const { return blobs_; }

  /// Calls `on_status` now and after each change until the job is terminal. CANCELLED after stop_watching().
  Status watch(const std::string& id, const std::function<void(const JobStatus&)>& on_status);
  void stop_watching();

 private:
  Status watch_once(const std::string& id, const std::function<void(const JobStatus&)>& on_status);

  rpc::BlobClient blobs_;
  std::unique_ptr<v1::RenderJobs::Stub> stub_;
  std::mutex mutex_;
  grpc::ClientContext* watching_ = nullptr;
  bool stopped_ = false;
};

}  // namespace radfarm::cli
