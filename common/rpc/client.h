#pragma once

#include <algorithm>
#include <chrono>
#include <cstddef>
#include <functional>
#include <span>
#include <string>

#include <grpcpp/grpcpp.h>

#include "base/status.h"
#include "rpc/limits.h"

namespace radfarm::rpc {

/// One call with a deadline. `body` makes it; a fresh context each time, as gRPC demands.
Status call(std::chrono::milliseconds deadline, const std::function<grpc::Status(grpc::ClientContext&)>& body);

/// Sends `header`, then `bytes` in chunks, then waits for the answer. For messages with a `chunk` field.
template <typename Message>
grpc::Status write_chunked(grpc::ClientWriter<Message>& writer, const Message& header,
                           std::span<const std::byte> bytes, const std::function<void(std::size_t)>& before_chunk = {}) {
  bool open = writer.Write(header);
  Message message;
  for (std::size_t at = 0; open && at < bytes.size(); at += limits::kChunkBytes) {
    if (before_chunk) before_chunk(at);
    const auto piece = bytes.subspan(at, std::min(limits::kChunkBytes, bytes.size() - at));
    message.set_chunk(piece.data(), piece.size());
    open = writer.Write(message);
  }
  if (open) writer.WritesDone();
  return writer.Finish();  // a refused write means that the server has answered already: Finish tells what
}

}  // namespace radfarm::rpc
