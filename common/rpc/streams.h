#pragma once

#include <memory>
#include <utility>

#include <grpcpp/grpcpp.h>

#include "base/status.h"
#include "rpc/reply.h"

namespace radfarm::rpc {

/// A client-streaming handler's frame. `Sink` has `Status take(Request&&)` for each message and `Status finish()`,
/// called once after the last; either's error ends the call at once. The one `delete this` of reading streams is here.
template <typename Request, typename Sink>
class ReadStream final : public grpc::ServerReadReactor<Request> {
 public:
  explicit ReadStream(std::unique_ptr<Sink> sink) : sink_(std::move(sink)) { this->StartRead(&message_); }

  void OnReadDone(bool ok) override {
    const Status status = ok ? sink_->take(std::move(message_)) : sink_->finish();
    if (!ok || !status) return this->Finish(to_grpc(status));
    message_.Clear();
    this->StartRead(&message_);
  }
  void OnDone() override { delete this; }

 private:
  std::unique_ptr<Sink> sink_;
  Request message_;
};

/// A server-streaming handler's frame over a source that never waits: `Result<bool> next(Response&)` fills one message,
/// or says false after the last.
template <typename Response, typename Source>
class WriteStream final : public grpc::ServerWriteReactor<Response> {
 public:
  explicit WriteStream(Result<std::unique_ptr<Source>> source) {
    if (source) {
      source_ = std::move(*source);
      write_next();
    } else {
      this->Finish(to_grpc(source.error()));
    }
  }
  void OnWriteDone(bool ok) override {
    if (!ok) return this->Finish(grpc::Status::CANCELLED);
    write_next();
  }
  void OnDone() override { delete this; }

 private:
  void write_next() {
    message_.Clear();
    const Result<bool> more = source_->next(message_);
    if (!more) return this->Finish(to_grpc(more.error()));
    if (!*more) return this->Finish(grpc::Status::OK);
    this->StartWrite(&message_);
  }

  std::unique_ptr<Source> source_;
  Response message_;
};

}  // namespace radfarm::rpc
