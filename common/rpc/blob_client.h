#pragma once

#include <cstddef>
#include <functional>
#include <memory>
#include <span>
#include <string>
#include <vector>

#include "base/progress.h"
#include "base/status.h"
#include "radfarm/v1/blobs.grpc.pb.h"
#include "rpc/messages.h"
#include "rpc/retry.h"

namespace radfarm::rpc {

/// Blobs as a client sees it. Every call has a deadline (30 s and 1 s for each MiB), repeats on UNAVAILABLE, and
/// verifies digests; up- and downloads report MiB, and end as CANCELLED when their progress is cancelled. Thread-safe.
class BlobClient {
 public:
  explicit BlobClient(const std::shared_ptr<grpc::Channel>& channel, RetryPolicy policy = {});

  /// Those of `digests` that the server does not have.
  Result<std::vector<std::string>> find_missing(const std::vector<std::string>& digests) const;
  Status upload(const BlobRef& blob, std::span<const std::byte> bytes, const Progress& progress = {}) const;
  /// DATA_LOSS when the server sends other bytes than the digest promises; RESOURCE_EXHAUSTED above max_bytes.
  Result<std::vector<std::byte>> download(const std::string& digest, std::uint64_t max_bytes,
                                          const Progress& progress = {}) const;

 private:
  std::unique_ptr<v1::Blobs::Stub> stub_;
  RetryPolicy policy_;
};

BlobRef blob_ref(std::span<const std::byte> bytes);
/// The same of many bytes: reports MiB; CANCELLED when `progress` is.
Result<BlobRef> blob_ref(std::span<const std::byte> bytes, const Progress& progress);

}  // namespace radfarm::rpc
