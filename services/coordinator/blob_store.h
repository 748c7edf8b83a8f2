#pragma once

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <memory>
#include <span>
#include <string>

#include "base/digest.h"
#include "base/file.h"
#include "base/status.h"
#include "rpc/messages.h"

namespace radfarm {

/// Blobs in a folder, one file each under the first two digits of its digest. A file appears whole or not at all, and
/// only under the digest of its bytes. Thread-safe, and safe for several processes on one folder.
class BlobStore {
 public:
  /// Makes the folder when needed and removes what interrupted uploads left behind.
  static Result<BlobStore> open(const std::filesystem::path& folder, std::uint64_t max_blob_bytes);

  /// A blob being written. Dropped without commit(), it leaves nothing behind.
  class Upload {
   public:
    ~Upload();
    Upload(const Upload&) = delete;
    Upload& operator=(const Upload&) = delete;
    /// DATA_LOSS when there are more bytes than promised; RESOURCE_EXHAUSTED when the disk is full.
    Status append(std::span<const std::byte> bytes);
    /// DATA_LOSS when the bytes are not those promised.
    Status commit();

   private:
    friend class BlobStore;
    Upload(BlobRef promised, std::filesystem::path target, std::filesystem::path temporary, int file);
    BlobRef promised_;
    std::filesystem::path target_, temporary_;
    int file_;
    std::uint64_t size_ = 0;
    Sha256 hash_;
  };

  bool contains(const std::string& digest) const;
  Result<std::unique_ptr<Upload>> begin(const BlobRef& promised) const;
  Result<BlobRef> put(std::span<const std::byte> bytes) const;
  /// NOT_FOUND, or INVALID_ARGUMENT when `digest` is no digest.
  Result<MappedFile> read(const std::string& digest) const;
  /// Makes `target` a file with the blob's bytes, without copying them where the file system allows.
  Status link_to(const std::string& digest, const std::filesystem::path& target) const;

 private:
  BlobStore(std::filesystem::path folder, std::uint64_t max_blob_bytes)
      : folder_(std::move(folder)), max_blob_bytes_(max_blob_bytes) {}
  std::filesystem::path path_of(const std::string& digest) const { return folder_ / digest.substr(0, 2) / digest; }

  std::filesystem::path folder_;
  std::uint64_t max_blob_bytes_;
};

}  // namespace radfarm
