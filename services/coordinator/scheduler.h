#pragma once

#include <condition_variable>
#include <deque>
#include <functional>
#include <map>
#include <memory>
#include <mutex>
#include <optional>
#include <span>
#include <stop_token>
#include <string>
#include <thread>
#include <vector>

#include "coordinator/blob_store.h"
#include "coordinator/executor.h"
#include "coordinator/job.h"
#include "coordinator/stages.h"
#include "coordinator/workers.h"

namespace radfarm {

struct SchedulerOptions {
  LeasePolicy leases;
  Workers::Policy workers;
  PrepareOptions prepare;
  int stage_threads = 2;               // jobs prepared or assembled at once
  std::size_t unfinished_jobs = 1000;  // more are refused
  std::size_t finished_jobs = 10000;   // older ones are forgotten
  int expected_threads = 1;            // of all workers together, where fewer have registered yet
};

/// All jobs and workers of a coordinator under one mutex. It decides nothing itself: Job, Leases and Workers do; it
/// brings them time, random tokens and threads. Thread-safe. Callbacks run under the mutex: they must be quick and must
/// not call back. Threads: the executor's for long steps and one that wakes at the next deadline.
class Scheduler {
 public:
  Scheduler(const BlobStore& blobs, SchedulerOptions options);
  /// Answers every waiting worker and watcher with UNAVAILABLE and kills running preparations.
  ~Scheduler();
  Scheduler(const Scheduler&) = delete;
  Scheduler& operator=(const Scheduler&) = delete;

  // For clients; errors as in render_jobs.proto.
  Result<JobStatus> create(const std::string& request_id, const JobSpec& spec);
  struct Described {
    JobStatus status;
    JobSpec spec;
  };
  Result<Described> get(const std::string& id);
  struct Page {
    std::vector<JobStatus> jobs;
    std::string next_token;
  };
  Result<Page> list(std::uint32_t page_size, const std::string& page_token);
  Result<JobStatus> cancel(const std::string& id);
  /// A finished job goes on, for a relative error.
  Result<JobStatus> extend(const std::string& id, double error);
  using WatchCallback = std::function<void(const Result<JobStatus>&)>;
  using WatchId = std::uint64_t;
  /// Calls back now and after each change; after an error never again.
  Result<WatchId> watch(const std::string& id, WatchCallback callback);
  /// After this returns the callback is not called any more.
  void unwatch(const std::string& id, WatchId watch);

  // For workers; errors as in worker_control.proto.
  WorkerWelcome register_worker(const WorkerHello& hello);
  struct LeaseWait {
    std::string worker_id;
    std::uint32_t max_tasks = 1;
    std::chrono::milliseconds wait{0};
    std::function<bool()> is_cancelled;                             // the caller has gone: give it nothing
    std::function<void(const Result<std::vector<Lease>>&)> answer;  // called exactly once
  };
  void lease(LeaseWait wait);
  Result<std::vector<std::string>> renew(const std::string& worker_id, const std::vector<std::string>& tokens);
  Result<CommitOutcome> commit(const CommitHeader& header, std::span<const std::byte> bytes);
  Status fail_task(const TaskFailure& failure);
  Status unregister_worker(const std::string& worker_id);

  /// Ends all waits with UNAVAILABLE and takes no more work; called before the servers shut down.
  void stop();

 private:
  struct Entry {
    Entry(Job state_machine, std::string request) : job(std::move(state_machine)), request_id(std::move(request)) {}
    Job job;
    std::string request_id;
    std::stop_source stop;
    Time preparing_since{};         // for the first time
    Time rendering_since{};
    double round_seconds = 0;       // of the round that was rendered last
    double rendered_seconds = 0;    // of all rounds
    std::map<WatchId, WatchCallback> watchers;
  };
  struct Waiter {
    LeaseWait wait;
    Time deadline;
  };

  // All below require mutex_ held, except run_* which take it.
  Result<Entry*> find(const std::string& id);
  Entry* find_request(const std::string& request_id);
  JobStatus status_of(const Entry& entry) const;
  void changed(Entry& entry);
  void forget_old();
  void run_preparation(const std::string& id);
  void run_assembly(const std::string& id);
  std::optional<ToPrepare> start_preparation(const std::string& id, std::stop_token& stop);
  std::optional<ToAssemble> start_assembly(const std::string& id);
  void go_on(Entry& entry, AssembledJob assembled);
  void assemble_if_done(Entry& entry);
  void fail_if_broken(Entry& entry);
  template <typename Step>
  void settle(const std::string& id, const Step& step);

  std::vector<Lease> take_tasks(const std::string& worker_id, const Workers::Worker& worker, std::uint32_t max_tasks,
                                Time now);
  /// True when the waiter has been answered.
  bool serve(Waiter& waiter, Time now);
  void serve_waiters(Time now);
  void expire(Time now);
  std::optional<Time> next_deadline() const;
  void run_timer();

  const BlobStore& blobs_;
  const SchedulerOptions options_;
  std::mutex mutex_;
  std::condition_variable deadline_changed_;
  bool stopping_ = false;
  std::deque<std::unique_ptr<Entry>> jobs_;  // oldest first
  Workers workers_;
  std::vector<Waiter> waiters_;
  WatchId next_watch_ = 1;
  Executor executor_;
  std::thread timer_;
};

}  // namespace radfarm
