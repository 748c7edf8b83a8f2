#include "cli/follow.h"

#include <thread>

namespace radfarm::cli {
namespace {

constexpr std::chrono::milliseconds kTick{500};  // the time shown goes on while the job says nothing

/// Feeds a job's states into `events` from a thread of its own, while it lives.
class Watch {
 public:
  Watch(FarmClient& client, const std::string& id, Events& events)
      : client_(client), events_(events), thread_([&client, id, &events] {
          const Status ended = client.watch(id, [&](const JobStatus& status) { events.job(status); });
          if (!ended) events.lose(ended.error());
        }) {}
  ~Watch() {
    client_.stop_watching();
    thread_.join();
    events_.forget_job();  // the end of the watch too
  }
  Watch(const Watch&) = delete;
  Watch& operator=(const Watch&) = delete;

 private:
  FarmClient& client_;
  Events& events_;
  std::thread thread_;
};

}  // namespace

Result<JobStatus> follow(FarmClient& client, const std::string& id, const FollowOptions& options, Events& events,
                         Progress& progress) {
  const Watch watch(client, id, events);
  std::optional<JobStatus> last;
  for (;;) {
    const auto now = std::chrono::steady_clock::now();
    const bool is_final = options.deadline && *options.deadline <= now + kTick;
    const Events::Seen seen = events.wait(is_final ? *options.deadline : now + kTick);
    if (seen.job) last = seen.job;
    if (last) progress.show(*last);
    if (last && is_terminal(last->state)) return *last;
    if (seen.interrupted) {
      if (options.on_interrupt == FollowOptions::OnInterrupt::kCancelJob) (void)client.cancel(id);
      return fail(Code::kCancelled, "cancelled");
    }
    if (seen.child_ended && options.check_children) RADFARM_TRY_STATUS(options.check_children());
    if (seen.lost) return tl::unexpected(*seen.lost);
    if (seen.timed_out && is_final) {
      return fail(Code::kDeadlineExceeded, "job " + id + " has not finished in time; it goes on");
    }
  }
}

}  // namespace radfarm::cli
