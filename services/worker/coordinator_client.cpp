#include "worker/coordinator_client.h"

#include "rpc/client.h"
#include "rpc/reply.h"
#include "rpc/wire.h"

namespace radfarm {
namespace {

constexpr std::chrono::seconds kDeadline{20};
constexpr std::chrono::seconds kCommitDeadline{120};

}  // namespace

CoordinatorClient::CoordinatorClient(const std::shared_ptr<grpc::Channel>& channel)
    : stub_(v1::WorkerControl::NewStub(channel)) {}

Result<WorkerWelcome> CoordinatorClient::register_worker(const WorkerHello& hello) {
  v1::RegisterWorkerRequest request;
  v1::RegisterWorkerResponse response;
  wire::encode(hello, request);
  RADFARM_TRY_STATUS(rpc::call(
      kDeadline, [&](grpc::ClientContext& context) { return stub_->RegisterWorker(&context, request, &response); }));
  return WorkerWelcome{response.worker_id(), std::chrono::milliseconds(response.lease_ms())};
}

Result<std::vector<Lease>> CoordinatorClient::lease(const std::string& worker_id, std::uint32_t max_tasks,
                                                    std::chrono::milliseconds wait) {
  v1::LeaseTasksRequest request;
  v1::LeaseTasksResponse response;
  request.set_worker_id(worker_id);
  request.set_max_tasks(max_tasks);
  request.set_wait_ms(static_cast<std::uint32_t>(wait.count()));
  const Status called = rpc::call(wait + kDeadline, [&](grpc::ClientContext& context) -> grpc::Status {
    {
      const std::lock_guard lock(mutex_);
      if (stopped_) return grpc::Status::CANCELLED;
      waiting_ = &context;
    }
    const grpc::Status status = stub_->LeaseTasks(&context, request, &response);
    const std::lock_guard lock(mutex_);
    waiting_ = nullptr;
    return status;
  });
  RADFARM_TRY_STATUS(called);
  std::vector<Lease> leases;
  for (const v1::Lease& message : response.leases()) {
    RADFARM_TRY(Lease lease, wire::parse(message));
    leases.push_back(std::move(lease));
  }
  return leases;
}

void CoordinatorClient::stop_waiting() {
  const std::lock_guard lock(mutex_);
  stopped_ = true;
  if (waiting_ != nullptr) waiting_->TryCancel();
}

Result<std::vector<std::string>> CoordinatorClient::renew(const std::string& worker_id,
                                                          const std::vector<std::string>& tokens) {
  v1::RenewLeasesRequest request;
  v1::RenewLeasesResponse response;
  request.set_worker_id(worker_id);
  for (const std::string& token : tokens) request.add_tokens(token);
  RADFARM_TRY_STATUS(rpc::call(
      kDeadline, [&](grpc::ClientContext& context) { return stub_->RenewLeases(&context, request, &response); }));
  return std::vector<std::string>(response.lost_tokens().begin(), response.lost_tokens().end());
}

Result<CommitOutcome> CoordinatorClient::commit(const CommitHeader& header, std::span<const std::byte> bytes) {
  v1::CommitTaskRequest request;
  v1::CommitTaskResponse response;
  wire::encode(header, *request.mutable_header());
  RADFARM_TRY_STATUS(rpc::call(kCommitDeadline, [&](grpc::ClientContext& context) {
    const auto writer = stub_->CommitTask(&context, &response);
    return rpc::write_chunked(*writer, request, bytes);
  }));
  return static_cast<CommitOutcome>(response.outcome());
}

Status CoordinatorClient::fail_task(const TaskFailure& failure) {
  v1::FailTaskRequest request;
  v1::FailTaskResponse response;
  wire::encode(failure, request);
  return rpc::call(kDeadline,
                   [&](grpc::ClientContext& context) { return stub_->FailTask(&context, request, &response); });
}

Status CoordinatorClient::unregister_worker(const std::string& worker_id) {
  v1::UnregisterWorkerRequest request;
  v1::UnregisterWorkerResponse response;
  request.set_worker_id(worker_id);
  return rpc::call(std::chrono::seconds(2),
                   [&](grpc::ClientContext& context) { return stub_->UnregisterWorker(&context, request, &response); });
}

}  // namespace radfarm
