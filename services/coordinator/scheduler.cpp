#include "coordinator/scheduler.h"

#include <algorithm>
#include <chrono>
#include <set>
#include <utility>

#include <nlohmann/json.hpp>

#include "base/log.h"
#include "coordinator/tokens.h"
#include "frame/request.h"
#include "rpc/limits.h"

namespace radfarm {
namespace {

constexpr std::size_t kDigestsInMessage = 5;

Time now() { return std::chrono::steady_clock::now(); }

std::int64_t unix_seconds() {
  return std::chrono::duration_cast<std::chrono::seconds>(std::chrono::system_clock::now().time_since_epoch()).count();
}

/// What a request names must have come with the job: nothing from a client names a file of the coordinator's.
Status check_attached(const RenderRequest& request, const JobSpec& spec) {
  const auto check = [&](const std::string& name) -> Status {
    const bool is_there = std::any_of(spec.files.begin(), spec.files.end(), [&](const auto& f) { return f.path == name; });
    if (is_there) return {};
    return fail(Code::kInvalidArgument, "spec.render_request_json: '" + name + "' is not one of spec.files");
  };
  if (!request.env.empty() && !request.env.starts_with("sky:")) RADFARM_TRY_STATUS(check(request.env));
  for (const auto& [light, file] : request.ies) RADFARM_TRY_STATUS(check(file));
  return {};
}

Result<RenderRequest> request_of(const JobSpec& spec) {
  const std::string& text = spec.render_request_json;
  const nlohmann::json json = nlohmann::json::parse(text, nullptr, /*allow_exceptions=*/false);
  if (json.is_discarded()) return fail(Code::kInvalidArgument, "spec.render_request_json: is not JSON");
  return render_request_from_json(json);
}

Result<RenderRequest> checked_request(const JobSpec& spec) {
  RADFARM_TRY(RenderRequest request, request_of(spec));
  RADFARM_TRY_STATUS(check_attached(request, spec));
  RADFARM_TRY_STATUS(validate(request));
  return request;
}

Status check_stored(const JobSpec& spec, const BlobStore& blobs) {
  std::set<std::string> missing;
  for (const SceneFile& file : spec.files) {
    if (!blobs.contains(file.blob.digest)) missing.insert(file.blob.digest);
  }
  if (missing.empty()) return {};
  std::string list;
  std::size_t named = 0;
  for (const std::string& digest : missing) {
    if (named++ < kDigestsInMessage) list += " " + digest;
  }
  return fail(Code::kFailedPrecondition, std::to_string(missing.size()) + " files are not stored:" + list);
}

}  // namespace

Scheduler::Scheduler(const BlobStore& blobs, SchedulerOptions options)
    : blobs_(blobs),
      options_(std::move(options)),
      workers_(options_.workers),
      executor_(options_.stage_threads),
      timer_([this] { run_timer(); }) {}

Scheduler::~Scheduler() {
  stop();
  timer_.join();
}

void Scheduler::stop() {
  const std::lock_guard lock(mutex_);
  if (std::exchange(stopping_, true)) return;
  const tl::unexpected<Error> stopping = fail(Code::kUnavailable, "the coordinator is stopping");
  for (Waiter& waiter : waiters_) waiter.wait.answer(stopping);
  waiters_.clear();
  for (const auto& entry : jobs_) {
    entry->stop.request_stop();
    for (const auto& [id, callback] : entry->watchers) callback(stopping);
    entry->watchers.clear();
  }
  deadline_changed_.notify_all();
}

Result<JobStatus> Scheduler::create(const std::string& request_id, const JobSpec& spec) {
  if (request_id.empty() || request_id.size() > limits::kIdBytes) {
    return fail(Code::kInvalidArgument, "request_id: must have 1 to 100 bytes");
  }
  RADFARM_TRY(const RenderRequest request, checked_request(spec));
  const std::lock_guard lock(mutex_);
  if (stopping_) return fail(Code::kUnavailable, "the coordinator is stopping");
  if (const Entry* const known = find_request(request_id)) {
    if (known->job.spec() == spec) return status_of(*known);
    return fail(Code::kAlreadyExists, "request_id " + request_id + " was used for another job; choose a new one");
  }
  RADFARM_TRY_STATUS(check_stored(spec, blobs_));
  const auto unfinished = static_cast<std::size_t>(
      std::count_if(jobs_.begin(), jobs_.end(), [](const auto& entry) { return !is_terminal(entry->job.state()); }));
  if (unfinished >= options_.unfinished_jobs) {
    return fail(Code::kResourceExhausted, std::to_string(unfinished) + " jobs are unfinished; try again later");
  }
  const std::string id = random_token().substr(0, 12);
  jobs_.push_back(std::make_unique<Entry>(Job(id, spec, unix_seconds(), options_.leases, target_of(request)), request_id));
  forget_old();
  spdlog::info("job {} '{}' created", id, spec.display_name);
  executor_.post([this, id] { run_preparation(id); });
  return status_of(*jobs_.back());
}

Result<Scheduler::Described> Scheduler::get(const std::string& id) {
  const std::lock_guard lock(mutex_);
  RADFARM_TRY(Entry* const entry, find(id));
  return Described{status_of(*entry), entry->job.spec()};
}

Result<Scheduler::Page> Scheduler::list(std::uint32_t page_size, const std::string& page_token) {
  const std::lock_guard lock(mutex_);
  auto next = jobs_.begin();
  if (!page_token.empty()) {
    const auto is_last = [&](const auto& entry) { return entry->job.id() == page_token; };
    next = std::find_if(jobs_.begin(), jobs_.end(), is_last);
    if (next == jobs_.end()) return fail(Code::kInvalidArgument, "page_token: unknown; start again without one");
    ++next;
  }
  Page page;
  const std::size_t size = page_size == 0 ? 100 : std::min(page_size, 1000U);
  for (; next != jobs_.end() && page.jobs.size() < size; ++next) page.jobs.push_back(status_of(**next));
  if (next != jobs_.end()) page.next_token = page.jobs.back().id;
  return page;
}

Result<JobStatus> Scheduler::cancel(const std::string& id) {
  const std::lock_guard lock(mutex_);
  RADFARM_TRY(Entry* const entry, find(id));
  RADFARM_TRY_STATUS(entry->job.cancel());
  entry->stop.request_stop();
  changed(*entry);
  return status_of(*entry);
}

Result<JobStatus> Scheduler::extend(const std::string& id, double error) {
  const std::lock_guard lock(mutex_);
  if (stopping_) return fail(Code::kUnavailable, "the coordinator is stopping");
  RADFARM_TRY(Entry* const entry, find(id));
  RADFARM_TRY(RenderRequest request, request_of(entry->job.spec()));
  request.error = error;
  request.time.reset();
  request.audit = true;
  RADFARM_TRY_STATUS(validate(request));
  RADFARM_TRY(const bool is_extended, entry->job.extend(target_of(request)));
  if (!is_extended) return status_of(*entry);
  spdlog::info("job {} extended to a relative error of {}", id, error);
  executor_.post([this, id] { run_assembly(id); });
  changed(*entry);
  return status_of(*entry);
}

Result<Scheduler::WatchId> Scheduler::watch(const std::string& id, WatchCallback callback) {
  const std::lock_guard lock(mutex_);
  if (stopping_) return fail(Code::kUnavailable, "the coordinator is stopping");
  RADFARM_TRY(Entry* const entry, find(id));
  callback(status_of(*entry));
  entry->watchers.emplace(next_watch_, std::move(callback));
  return next_watch_++;
}

void Scheduler::unwatch(const std::string& id, WatchId watch) {
  const std::lock_guard lock(mutex_);
  if (const Result<Entry*> entry = find(id)) (*entry)->watchers.erase(watch);
}

Result<Scheduler::Entry*> Scheduler::find(const std::string& id) {
  const auto found = std::find_if(jobs_.begin(), jobs_.end(), [&](const auto& entry) { return entry->job.id() == id; });
  if (found == jobs_.end()) return fail(Code::kNotFound, "there is no job " + id.substr(0, 100));
  return found->get();
}

Scheduler::Entry* Scheduler::find_request(const std::string& request_id) {
  const auto found =
      std::find_if(jobs_.begin(), jobs_.end(), [&](const auto& entry) { return entry->request_id == request_id; });
  return found == jobs_.end() ? nullptr : found->get();
}

JobStatus Scheduler::status_of(const Entry& entry) const {
  JobStatus status = entry.job.status();
  const bool idle = status.state == JobState::kRendering && status.progress.tasks_leased == 0;
  if (idle && workers_.count() == 0) status.progress.waiting_for = "no worker is registered";
  return status;
}

void Scheduler::changed(Entry& entry) {
  const Result<JobStatus> status = status_of(entry);
  for (const auto& [id, callback] : entry.watchers) callback(status);
  if (is_terminal(status->state)) spdlog::info("job {} {}", status->id, to_string(status->state));
}

void Scheduler::forget_old() {
  while (jobs_.size() > options_.finished_jobs && is_terminal(jobs_.front()->job.state()) &&
         jobs_.front()->watchers.empty()) {
    jobs_.pop_front();
  }
}

/// Brings the end of a long step back: the cancel that came meanwhile wins over whatever the step found.
template <typename Step>
void Scheduler::settle(const std::string& id, const Step& step) {
  const std::lock_guard lock(mutex_);
  const Result<Entry*> found = find(id);
  if (!found || is_terminal((*found)->job.state())) return;
  Entry& entry = **found;
  if (entry.job.state() == JobState::kCancelling) {
    entry.job.confirm_cancel();
  } else {
    step(entry);
  }
  changed(entry);
}

std::optional<ToPrepare> Scheduler::start_preparation(const std::string& id, std::stop_token& stop) {
  const std::lock_guard lock(mutex_);
  const Result<Entry*> entry = find(id);
  if (stopping_ || !entry) return std::nullopt;
  Job& job = (*entry)->job;
  const bool is_anew = job.state() == JobState::kPreparing;
  if (!is_anew && job.state() != JobState::kQueued) return std::nullopt;
  if (!is_anew) {
    (*entry)->preparing_since = now();
    job.start_preparing();
    changed(**entry);
  }
  stop = (*entry)->stop.get_token();
  ToPrepare preparation{job.spec(), job.target(), job.effort(), {}};
  preparation.effort.threads = std::max(workers_.threads(), options_.expected_threads);
  if (is_anew) preparation.round = job.round();
  return preparation;
}

void Scheduler::run_preparation(const std::string& id) {
  std::stop_token stop;
  const std::optional<ToPrepare> job = start_preparation(id, stop);
  if (!job) return;
  auto prepared = prepare_job(*job, blobs_, options_.prepare, stop, [&](const JobPhase& phase) {
    const std::lock_guard lock(mutex_);
    const Result<Entry*> entry = find(id);
    if (entry && (*entry)->job.prepare_progress(phase)) changed(**entry);
  });
  settle(id, [&](Entry& entry) {
    if (!prepared) {
      spdlog::warn("job {}: {}: {}", id, to_string(prepared.error().reason), prepared.error().error.message);
      return entry.job.fail(std::move(prepared.error()));
    }
    entry.job.start_rendering(std::move(*prepared));
    entry.rendering_since = now();
    serve_waiters(now());
    assemble_if_done(entry);
  });
}

void Scheduler::assemble_if_done(Entry& entry) {
  if (entry.job.state() != JobState::kRendering || !entry.job.all_committed()) return;
  entry.job.start_assembling();
  entry.round_seconds = std::chrono::duration<double>(now() - entry.rendering_since).count();
  entry.rendered_seconds += entry.round_seconds;
  executor_.post([this, id = entry.job.id()] { run_assembly(id); });
}

void Scheduler::fail_if_broken(Entry& entry) {
  const std::optional<JobFailure> verdict = entry.job.verdict();
  if (!verdict || is_terminal(entry.job.state())) return;
  spdlog::warn("job {}: {}: {}", entry.job.id(), to_string(verdict->reason), verdict->error.message);
  entry.job.fail(*verdict);
}

std::optional<ToAssemble> Scheduler::start_assembly(const std::string& id) {
  const std::lock_guard lock(mutex_);
  const Result<Entry*> entry = find(id);
  if (stopping_ || !entry || (*entry)->job.state() != JobState::kAssembling) return std::nullopt;
  const Job& job = (*entry)->job;
  ToAssemble assembly;
  assembly.spec = job.spec();
  assembly.inputs = job.inputs();
  assembly.round = job.round();
  assembly.kind = job.round_kind();
  assembly.results = job.results();
  assembly.rounds = job.rounds();
  // One that is extended is assembled again.
  if (!assembly.rounds.empty() && assembly.rounds.back().round.number == job.round().number) assembly.rounds.pop_back();
  assembly.target = job.target();
  assembly.rounds_left = job.rounds_left();
  assembly.light_cpu_seconds = job.light_cpu_seconds();
  assembly.audit_cpu_seconds = job.audit_cpu_seconds();
  assembly.wall_seconds = (*entry)->round_seconds;
  assembly.elapsed_seconds = std::chrono::duration<double>(now() - (*entry)->preparing_since).count();
  assembly.farm.workers = job.worker_facts();
  assembly.farm.tasks_wall_seconds = (*entry)->rendered_seconds;
  return assembly;
}

void Scheduler::go_on(Entry& entry, AssembledJob assembled) {
  const NextRound& next = assembled.next;
  entry.job.record(std::move(assembled.figures));
  if (next.step == NextRound::Step::kStop) {
    return entry.job.succeed(std::move(assembled.artifacts), next.target_met.has_value() && !*next.target_met);
  }
  spdlog::info("job {}: round {}, {}", entry.job.id(), next.round.number + 1,
               next.step == NextRound::Step::kNewLight ? "new light" : "more samples");
  if (next.step == NextRound::Step::kNewLight) {
    entry.job.prepare_anew(next.round, next.effort);
    return executor_.post([this, id = entry.job.id()] { run_preparation(id); });
  }
  entry.job.go_on(next.round, std::move(assembled.tasks));
  entry.rendering_since = now();
  serve_waiters(now());
  assemble_if_done(entry);
}

void Scheduler::run_assembly(const std::string& id) {
  const std::optional<ToAssemble> job = start_assembly(id);
  if (!job) return;
  auto assembled = assemble_job(*job, blobs_);
  settle(id, [&](Entry& entry) {
    if (assembled) return go_on(entry, std::move(*assembled));
    spdlog::warn("job {}: {}", id, assembled.error().error.message);
    entry.job.fail(std::move(assembled.error()));
  });
}

}  // namespace radfarm
