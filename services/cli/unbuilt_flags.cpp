#include "cli/unbuilt_flags.h"

#include <array>

namespace radfarm::cli {
namespace {

struct Unbuilt {
  const char* flag;
  const char* value;
  const char* instead;  // what works today
};
constexpr std::array kUnbuilt = {
    Unbuilt{"--criterion", "CC", "use uniform"},
    Unbuilt{"--criterion", "VAR", "use uniform"},
    Unbuilt{"--criterion", "KL", "use uniform"},
    Unbuilt{"--criterion", "CS", "use uniform"},
    Unbuilt{"--criterion", "HE", "use uniform"},
    Unbuilt{"--criterion", "SRKL", "use uniform"},
    Unbuilt{"--criterion", "SRCS", "use uniform"},
    Unbuilt{"--criterion", "SRHE", "use uniform"},
};

}  // namespace

Status check_built(const std::string& flag, const std::string& value) {
  for (const Unbuilt& unbuilt : kUnbuilt) {
    if (flag != unbuilt.flag || value != unbuilt.value) continue;
    return fail(Code::kUnimplemented, flag + " " + value + " is not built yet: " + unbuilt.instead);
  }
  if (flag == "--criterion" && value != "uniform") {
    return fail(Code::kInvalidArgument,
                "--criterion: '" + value + "' is not one of uniform, CC, VAR, KL, CS, HE, SRKL, SRCS, SRHE");
  }
  return {};
}

}  // namespace radfarm::cli
