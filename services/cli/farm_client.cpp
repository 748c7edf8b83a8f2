#include "cli/farm_client.h"

#include "rpc/channel.h"
#include "rpc/client.h"
#include "rpc/reply.h"
#include "rpc/retry.h"
#include "rpc/wire.h"

namespace radfarm::cli {
namespace {

constexpr std::chrono::seconds kDeadline{30};
// A watch lasts as long as the job; the stream is opened anew after this.
constexpr std::chrono::hours kWatchDeadline{1};

template <typename Call>
Status repeat(Call&& body) {
  return rpc::with_retries({}, [&] { return rpc::call(kDeadline, body); });
}

}  // namespace

FarmClient::FarmClient(const std::string& address)
    : blobs_(rpc::open_channel(address)), stub_(v1::RenderJobs::NewStub(rpc::open_channel(address))) {}

Result<JobStatus> FarmClient::create(const std::string& request_id, const JobSpec& spec) {
  v1::CreateRenderJobRequest request;
  v1::RenderJob response;
  request.set_request_id(request_id);
  wire::encode(spec, *request.mutable_spec());
  RADFARM_TRY_STATUS(
      repeat([&](grpc::ClientContext& context) { return stub_->CreateRenderJob(&context, request, &response); }));
  return wire::parse(response);
}

Result<JobStatus> FarmClient::get(const std::string& id) {
  v1::GetRenderJobRequest request;
  v1::RenderJob response;
  request.set_id(id);
  RADFARM_TRY_STATUS(
      repeat([&](grpc::ClientContext& context) { return stub_->GetRenderJob(&context, request, &response); }));
  return wire::parse(response);
}

Result<std::vector<JobStatus>> FarmClient::list() {
  std::vector<JobStatus> jobs;
  v1::ListRenderJobsRequest request;
  do {
    v1::ListRenderJobsResponse response;
    RADFARM_TRY_STATUS(
        repeat([&](grpc::ClientContext& context) { return stub_->ListRenderJobs(&context, request, &response); }));
    for (const v1::RenderJob& message : response.jobs()) {
      RADFARM_TRY(JobStatus status, wire::parse(message));
      jobs.push_back(std::move(status));
    }
    request.set_page_token(response.next_page_token());
  } while (!request.page_token().empty());
  return jobs;
}

Result<JobStatus> FarmClient::cancel(const std::string& id) {
  v1::CancelRenderJobRequest request;
  v1::RenderJob response;
  request.set_id(id);
  RADFARM_TRY_STATUS(
      repeat([&](grpc::ClientContext& context) { return stub_->CancelRenderJob(&context, request, &response); }));
  return wire::parse(response);
}

Result<JobStatus> FarmClient::extend(const std::string& id, double error) {
  v1::ExtendRenderJobRequest request;
  v1::RenderJob response;
  request.set_id(id);
  request.set_error(error);
  RADFARM_TRY_STATUS(
      repeat([&](grpc::ClientContext& context) { return stub_->ExtendRenderJob(&context, request, &response); }));
  return wire::parse(response);
}

Status FarmClient::watch(const std::string& id, const std::function<void(const JobStatus&)>& on_status) {
  for (;;) {
    Status status = rpc::with_retries({}, [&] { return watch_once(id, on_status); });
    if (status || status.error().code != Code::kDeadlineExceeded) return status;
  }
}

Status FarmClient::watch_once(const std::string& id, const std::function<void(const JobStatus&)>& on_status) {
  return rpc::call(kWatchDeadline, [&](grpc::ClientContext& context) -> grpc::Status {
    {
      const std::lock_guard lock(mutex_);
      if (stopped_) return grpc::Status::CANCELLED;
      watching_ = &context;
    }
    v1::WatchRenderJobRequest request;
    request.set_id(id);
    const auto reader = stub_->WatchRenderJob(&context, request);
    for (v1::RenderJob message; reader->Read(&message);) {
      if (const Result<JobStatus> status = wire::parse(message)) on_status(*status);
    }
    const grpc::Status ended = reader->Finish();
    const std::lock_guard lock(mutex_);
    watching_ = nullptr;
    return ended;
  });
}

void FarmClient::stop_watching() {
  const std::lock_guard lock(mutex_);
  stopped_ = true;
  if (watching_ != nullptr) watching_->TryCancel();
}

}  // namespace radfarm::cli
