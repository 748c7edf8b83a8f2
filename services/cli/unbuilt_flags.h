#pragma once

#include <map>
#include <string>
#include <vector>

#include <CLI/CLI.hpp>

#include "base/status.h"

namespace radfarm::cli {

/// Flags of the contract (DESIGN section 9) whose feature does not exist yet. They are known, so that giving one is
/// answered with what works today and never silently ignored.
class UnbuiltFlags {
 public:
  void add_to(CLI::App& app);
  /// UNIMPLEMENTED when one was given.
  Status check() const;

 private:
  std::map<std::string, std::vector<std::string>> given_;  // by flag
};

/// UNIMPLEMENTED when `value` is one that the contract names for `flag` and that does not exist yet.
Status check_built(const std::string& flag, const std::string& value);

}  // namespace radfarm::cli
