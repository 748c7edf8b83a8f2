#include "cli/unbuilt_flags.h"

#include <array>

namespace radfarm::cli {
namespace {

struct Unbuilt {
  const char* flag;
  const char* value;    // "": the whole flag
  const char* instead;  // what works today
};
constexpr std::array kUnbuilt = {
    Unbuilt{"--error", "", "use --quality; the audit tells the error that it gave"},
    Unbuilt{"--time", "", "use --quality"},
    Unbuilt{"--criterion", "CC", "use uniform"},
    Unbuilt{"--criterion", "VAR", "use uniform"},
    Unbuilt{"--criterion", "KL", "use uniform"},
    Unbuilt{"--criterion", "CS", "use uniform"},
    Unbuilt{"--criterion", "HE", "use uniform"},
    Unbuilt{"--criterion", "SRKL", "use uniform"},
    Unbuilt{"--criterion", "SRCS", "use uniform"},
    Unbuilt{"--criterion", "SRHE", "use uniform"},
};

tl::unexpected<Error> refuse(const Unbuilt& unbuilt) {
  std::string what = unbuilt.flag;
  if (unbuilt.value[0] != '\0') what += std::string(" ") + unbuilt.value;
  return fail(Code::kUnimplemented, what + " is not built yet: " + unbuilt.instead);
}

}  // namespace

void UnbuiltFlags::add_to(CLI::App& app) {
  for (const Unbuilt& unbuilt : kUnbuilt) {
    if (unbuilt.value[0] != '\0') continue;
    app.add_option(unbuilt.flag, given_[unbuilt.flag])->expected(0, 1)->group("");
  }
}

Status UnbuiltFlags::check() const {
  for (const Unbuilt& unbuilt : kUnbuilt) {
    const auto found = given_.find(unbuilt.flag);
    if (found != given_.end() && !found->second.empty()) return refuse(unbuilt);
  }
  return {};
}

Status check_built(const std::string& flag, const std::string& value) {
  for (const Unbuilt& unbuilt : kUnbuilt) {
    if (flag == unbuilt.flag && value == unbuilt.value) return refuse(unbuilt);
  }
  if (flag == "--criterion" && value != "uniform") {
    return fail(Code::kInvalidArgument,
                "--criterion: '" + value + "' is not one of uniform, CC, VAR, KL, CS, HE, SRKL, SRCS, SRHE");
  }
  return {};
}

}  // namespace radfarm::cli
