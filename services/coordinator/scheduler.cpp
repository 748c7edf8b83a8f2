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

Status check_request(const JobSpec& spec) {
  const std::string& text = spec.render_request_json;
  const nlohmann::json json = nlohmann::json::parse(text, nullptr, /*allow_exceptions=*/false);
  if (json.is_discarded()) return fail(Code::kInvalidArgument, "spec.render_request_json: is not JSON");
  RADFARM_TRY(const RenderRequest request, render_request_from_json(json));
  RADFARM_TRY_STATUS(check_attached(request, spec));
  return validate(request);
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
  RADFARM_TRY_STATUS(check_request(spec));
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
  jobs_.push_back(std::make_unique<Entry>(Job(id, spec, unix_seconds(), options_.leases), request_id));
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

void Scheduler::run_preparation(const std::string& id) {
  JobSpec spec;
  std::stop_token stop;
  {
    const std::lock_guard lock(mutex_);
    const Result<Entry*> entry = find(id);
    if (stopping_ || !entry || (*entry)->job.state() != JobState::kQueued) return;
    (*entry)->job.start_preparing();
    changed(**entry);
    spec = (*entry)->job.spec();
    stop = (*entry)->stop.get_token();
  }
  auto prepared = prepare_job(spec, blobs_, options_.prepare, stop, [&](const JobPhase& phase) {
    const std::lock_guard lock(mutex_);
    const Result<Entry*> entry = find(id);
    if (entry && (*entry)->job.prepare_progress(phase)) changed(**entry);
  });
  settle(id, [&](Entry& entry) {
    if (!prepared) {
      spdlog::warn("job {}: {}: {}", id, to_string(prepared.error().reason), prepared.error().error.message);
      return entry.job.fail(std::move(prepared.error()));
    }
    entry.job.start_rendering(std::move(prepared->inputs), std::move(prepared->tasks));
    entry.rendering_since = now();
    serve_waiters(now());
    assemble_if_done(entry);
  });
}

void Scheduler::assemble_if_done(Entry& entry) {
  if (entry.job.state() != JobState::kRendering || !entry.job.all_committed()) return;
  entry.job.start_assembling();
  executor_.post([this, id = entry.job.id()] { run_assembly(id); });
}

void Scheduler::fail_if_broken(Entry& entry) {
  const std::optional<JobFailure> verdict = entry.job.verdict();
  if (!verdict || is_terminal(entry.job.state())) return;
  spdlog::warn("job {}: {}: {}", entry.job.id(), to_string(verdict->reason), verdict->error.message);
  entry.job.fail(*verdict);
}

void Scheduler::run_assembly(const std::string& id) {
  TaskInputs inputs;
  std::vector<std::vector<std::byte>> results;
  FarmFacts facts;
  {
    const std::lock_guard lock(mutex_);
    const Result<Entry*> entry = find(id);
    if (stopping_ || !entry || (*entry)->job.state() != JobState::kAssembling) return;
    inputs = (*entry)->job.inputs();
    results = (*entry)->job.take_results();
    facts.workers = (*entry)->job.worker_facts();
    facts.tasks_wall_seconds = std::chrono::duration<double>(now() - (*entry)->rendering_since).count();
  }
  auto artifacts = assemble_job(inputs, blobs_, results, facts);
  settle(id, [&](Entry& entry) {
    if (artifacts) return entry.job.succeed(std::move(*artifacts));
    spdlog::warn("job {}: {}", id, artifacts.error().error.message);
    entry.job.fail(std::move(artifacts.error()));
  });
}

}  // namespace radfarm
