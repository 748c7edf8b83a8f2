#pragma once

#include "coordinator/scheduler.h"
#include "radfarm/v1/worker_control.grpc.pb.h"

namespace radfarm {

/// v1.WorkerControl: decode, ask the scheduler, encode.
class WorkerControlService final : public v1::WorkerControl::CallbackService {
 public:
  explicit WorkerControlService(Scheduler& scheduler) : scheduler_(scheduler) {}

  grpc::ServerUnaryReactor* RegisterWorker(grpc::CallbackServerContext* context,
                                           const v1::RegisterWorkerRequest* request,
                                           v1::RegisterWorkerResponse* response) override;
  grpc::ServerUnaryReactor* LeaseTasks(grpc::CallbackServerContext* context, const v1::LeaseTasksRequest* request,
                                       v1::LeaseTasksResponse* response) override;
  grpc::ServerUnaryReactor* RenewLeases(grpc::CallbackServerContext* context, const v1::RenewLeasesRequest* request,
                                        v1::RenewLeasesResponse* response) override;
  grpc::ServerReadReactor<v1::CommitTaskRequest>* CommitTask(grpc::CallbackServerContext* context,
                                                             v1::CommitTaskResponse* response) override;
  grpc::ServerUnaryReactor* FailTask(grpc::CallbackServerContext* context, const v1::FailTaskRequest* request,
                                     v1::FailTaskResponse* response) override;
  grpc::ServerUnaryReactor* UnregisterWorker(grpc::CallbackServerContext* context,
                                             const v1::UnregisterWorkerRequest* request,
                                             v1::UnregisterWorkerResponse* response) override;

 private:
  Scheduler& scheduler_;
};

}  // namespace radfarm
