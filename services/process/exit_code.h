#pragma once

#include "base/status.h"

namespace radfarm {

/// What our programs return to the shell (DESIGN section 9).
enum class ExitCode {
  kDone = 0,
  kInternal = 1,
  kUsage = 2,
  kInputFailed = 3,
  kCancelled = 4,
  kTargetNotMet = 5,
  kTimeout = 6,
  kAuthentication = 7,
  kUnreachable = 8,
  kVerifyMismatch = 9,
};

/// The exit code that an error deserves when nothing more is known.
ExitCode exit_code_for(Code code);

/// Prints "radfarm: <message>" as one line on stderr, line breaks and control characters made visible, and returns the
/// error's exit code.
ExitCode report_error(const char* program, const Error& error);

}  // namespace radfarm
