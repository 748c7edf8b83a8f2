#pragma once

#include <atomic>
#include <chrono>
#include <condition_variable>
#include <filesystem>
#include <mutex>
#include <optional>
#include <string>
#include <thread>
#include <vector>

#include "worker/coordinator_client.h"
#include "worker/held_leases.h"
#include "worker/prepared_cache.h"

namespace radfarm {

struct WorkerOptions {
  std::string coordinator;  // host:port of its worker port
  std::string name;
  std::filesystem::path cache;                // blobs; may be shared by the workers of a machine
  std::uint32_t threads = 1;                  // tasks run at once
  std::chrono::milliseconds patience{60000};  // without any answer from the coordinator, then it gives up
};

/// Leases tasks, runs them, hands results in. Threads: one leases, one renews, `threads` run tasks. A task is on one
/// thread.
class WorkerLoop {
 public:
  WorkerLoop(WorkerOptions options, const BlobStore& cache);

  /// Until stop(), then finishes what runs, hands the rest back and says goodbye. UNAVAILABLE when the coordinator has
  /// been silent for longer than the patience, FAILED_PRECONDITION when it wants no more of this worker.
  Status run();
  /// Ends run(); from any thread, any number of times.
  void stop();

 private:
  Status lease_until_stopped();
  Status lease_once();
  void renew_until_stopped();
  void run_tasks();
  void run_one(const Lease& lease);
  void hand_in(const Lease& lease, std::span<const std::byte> result, double cpu_seconds);
  void report_failure(const Lease& lease, FailureClass failure_class, const Error& error);
  void note_answer(const Status& status);
  bool pause(std::chrono::milliseconds wait);
  Status register_here();
  void return_waiting();
  std::string worker_id();

  const WorkerOptions options_;
  const rpc::BlobClient blobs_;
  CoordinatorClient coordinator_;
  PreparedCache prepared_;

  std::mutex mutex_;
  std::condition_variable changed_;
  std::string worker_id_;
  std::chrono::milliseconds lease_length_{0};
  HeldLeases held_;
  bool stopping_ = false;  // no new leases
  bool draining_ = false;  // task threads end when nothing waits
  bool finished_ = false;  // renewals end
  std::chrono::steady_clock::time_point last_answer_;
};

}  // namespace radfarm
