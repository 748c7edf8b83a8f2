#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "base/file.h"
#include "base/status.h"
#include "process/child_process.h"

namespace radfarm::cli {

/// A coordinator and workers as child processes of this one, on loopback ports that the system chooses, with a data
/// folder that goes away with them. However this process ends, none of them outlives it.
class LocalFarm {
 public:
  struct Options {
    int workers = 2;
    int threads = 1;  // of each worker
    std::filesystem::path solutions;  // solved light is kept there for later farms; empty: none is
  };
  /// Returns when the coordinator serves; the workers register by themselves.
  static Result<LocalFarm> start(const Options& options);
  LocalFarm(LocalFarm&&) = default;
  LocalFarm& operator=(LocalFarm&&) = delete;
  /// Asks all to end, waits a moment, then kills.
  ~LocalFarm();

  const std::string& address() const { return address_; }
  /// Why the render cannot go on: the coordinator or all workers have ended.
  Status check();

 private:
  explicit LocalFarm(TemporaryDirectory folder) : folder_(std::move(folder)) {}
  Status start_coordinator(const Options& options);
  Status start_worker(int number, int threads);

  TemporaryDirectory folder_;
  std::string address_, worker_address_;
  std::vector<ChildProcess> coordinator_;  // one
  std::vector<ChildProcess> workers_;
};

}  // namespace radfarm::cli
