#pragma once

#include <utility>

#include <grpcpp/grpcpp.h>

#include "base/status.h"

namespace radfarm::rpc {

/// Code is numbered as gRPC's, so both mappings are casts.
inline grpc::Status to_grpc(const Error& error) { return {static_cast<grpc::StatusCode>(error.code), error.message}; }
inline grpc::Status to_grpc(const Status& status) { return status ? grpc::Status::OK : to_grpc(status.error()); }

inline Status from_grpc(const grpc::Status& status) {
  if (status.ok()) return {};
  return fail(static_cast<Code>(status.error_code()), status.error_message());
}

/// A unary handler's frame: `body` decodes, decides, encodes, and its Status is the answer.
template <typename Body>
grpc::ServerUnaryReactor* reply(grpc::CallbackServerContext* context, Body&& body) {
  grpc::ServerUnaryReactor* const reactor = context->DefaultReactor();
  reactor->Finish(to_grpc(std::forward<Body>(body)()));
  return reactor;
}

}  // namespace radfarm::rpc
