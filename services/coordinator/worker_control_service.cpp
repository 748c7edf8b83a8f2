#include "coordinator/worker_control_service.h"

#include <algorithm>
#include <memory>
#include <optional>
#include <span>
#include <utility>
#include <vector>

#include "base/digest.h"
#include "rpc/limits.h"
#include "rpc/reply.h"
#include "rpc/streams.h"
#include "rpc/wire.h"

namespace radfarm {
namespace {

/// The messages of one commit, in order: header, chunks.
class CommitSink {
 public:
  CommitSink(Scheduler& scheduler, v1::CommitTaskResponse& response) : scheduler_(scheduler), response_(response) {}

  Status take(v1::CommitTaskRequest&& message) {
    if (header_.has_value() == message.has_header()) return fail(Code::kInvalidArgument, kOrder);
    if (message.has_header()) {
      RADFARM_TRY(header_, wire::parse(message.header()));
      return {};
    }
    const auto chunk = std::as_bytes(std::span(message.chunk()));
    if (bytes_.size() + chunk.size() > header_->result.size) return fail(Code::kDataLoss, "more bytes than promised");
    bytes_.insert(bytes_.end(), chunk.begin(), chunk.end());
    return {};
  }
  Status finish() {
    if (!header_) return fail(Code::kInvalidArgument, kOrder);
    if (bytes_.size() != header_->result.size || sha256_hex(bytes_) != header_->result.digest) {
      return fail(Code::kDataLoss, "the result has another digest or size than its header says");
    }
    RADFARM_TRY(const CommitOutcome outcome, scheduler_.commit(*header_, bytes_));
    response_.set_outcome(static_cast<v1::CommitTaskResponse::Outcome>(outcome));
    return {};
  }

 private:
  static constexpr const char* kOrder = "a commit is one header, then chunks";
  Scheduler& scheduler_;
  v1::CommitTaskResponse& response_;
  std::optional<CommitHeader> header_;
  std::vector<std::byte> bytes_;
};

}  // namespace

grpc::ServerUnaryReactor* WorkerControlService::RegisterWorker(grpc::CallbackServerContext* context,
                                                               const v1::RegisterWorkerRequest* request,
                                                               v1::RegisterWorkerResponse* response) {
  return rpc::reply(context, [&]() -> Status {
    RADFARM_TRY(const WorkerHello hello, wire::parse(*request));
    const WorkerWelcome welcome = scheduler_.register_worker(hello);
    response->set_worker_id(welcome.worker_id);
    response->set_lease_ms(static_cast<std::uint32_t>(welcome.lease_length.count()));
    return {};
  });
}

grpc::ServerUnaryReactor* WorkerControlService::LeaseTasks(grpc::CallbackServerContext* context,
                                                           const v1::LeaseTasksRequest* request,
                                                           v1::LeaseTasksResponse* response) {
  grpc::ServerUnaryReactor* const reactor = context->DefaultReactor();
  const auto answer = [reactor, response](const Result<std::vector<Lease>>& leases) {
    if (leases) {
      for (const Lease& lease : *leases) wire::encode(lease, *response->add_leases());
    }
    reactor->Finish(leases ? grpc::Status::OK : rpc::to_grpc(leases.error()));
  };
  scheduler_.lease({request->worker_id(), std::clamp(request->max_tasks(), 1U, limits::kWorkerThreads),
                    std::chrono::milliseconds(std::min(request->wait_ms(), limits::kLeaseWaitMs)),
                    [context] { return context->IsCancelled(); }, answer});
  return reactor;
}

grpc::ServerUnaryReactor* WorkerControlService::RenewLeases(grpc::CallbackServerContext* context,
                                                            const v1::RenewLeasesRequest* request,
                                                            v1::RenewLeasesResponse* response) {
  return rpc::reply(context, [&]() -> Status {
    const std::vector<std::string> tokens(request->tokens().begin(), request->tokens().end());
    RADFARM_TRY(const std::vector<std::string> lost, scheduler_.renew(request->worker_id(), tokens));
    for (const std::string& token : lost) response->add_lost_tokens(token);
    return {};
  });
}

grpc::ServerReadReactor<v1::CommitTaskRequest>* WorkerControlService::CommitTask(grpc::CallbackServerContext*,
                                                                                 v1::CommitTaskResponse* response) {
  return new rpc::ReadStream<v1::CommitTaskRequest, CommitSink>(std::make_unique<CommitSink>(scheduler_, *response));
}

grpc::ServerUnaryReactor* WorkerControlService::FailTask(grpc::CallbackServerContext* context,
                                                         const v1::FailTaskRequest* request, v1::FailTaskResponse*) {
  return rpc::reply(context, [&]() -> Status {
    RADFARM_TRY(const TaskFailure failure, wire::parse(*request));
    return scheduler_.fail_task(failure);
  });
}

grpc::ServerUnaryReactor* WorkerControlService::UnregisterWorker(grpc::CallbackServerContext* context,
                                                                 const v1::UnregisterWorkerRequest* request,
                                                                 v1::UnregisterWorkerResponse*) {
  return rpc::reply(context, [&] { return scheduler_.unregister_worker(request->worker_id()); });
}

}  // namespace radfarm
