#include "rpc/blob_client.h"

#include <algorithm>
#include <chrono>

#include "base/digest.h"
#include "rpc/client.h"
#include "rpc/limits.h"
#include "rpc/reply.h"

namespace radfarm::rpc {
namespace {

constexpr std::size_t kDigestsPerCall = 1000;
constexpr std::size_t kDigestPiece = std::size_t{64} << 20U;  // bytes between looks at the progress: 0.1 s or so

std::chrono::milliseconds time_for(std::uint64_t bytes) {
  return std::chrono::seconds(30) + std::chrono::seconds(bytes >> 20U);
}

}  // namespace

BlobClient::BlobClient(const std::shared_ptr<grpc::Channel>& channel, RetryPolicy policy)
    : stub_(v1::Blobs::NewStub(channel)), policy_(policy) {}

Result<std::vector<std::string>> BlobClient::find_missing(const std::vector<std::string>& digests) const {
  std::vector<std::string> missing;
  for (std::size_t begin = 0; begin < digests.size(); begin += kDigestsPerCall) {
    v1::FindMissingBlobsRequest request;
    for (std::size_t i = begin; i < std::min(begin + kDigestsPerCall, digests.size()); ++i) {
      request.add_digests(digests[i]);
    }
    v1::FindMissingBlobsResponse response;
    RADFARM_TRY_STATUS(with_retries(policy_, [&] {
      return call(std::chrono::seconds(30),
                  [&](grpc::ClientContext& context) { return stub_->FindMissingBlobs(&context, request, &response); });
    }));
    missing.insert(missing.end(), response.missing_digests().begin(), response.missing_digests().end());
  }
  return missing;
}

Status BlobClient::upload(const BlobRef& blob, std::span<const std::byte> bytes, const Progress& progress) const {
  return with_retries(policy_, [&] {
    return call(time_for(bytes.size()), [&](grpc::ClientContext& context) {
      v1::UploadBlobRequest header;
      header.mutable_header()->set_digest(blob.digest);
      header.mutable_header()->set_size(blob.size);
      v1::UploadBlobResponse response;
      const auto writer = stub_->UploadBlob(&context, &response);
      return write_chunked(*writer, header, bytes, [&](std::size_t sent) {
        progress.report("upload, MiB", sent >> 20U, bytes.size() >> 20U);
        if (progress.is_cancelled()) context.TryCancel();
      });
    });
  });
}

Result<std::vector<std::byte>> BlobClient::download(const std::string& digest, std::uint64_t max_bytes,
                                                    const Progress& progress) const {
  std::vector<std::byte> bytes;
  const auto receive = [&](grpc::ClientContext& context) -> grpc::Status {
    bytes.clear();
    v1::DownloadBlobRequest request;
    request.set_digest(digest);
    v1::DownloadBlobResponse response;
    const auto reader = stub_->DownloadBlob(&context, request);
    while (reader->Read(&response)) {
      const auto chunk = std::as_bytes(std::span(response.chunk()));
      if (bytes.size() + chunk.size() > max_bytes) {
        context.TryCancel();
        (void)reader->Finish();
        return {grpc::StatusCode::RESOURCE_EXHAUSTED,
                "blob " + digest + " is larger than " + std::to_string(max_bytes) + " bytes"};
      }
      bytes.insert(bytes.end(), chunk.begin(), chunk.end());
      progress.report("download, MiB", bytes.size() >> 20U);
      if (progress.is_cancelled()) context.TryCancel();
    }
    return reader->Finish();
  };
  RADFARM_TRY_STATUS(with_retries(policy_, [&] { return call(time_for(limits::kSceneBytes), receive); }));
  if (sha256_hex(bytes) != digest) return fail(Code::kDataLoss, "blob " + digest + " arrived damaged");
  return bytes;
}

Result<BlobRef> blob_ref(std::span<const std::byte> bytes, const Progress& progress) {
  Sha256 digest;
  for (std::size_t at = 0; at < bytes.size(); at += kDigestPiece) {
    progress.report("read, MiB", at >> 20U, bytes.size() >> 20U);
    RADFARM_TRY_STATUS(progress.check());
    digest.update(bytes.subspan(at, std::min(kDigestPiece, bytes.size() - at)));
  }
  return BlobRef{digest.hex(), bytes.size()};
}

BlobRef blob_ref(std::span<const std::byte> bytes) { return {sha256_hex(bytes), bytes.size()}; }

}  // namespace radfarm::rpc
