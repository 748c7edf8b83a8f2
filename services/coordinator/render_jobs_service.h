#pragma once

#include "coordinator/scheduler.h"
#include "radfarm/v1/render_jobs.grpc.pb.h"

namespace radfarm {

/// v1.RenderJobs: decode, ask the scheduler, encode.
class RenderJobsService final : public v1::RenderJobs::CallbackService {
 public:
  explicit RenderJobsService(Scheduler& scheduler) : scheduler_(scheduler) {}

  grpc::ServerUnaryReactor* CreateRenderJob(grpc::CallbackServerContext* context,
                                            const v1::CreateRenderJobRequest* request,
                                            v1::RenderJob* response) override;
  grpc::ServerUnaryReactor* GetRenderJob(grpc::CallbackServerContext* context, const v1::GetRenderJobRequest* request,
                                         v1::RenderJob* response) override;
  grpc::ServerUnaryReactor* ListRenderJobs(grpc::CallbackServerContext* context,
                                           const v1::ListRenderJobsRequest* request,
                                           v1::ListRenderJobsResponse* response) override;
  grpc::ServerUnaryReactor* CancelRenderJob(grpc::CallbackServerContext* context,
                                            const v1::CancelRenderJobRequest* request,
                                            v1::RenderJob* response) override;
  grpc::ServerUnaryReactor* ExtendRenderJob(grpc::CallbackServerContext* context,
                                            const v1::ExtendRenderJobRequest* request,
                                            v1::RenderJob* response) override;
  grpc::ServerWriteReactor<v1::RenderJob>* WatchRenderJob(grpc::CallbackServerContext* context,
                                                          const v1::WatchRenderJobRequest* request) override;

 private:
  Scheduler& scheduler_;
};

}  // namespace radfarm
