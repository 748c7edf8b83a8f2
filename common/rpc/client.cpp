#include "rpc/client.h"

#include "rpc/reply.h"

namespace radfarm::rpc {

Status call(std::chrono::milliseconds deadline, const std::function<grpc::Status(grpc::ClientContext&)>& body) {
  grpc::ClientContext context;
  context.set_deadline(std::chrono::system_clock::now() + deadline);
  return from_grpc(body(context));
}

}  // namespace radfarm::rpc
