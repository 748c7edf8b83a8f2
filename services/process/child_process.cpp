#include "process/child_process.h"

#include <fcntl.h>
#include <poll.h>
#include <spawn.h>
#include <sys/wait.h>
#include <unistd.h>
extern "C" {  // glibc 2.36 forgets to say so
#include <sys/pidfd.h>
}

#include <algorithm>
#include <array>
#include <cerrno>
#include <csignal>
#include <cstring>
#include <utility>

namespace radfarm {
namespace {

constexpr std::size_t kLongestLine = std::size_t{64} << 10U;
using Clock = std::chrono::steady_clock;

/// poll() for input on one descriptor until `deadline`; false when time is over.
bool readable(int fd, Clock::time_point deadline) {
  for (;;) {
    const auto left = std::chrono::ceil<std::chrono::milliseconds>(deadline - Clock::now()).count();
    pollfd watched{fd, POLLIN, 0};
    const int ready = ::poll(&watched, 1, static_cast<int>(std::clamp<long long>(left, 0, 1 << 30)));
    if (ready > 0) return true;
    if (ready == 0 && left <= 0) return false;
  }
}

/// Attributes and file actions of a spawn, released together.
class SpawnSettings {
 public:
  explicit SpawnSettings(int output) {
    posix_spawn_file_actions_init(&actions_);
    posix_spawn_file_actions_addopen(&actions_, 0, "/dev/null", O_RDONLY, 0);
    posix_spawn_file_actions_adddup2(&actions_, output, 1);
    posix_spawn_file_actions_addclosefrom_np(&actions_, 3);
    posix_spawnattr_init(&attributes_);
    sigset_t none;
    sigset_t all;
    sigemptyset(&none);
    sigfillset(&all);
    posix_spawnattr_setsigmask(&attributes_, &none);
    posix_spawnattr_setsigdefault(&attributes_, &all);
    posix_spawnattr_setpgroup(&attributes_, 0);
    posix_spawnattr_setflags(&attributes_, POSIX_SPAWN_SETSIGMASK | POSIX_SPAWN_SETSIGDEF | POSIX_SPAWN_SETPGROUP);
  }
  ~SpawnSettings() {
    posix_spawn_file_actions_destroy(&actions_);
    posix_spawnattr_destroy(&attributes_);
  }
  SpawnSettings(const SpawnSettings&) = delete;
  SpawnSettings& operator=(const SpawnSettings&) = delete;

  int spawn(int& pid, const std::string& program, char* const* arguments) const {
    return posix_spawn(&pid, program.c_str(), &actions_, &attributes_, arguments, environ);
  }

 private:
  posix_spawn_file_actions_t actions_{};
  posix_spawnattr_t attributes_{};
};

}  // namespace

Result<ChildProcess> ChildProcess::start(const std::filesystem::path& program,
                                         const std::vector<std::string>& arguments, Stdout output) {
  std::vector<std::string> words = arguments;
  words.insert(words.begin(), program.string());
  std::vector<char*> pointers;
  for (std::string& word : words) pointers.push_back(word.data());
  pointers.push_back(nullptr);

  std::array<int, 2> pipe{-1, -1};
  if (output == Stdout::kCapture && ::pipe2(pipe.data(), O_CLOEXEC) != 0) {
    return fail(Code::kResourceExhausted, std::string("cannot make a pipe: ") + std::strerror(errno));
  }
  int pid = -1;
  const int error =
      SpawnSettings(output == Stdout::kCapture ? pipe[1] : STDERR_FILENO).spawn(pid, program.string(), pointers.data());
  if (pipe[1] >= 0) ::close(pipe[1]);
  if (error != 0) {
    if (pipe[0] >= 0) ::close(pipe[0]);
    return fail(error == ENOENT ? Code::kNotFound : Code::kInternal,
                program.string() + ": cannot start: " + std::strerror(error));
  }
  const int pid_fd = ::pidfd_open(pid, 0);
  if (pid_fd < 0) {
    ::kill(pid, SIGKILL);
    ::waitpid(pid, nullptr, 0);
    if (pipe[0] >= 0) ::close(pipe[0]);
    return fail(Code::kResourceExhausted, program.string() + ": cannot watch the new process: " + std::strerror(errno));
  }
  return ChildProcess(pid, pid_fd, pipe[0]);
}

ChildProcess::~ChildProcess() { end(); }

ChildProcess::ChildProcess(ChildProcess&& other) noexcept
    : pid_(std::exchange(other.pid_, -1)),
      pid_fd_(std::exchange(other.pid_fd_, -1)),
      output_(std::exchange(other.output_, -1)),
      read_(std::move(other.read_)),
      exit_(other.exit_) {}

ChildProcess& ChildProcess::operator=(ChildProcess&& other) noexcept {
  std::swap(pid_, other.pid_);
  std::swap(pid_fd_, other.pid_fd_);
  std::swap(output_, other.output_);
  std::swap(read_, other.read_);
  std::swap(exit_, other.exit_);
  return *this;
}

void ChildProcess::end() {
  if (pid_ < 0) return;
  signal(SIGKILL);
  (void)wait(std::chrono::hours(1));
  ::close(pid_fd_);
  if (output_ >= 0) ::close(output_);
  pid_ = -1;
}

void ChildProcess::signal(int number) const {
  if (pid_fd_ >= 0) (void)::pidfd_send_signal(pid_fd_, number, nullptr, 0);
}

std::optional<ChildProcess::Exit> ChildProcess::wait(std::chrono::milliseconds limit) {
  if (exit_) return exit_;
  if (pid_ < 0 || !readable(pid_fd_, Clock::now() + limit)) return std::nullopt;
  int status = 0;
  while (::waitpid(pid_, &status, 0) < 0 && errno == EINTR) {
  }
  exit_ = WIFSIGNALED(status) ? Exit{true, WTERMSIG(status)} : Exit{false, WEXITSTATUS(status)};
  return exit_;
}

Result<std::string> ChildProcess::read_line(std::chrono::milliseconds limit) {
  const auto deadline = Clock::now() + limit;
  for (;;) {
    if (const std::size_t end = read_.find('\n'); end != std::string::npos) {
      std::string line = read_.substr(0, end);
      read_.erase(0, end + 1);
      return line;
    }
    if (!readable(output_, deadline)) return fail(Code::kDeadlineExceeded, "process printed nothing in time");
    std::array<char, 4096> buffer{};
    const ssize_t got = ::read(output_, buffer.data(), buffer.size());
    if (got < 0 && errno == EINTR) continue;
    if (got <= 0 || read_.size() > kLongestLine) return fail(Code::kUnavailable, "process closed its output");
    read_.append(buffer.data(), static_cast<std::size_t>(got));
  }
}

std::string to_string(const ChildProcess::Exit& exit) {
  const std::string number = std::to_string(exit.number);
  if (exit.by_signal) return "was killed by signal " + number + " (" + ::strsignal(exit.number) + ")";
  return "exited with code " + number;
}

std::filesystem::path executable_folder() {
  std::error_code error;
  return std::filesystem::read_symlink("/proc/self/exe", error).parent_path();
}

}  // namespace radfarm
