#include "cli/solution_folder.h"

#include <unistd.h>

#include <cstdlib>
#include <system_error>

namespace radfarm::cli {
namespace {

namespace fs = std::filesystem;

/// A variable's value where it is an absolute path, as the XDG base directory specification asks; else empty.
fs::path path_from(const char* variable) {
  const char* const value = std::getenv(variable);
  const fs::path path = value == nullptr ? "" : value;
  return path.is_absolute() ? path : fs::path();
}

}  // namespace

fs::path solution_folder() {
  fs::path cache = path_from("XDG_CACHE_HOME");
  if (cache.empty()) {
    const fs::path home = path_from("HOME");
    if (home.empty()) return {};
    cache = home / ".cache";
  }
  const fs::path ours = cache / "radfarm", folder = ours / "solutions";
  std::error_code error;
  if (fs::create_directories(folder, error)) fs::permissions(ours, fs::perms::owner_all, error);
  if (error || ::access(folder.c_str(), R_OK | W_OK | X_OK) != 0) return {};
  return folder;
}

}  // namespace radfarm::cli
