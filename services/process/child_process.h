#pragma once

#include <chrono>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "base/status.h"

namespace radfarm {

/// One process of ours. It runs in a process group of its own (Ctrl-C reaches only us), with stdin from /dev/null, our
/// stderr, no descriptors but 0 to 2 and default signal handling. Ends with the object: killed and reaped.
class ChildProcess {
 public:
  struct Exit {
    bool by_signal = false;
    int number = 0;  // exit code or signal
    friend bool operator==(const Exit&, const Exit&) = default;
  };
  enum class Stdout { kCapture, kToStderr };

  /// NOT_FOUND or INTERNAL when the program cannot be started.
  static Result<ChildProcess> start(const std::filesystem::path& program, const std::vector<std::string>& arguments,
                                    Stdout output);
  ~ChildProcess();
  ChildProcess(ChildProcess&& other) noexcept;
  ChildProcess& operator=(ChildProcess&& other) noexcept;

  int pid() const { return pid_; }
  /// Harmless after the end. Thread-safe with wait().
  void signal(int number) const;
  /// How it ended, or nothing when it still runs after `limit`.
  std::optional<Exit> wait(std::chrono::milliseconds limit);
  /// What it prints, up to the first line break, its end, `limit` or 64 KiB. DEADLINE_EXCEEDED, or UNAVAILABLE when
  /// stdout closed before a whole line came. Requires: Stdout::kCapture.
  Result<std::string> read_line(std::chrono::milliseconds limit);

 private:
  ChildProcess(int pid, int pid_fd, int output) : pid_(pid), pid_fd_(pid_fd), output_(output) {}
  void end();

  int pid_ = -1;
  int pid_fd_ = -1;
  int output_ = -1;
  std::string read_;
  std::optional<Exit> exit_;
};

/// "was killed by signal 9 (Killed)" or "exited with code 3".
std::string to_string(const ChildProcess::Exit& exit);

/// The folder of the running executable: our programs are installed side by side.
std::filesystem::path executable_folder();

}  // namespace radfarm
