#pragma once

#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>

#include "base/status.h"
#include "rpc/messages.h"

namespace radfarm {

/// The child's side of a preparation: `radfarm-coordinator prepare-child` in a process of its own.

inline constexpr const char* kSceneFile = "scene.bin";
inline constexpr const char* kSolutionFile = "solution.bin";
inline constexpr const char* kViewFile = "view.bin";
inline constexpr int kOutOfMemoryExit = 9;

struct PrepareChildOptions {
  std::filesystem::path scene;
  std::filesystem::path request;
  std::filesystem::path out;
  std::filesystem::path solutions;  // solved light is kept there
  std::uint64_t solution_bytes = 0; // of all together; 0: none is kept
  std::uint64_t memory_bytes = 0;   // 0: no limit
  int parent_pid = 0;
  double error = 0;                 // relative, that a job's target is now; 0: as the request says
  double level = -1;                // of Effort; below 0: none
  bool by_paths = false;
  int threads = 1;
};

/// Prepares and writes the three files into `out`. Prints lines of JSON on stdout: {"phase", "done", "total"} for each new
/// phase and a few times a second, and {"code", "message"} when it fails. Returns the process's exit code.
int run_prepare_child(const PrepareChildOptions& options);

/// What a line says, or nothing when it is not such a line.
std::optional<Error> parse_child_error(const std::string& line);
std::optional<JobPhase> parse_child_phase(const std::string& line);

}  // namespace radfarm
