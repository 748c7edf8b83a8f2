#pragma once

#include <string>
#include <string_view>
#include <utility>

#include <tl/expected.hpp>

namespace radfarm {

/// Why an operation failed. Numbered as google.rpc.Code, so an error crosses an RPC unchanged.
enum class Code {
  kCancelled = 1,
  kUnknown = 2,
  kInvalidArgument = 3,
  kDeadlineExceeded = 4,
  kNotFound = 5,
  kAlreadyExists = 6,
  kPermissionDenied = 7,
  kResourceExhausted = 8,
  kFailedPrecondition = 9,
  kAborted = 10,
  kOutOfRange = 11,
  kUnimplemented = 12,
  kInternal = 13,
  kUnavailable = 14,
  kDataLoss = 15,
  kUnauthenticated = 16,
};

/// A code for the program and one line for a person: what, where (file, JSON pointer or line), what would be right.
struct Error {
  Code code = Code::kUnknown;
  std::string message;
  friend bool operator==(const Error&, const Error&) = default;
};

template <typename T>
using Result = tl::expected<T, Error>;
using Status = tl::expected<void, Error>;

inline tl::unexpected<Error> fail(Code code, std::string message) {
  return tl::unexpected<Error>(Error{code, std::move(message)});
}

/// The same error with the place it happened in before its message, as "place: message".
inline tl::unexpected<Error> annotate(Error error, std::string_view place) {
  error.message = std::string(place) + ": " + error.message;
  return tl::unexpected<Error>(std::move(error));
}

}  // namespace radfarm

#define RADFARM_CONCAT_INNER(a, b) a##b
#define RADFARM_CONCAT(a, b) RADFARM_CONCAT_INNER(a, b)

/// RADFARM_TRY(const T x, f()): x is f()'s value, or the enclosing function returns f()'s error.
#define RADFARM_TRY(declaration, expression)                                                    \
  auto RADFARM_CONCAT(try_, __LINE__) = (expression);                                           \
  if (!RADFARM_CONCAT(try_, __LINE__)) return tl::unexpected(RADFARM_CONCAT(try_, __LINE__).error()); \
  declaration = std::move(*RADFARM_CONCAT(try_, __LINE__))

/// The same for a Status, which has no value.
#define RADFARM_TRY_STATUS(expression)                                                 \
  do {                                                                                 \
    if (auto status_ = (expression); !status_) return tl::unexpected(status_.error()); \
  } while (false)
