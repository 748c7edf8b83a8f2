#pragma once

#include <memory>
#include <string>

#include <grpcpp/grpcpp.h>

#include "base/status.h"

namespace radfarm::rpc {

/// A channel to `address` (host:port), with keepalive, message limits and quick reconnects. Connects when first used.
std::shared_ptr<grpc::Channel> open_channel(const std::string& address);

/// INVALID_ARGUMENT unless `address` is host:port with a port from 0 to 65535; `flag` names the culprit in the message.
Status check_address(const std::string& address, const std::string& flag);

/// The same settings for the serving side.
void configure_server(grpc::ServerBuilder& builder);

}  // namespace radfarm::rpc
