#pragma once

#include <filesystem>
#include <functional>
#include <string>

#include "base/status.h"
#include "coordinator/scheduler.h"

namespace radfarm {

struct ServerOptions {
  std::string listen = "127.0.0.1:7400";         // for clients
  std::string worker_listen = "127.0.0.1:7401";  // for workers
  std::filesystem::path data;
  std::uint64_t max_blob_bytes = 0;
  SchedulerOptions scheduler;  // prepare.scratch is set from `data`, prepare.solutions where it is empty
};

struct ServerAddresses {
  std::string clients;  // host:port with the port that the system chose
  std::string workers;
};

/// Serves until `wait_for_stop` returns; it is called once both ports are open. ALREADY_EXISTS when another coordinator
/// uses the data folder, UNAVAILABLE when a port is taken.
Status serve(const ServerOptions& options, const std::function<void(const ServerAddresses&)>& wait_for_stop);

}  // namespace radfarm
