#include "coordinator/server.h"

#include <fcntl.h>
#include <sys/file.h>
#include <unistd.h>

#include <chrono>
#include <memory>
#include <system_error>
#include <utility>

#include <grpcpp/grpcpp.h>
#include <grpcpp/health_check_service_interface.h>

#include "base/log.h"
#include "coordinator/blobs_service.h"
#include "coordinator/render_jobs_service.h"
#include "coordinator/worker_control_service.h"
#include "rpc/channel.h"

namespace radfarm {
namespace {

namespace fs = std::filesystem;

// Calls still open after this are cut; by then every one that waits has been answered.
constexpr std::chrono::seconds kShutdownGrace{2};

/// The data folder belongs to one coordinator at a time.
class FolderLock {
 public:
  explicit FolderLock(int file) : file_(file) {}
  ~FolderLock() {
    if (file_ >= 0) ::close(file_);
  }
  FolderLock(FolderLock&& other) noexcept : file_(std::exchange(other.file_, -1)) {}
  FolderLock& operator=(FolderLock&&) = delete;

 private:
  int file_;
};

Result<FolderLock> lock_folder(const fs::path& folder) {
  std::error_code error;
  fs::create_directories(folder, error);
  const int file = ::open((folder / "lock").c_str(), O_RDWR | O_CREAT | O_CLOEXEC, 0644);
  if (error || file < 0) return fail(Code::kPermissionDenied, folder.string() + ": cannot write to the data folder");
  FolderLock lock(file);
  if (::flock(file, LOCK_EX | LOCK_NB) == 0) return lock;
  return fail(Code::kAlreadyExists, folder.string() + ": another coordinator uses this data folder");
}

Result<fs::path> empty_scratch(const fs::path& folder) {
  std::error_code error;
  fs::remove_all(folder, error);
  fs::create_directories(folder, error);
  if (error) return fail(Code::kPermissionDenied, folder.string() + ": cannot create: " + error.message());
  return folder;
}

struct Listening {
  std::unique_ptr<grpc::Server> server;
  std::string address;
};

Result<Listening> listen(const std::string& address, grpc::Service& blobs, grpc::Service& service) {
  grpc::ServerBuilder builder;
  int port = 0;
  rpc::configure_server(builder);
  builder.AddListeningPort(address, grpc::InsecureServerCredentials(), &port);
  builder.RegisterService(&blobs);
  builder.RegisterService(&service);
  std::unique_ptr<grpc::Server> server = builder.BuildAndStart();
  if (server == nullptr || port == 0) return fail(Code::kUnavailable, address + ": cannot listen; is the port taken?");
  return Listening{std::move(server), address.substr(0, address.rfind(':') + 1) + std::to_string(port)};
}

}  // namespace

Status serve(const ServerOptions& options, const std::function<void(const ServerAddresses&)>& wait_for_stop) {
  RADFARM_TRY_STATUS(rpc::check_address(options.listen, "--listen"));
  RADFARM_TRY_STATUS(rpc::check_address(options.worker_listen, "--worker-listen"));
  RADFARM_TRY(const FolderLock lock, lock_folder(options.data));
  RADFARM_TRY(const BlobStore blobs, BlobStore::open(options.data / "blobs", options.max_blob_bytes));
  SchedulerOptions scheduler_options = options.scheduler;
  RADFARM_TRY(scheduler_options.prepare.scratch, empty_scratch(options.data / "scratch"));
  if (scheduler_options.prepare.solutions.empty()) scheduler_options.prepare.solutions = options.data / "solutions";

  grpc::EnableDefaultHealthCheckService(true);
  Scheduler scheduler(blobs, scheduler_options);
  BlobsService client_blobs(blobs, BlobsService::Access::kReadWrite);
  BlobsService worker_blobs(blobs, BlobsService::Access::kReadOnly);
  RenderJobsService render_jobs(scheduler);
  WorkerControlService worker_control(scheduler);
  RADFARM_TRY(const Listening clients, listen(options.listen, client_blobs, render_jobs));
  RADFARM_TRY(const Listening workers, listen(options.worker_listen, worker_blobs, worker_control));
  spdlog::info("serving clients on {}, workers on {}, data in {}", clients.address, workers.address,
               options.data.string());
  wait_for_stop({clients.address, workers.address});

  spdlog::info("stopping");
  scheduler.stop();
  const auto deadline = std::chrono::system_clock::now() + kShutdownGrace;
  clients.server->Shutdown(deadline);
  workers.server->Shutdown(deadline);
  return {};
}

}  // namespace radfarm
