#include "coordinator/render_jobs_service.h"

#include <mutex>
#include <optional>
#include <utility>

#include "rpc/reply.h"
#include "rpc/wire.h"

namespace radfarm {
namespace {

/// One watch: the newest state not yet sent waits in next_; states in between are skipped when the reader is slow.
class WatchReactor final : public grpc::ServerWriteReactor<v1::RenderJob> {
 public:
  WatchReactor(Scheduler& scheduler, std::string job_id) : scheduler_(scheduler), job_id_(std::move(job_id)) {
    const auto watch = scheduler_.watch(job_id_, [this](const Result<JobStatus>& status) { offer(status); });
    if (watch) {
      watch_ = *watch;
    } else {
      offer(tl::unexpected(watch.error()));
    }
  }
  void OnWriteDone(bool ok) override {
    const std::lock_guard lock(mutex_);
    writing_ = false;
    if (!ok) end_ = fail(Code::kCancelled, "the client hung up");
    proceed();
  }
  void OnCancel() override { offer(fail(Code::kCancelled, "the client hung up")); }
  void OnDone() override {
    if (watch_) scheduler_.unwatch(job_id_, *watch_);
    delete this;
  }

 private:
  void offer(const Result<JobStatus>& status) {
    const std::lock_guard lock(mutex_);
    if (status) {
      next_ = *status;
    } else {
      end_ = tl::unexpected(status.error());
    }
    proceed();
  }
  void proceed() {
    if (writing_ || finished_) return;
    if (end_ && (!*end_ || !next_)) {
      finished_ = true;
      return Finish(rpc::to_grpc(*end_));
    }
    if (!next_) return;
    if (is_terminal(next_->state)) end_ = Status();
    message_.Clear();
    wire::encode(*next_, message_);
    next_.reset();
    writing_ = true;
    StartWrite(&message_);
  }

  Scheduler& scheduler_;
  const std::string job_id_;
  std::optional<Scheduler::WatchId> watch_;
  std::mutex mutex_;
  std::optional<JobStatus> next_;
  std::optional<Status> end_;  // the call ends with this once nothing is being written
  bool writing_ = false;
  bool finished_ = false;
  v1::RenderJob message_;
};

}  // namespace

grpc::ServerUnaryReactor* RenderJobsService::CreateRenderJob(grpc::CallbackServerContext* context,
                                                             const v1::CreateRenderJobRequest* request,
                                                             v1::RenderJob* response) {
  return rpc::reply(context, [&]() -> Status {
    RADFARM_TRY(const JobSpec spec, wire::parse(request->spec()));
    RADFARM_TRY(const JobStatus status, scheduler_.create(request->request_id(), spec));
    wire::encode(status, *response);
    return {};
  });
}

grpc::ServerUnaryReactor* RenderJobsService::GetRenderJob(grpc::CallbackServerContext* context,
                                                          const v1::GetRenderJobRequest* request,
                                                          v1::RenderJob* response) {
  return rpc::reply(context, [&]() -> Status {
    RADFARM_TRY(const Scheduler::Described job, scheduler_.get(request->id()));
    wire::encode(job.status, *response);
    wire::encode(job.spec, *response->mutable_spec());
    return {};
  });
}

grpc::ServerUnaryReactor* RenderJobsService::ListRenderJobs(grpc::CallbackServerContext* context,
                                                            const v1::ListRenderJobsRequest* request,
                                                            v1::ListRenderJobsResponse* response) {
  return rpc::reply(context, [&]() -> Status {
    RADFARM_TRY(const Scheduler::Page page, scheduler_.list(request->page_size(), request->page_token()));
    for (const JobStatus& status : page.jobs) wire::encode(status, *response->add_jobs());
    response->set_next_page_token(page.next_token);
    return {};
  });
}

grpc::ServerUnaryReactor* RenderJobsService::CancelRenderJob(grpc::CallbackServerContext* context,
                                                             const v1::CancelRenderJobRequest* request,
                                                             v1::RenderJob* response) {
  return rpc::reply(context, [&]() -> Status {
    RADFARM_TRY(const JobStatus status, scheduler_.cancel(request->id()));
    wire::encode(status, *response);
    return {};
  });
}

grpc::ServerUnaryReactor* RenderJobsService::ExtendRenderJob(grpc::CallbackServerContext* context,
                                                             const v1::ExtendRenderJobRequest* request,
                                                             v1::RenderJob* response) {
  return rpc::reply(context, [&]() -> Status {
    RADFARM_TRY(const JobStatus status, scheduler_.extend(request->id(), request->error()));
    wire::encode(status, *response);
    return {};
  });
}

grpc::ServerWriteReactor<v1::RenderJob>* RenderJobsService::WatchRenderJob(grpc::CallbackServerContext*,
                                                                           const v1::WatchRenderJobRequest* request) {
  return new WatchReactor(scheduler_, request->id());
}

}  // namespace radfarm
