#include "process/exit_code.h"

#include <cstdio>
#include <string>

namespace radfarm {

ExitCode exit_code_for(Code code) {
  switch (code) {
    case Code::kInvalidArgument:
    case Code::kNotFound:
    case Code::kAlreadyExists:
    case Code::kPermissionDenied:
    case Code::kResourceExhausted:
    case Code::kFailedPrecondition:
    case Code::kOutOfRange:
    case Code::kUnimplemented:
    case Code::kDataLoss:
      return ExitCode::kInputFailed;
    case Code::kCancelled:
    case Code::kAborted:
      return ExitCode::kCancelled;
    case Code::kDeadlineExceeded:
      return ExitCode::kTimeout;
    case Code::kUnauthenticated:
      return ExitCode::kAuthentication;
    case Code::kUnavailable:
      return ExitCode::kUnreachable;
    case Code::kUnknown:
    case Code::kInternal:
      return ExitCode::kInternal;
  }
  return ExitCode::kInternal;
}

ExitCode report_error(const char* program, const Error& error) {
  std::string line;
  for (const char c : error.message) {
    if (static_cast<unsigned char>(c) >= 0x20 && c != 0x7f) {
      line += c;
    } else {
      line += ' ';
    }
  }
  std::fprintf(stderr, "%s: %s\n", program, line.c_str());
  return exit_code_for(error.code);
}

}  // namespace radfarm
