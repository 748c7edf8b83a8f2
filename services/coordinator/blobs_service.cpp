#include "coordinator/blobs_service.h"

#include <algorithm>
#include <memory>
#include <set>
#include <span>
#include <utility>

#include "rpc/limits.h"
#include "rpc/reply.h"
#include "rpc/streams.h"
#include "rpc/wire.h"

namespace radfarm {
namespace {

/// The messages of one upload, in order: header, chunks.
class UploadSink {
 public:
  UploadSink(const BlobStore& blobs, BlobsService::Access access) : blobs_(blobs), access_(access) {}

  Status take(v1::UploadBlobRequest&& message) {
    if (access_ == BlobsService::Access::kReadOnly) return fail(Code::kPermissionDenied, "workers only read blobs");
    if ((upload_ == nullptr) != message.has_header()) return fail(Code::kInvalidArgument, kOrder);
    if (message.has_chunk()) return upload_->append(std::as_bytes(std::span(message.chunk())));
    RADFARM_TRY(upload_, blobs_.begin({message.header().digest(), message.header().size()}));
    return {};
  }
  Status finish() { return upload_ == nullptr ? Status(fail(Code::kInvalidArgument, kOrder)) : upload_->commit(); }

 private:
  static constexpr const char* kOrder = "an upload is one header, then chunks";
  const BlobStore& blobs_;
  BlobsService::Access access_;
  std::unique_ptr<BlobStore::Upload> upload_;
};

/// A stored blob, chunk by chunk.
class DownloadSource {
 public:
  explicit DownloadSource(MappedFile file) : file_(std::move(file)) {}

  Result<bool> next(v1::DownloadBlobResponse& message) {
    const auto left = file_.bytes().subspan(at_);
    const auto piece = left.first(std::min(left.size(), limits::kChunkBytes));
    message.set_chunk(piece.data(), piece.size());
    at_ += piece.size();
    return !piece.empty();
  }

 private:
  MappedFile file_;
  std::size_t at_ = 0;
};

Result<std::unique_ptr<DownloadSource>> open_download(const BlobStore& blobs, const std::string& digest) {
  RADFARM_TRY(MappedFile file, blobs.read(digest));
  return std::make_unique<DownloadSource>(std::move(file));
}

}  // namespace

grpc::ServerUnaryReactor* BlobsService::FindMissingBlobs(grpc::CallbackServerContext* context,
                                                         const v1::FindMissingBlobsRequest* request,
                                                         v1::FindMissingBlobsResponse* response) {
  return rpc::reply(context, [&]() -> Status {
    if (static_cast<std::size_t>(request->digests_size()) > limits::kSceneFiles) {
      return fail(Code::kInvalidArgument, "digests: more than " + std::to_string(limits::kSceneFiles));
    }
    std::set<std::string> seen;
    for (const std::string& digest : request->digests()) {
      RADFARM_TRY_STATUS(wire::check_digest(digest, "digests"));
      if (seen.insert(digest).second && !blobs_.contains(digest)) response->add_missing_digests(digest);
    }
    return {};
  });
}

grpc::ServerReadReactor<v1::UploadBlobRequest>* BlobsService::UploadBlob(grpc::CallbackServerContext*,
                                                                         v1::UploadBlobResponse*) {
  return new rpc::ReadStream<v1::UploadBlobRequest, UploadSink>(std::make_unique<UploadSink>(blobs_, access_));
}

grpc::ServerWriteReactor<v1::DownloadBlobResponse>* BlobsService::DownloadBlob(grpc::CallbackServerContext*,
                                                                               const v1::DownloadBlobRequest* request) {
  return new rpc::WriteStream<v1::DownloadBlobResponse, DownloadSource>(open_download(blobs_, request->digest()));
}

}  // namespace radfarm
