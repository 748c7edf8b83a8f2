#pragma once

#include <chrono>
#include <memory>
#include <mutex>
#include <span>
#include <string>
#include <vector>

#include "base/status.h"
#include "radfarm/v1/worker_control.grpc.pb.h"
#include "rpc/messages.h"

namespace radfarm {

/// WorkerControl as plain functions, one attempt each; who calls decides on retries. Thread-safe.
class CoordinatorClient {
 public:
  explicit CoordinatorClient(const std::shared_ptr<grpc::Channel>& channel);

  Result<WorkerWelcome> register_worker(const WorkerHello& hello);
  /// Waits up to `wait`; stop_waiting() ends it early with CANCELLED.
  Result<std::vector<Lease>> lease(const std::string& worker_id, std::uint32_t max_tasks,
                                   std::chrono::milliseconds wait);
  void stop_waiting();
  /// The tokens that are lost.
  Result<std::vector<std::string>> renew(const std::string& worker_id, const std::vector<std::string>& tokens);
  Result<CommitOutcome> commit(const CommitHeader& header, std::span<const std::byte> bytes);
  Status fail_task(const TaskFailure& failure);
  Status unregister_worker(const std::string& worker_id);

 private:
  std::unique_ptr<v1::WorkerControl::Stub> stub_;
  std::mutex mutex_;
  grpc::ClientContext* waiting_ = nullptr;  // the lease call under way
  bool stopped_ = false;
};

}  // namespace radfarm
