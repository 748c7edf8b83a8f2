#include "coordinator/blob_store.h"

#include <fcntl.h>
#include <sys/stat.h>
#include <unistd.h>

#include <cerrno>
#include <chrono>
#include <cstring>
#include <system_error>
#include <utility>

#include "rpc/wire.h"

namespace radfarm {
namespace {

namespace fs = std::filesystem;

constexpr std::chrono::hours kAbandonedAfter{24};  // a younger temporary file may belong to a running upload

tl::unexpected<Error> disk_error(const fs::path& path, const std::string& action, int number) {
  const Code code = number == ENOSPC || number == EDQUOT ? Code::kResourceExhausted : Code::kInternal;
  return fail(code, path.string() + ": cannot " + action + ": " + std::strerror(number));
}

void remove_abandoned(const fs::path& folder) {
  std::error_code ignored;  // a leftover that cannot be removed harms nobody
  for (const fs::directory_entry& entry : fs::directory_iterator(folder, ignored)) {
    const auto age = fs::file_time_type::clock::now() - entry.last_write_time(ignored);
    if (!ignored && age > kAbandonedAfter) fs::remove(entry.path(), ignored);
  }
}

}  // namespace

Result<BlobStore> BlobStore::open(const fs::path& folder, std::uint64_t max_blob_bytes) {
  std::error_code error;
  fs::create_directories(folder / "uploads", error);
  if (error) return fail(Code::kPermissionDenied, folder.string() + ": cannot create: " + error.message());
  remove_abandoned(folder / "uploads");
  return BlobStore(folder, max_blob_bytes);
}

bool BlobStore::contains(const std::string& digest) const {
  std::error_code ignored;
  return is_sha256_hex(digest) && fs::is_regular_file(path_of(digest), ignored);
}

Result<std::unique_ptr<BlobStore::Upload>> BlobStore::begin(const BlobRef& promised) const {
  RADFARM_TRY_STATUS(wire::check_digest(promised.digest, "digest"));
  if (promised.size > max_blob_bytes_) {
    return fail(Code::kResourceExhausted, "blob of " + std::to_string(promised.size) + " bytes; the limit is " +
                                              std::to_string(max_blob_bytes_) + " (--max-blob-bytes)");
  }
  std::string temporary = (folder_ / "uploads" / "XXXXXX").string();
  const int file = ::mkostemp(temporary.data(), O_CLOEXEC);
  if (file < 0) return disk_error(temporary, "create", errno);
  return std::unique_ptr<Upload>(new Upload(promised, path_of(promised.digest), temporary, file));
}

Result<BlobRef> BlobStore::put(std::span<const std::byte> bytes) const {
  const BlobRef blob{sha256_hex(bytes), bytes.size()};
  if (contains(blob.digest)) return blob;
  RADFARM_TRY(const std::unique_ptr<Upload> upload, begin(blob));
  RADFARM_TRY_STATUS(upload->append(bytes));
  RADFARM_TRY_STATUS(upload->commit());
  return blob;
}

Result<MappedFile> BlobStore::read(const std::string& digest) const {
  RADFARM_TRY_STATUS(wire::check_digest(digest, "digest"));
  if (!contains(digest)) return fail(Code::kNotFound, "blob " + digest + " is not stored");
  return MappedFile::open(path_of(digest));
}

Status BlobStore::link_to(const std::string& digest, const fs::path& target) const {
  if (!contains(digest)) return fail(Code::kNotFound, "blob " + digest + " is not stored");
  std::error_code error;
  fs::create_hard_link(path_of(digest), target, error);
  if (error) fs::copy_file(path_of(digest), target, error);
  if (error) return disk_error(target, "create", error.value());
  return {};
}

BlobStore::Upload::Upload(BlobRef promised, fs::path target, fs::path temporary, int file)
    : promised_(std::move(promised)), target_(std::move(target)), temporary_(std::move(temporary)), file_(file) {}

BlobStore::Upload::~Upload() {
  ::close(file_);
  ::unlink(temporary_.c_str());  // after commit() there is nothing of that name
}

Status BlobStore::Upload::append(std::span<const std::byte> bytes) {
  size_ += bytes.size();
  if (size_ > promised_.size) {
    return fail(Code::kDataLoss, "blob has more than the promised " + std::to_string(promised_.size) + " bytes");
  }
  hash_.update(bytes);
  while (!bytes.empty()) {
    const ssize_t written = ::write(file_, bytes.data(), bytes.size());
    if (written < 0 && errno == EINTR) continue;
    if (written < 0) return disk_error(temporary_, "write", errno);
    bytes = bytes.subspan(static_cast<std::size_t>(written));
  }
  return {};
}

Status BlobStore::Upload::commit() {
  const std::string digest = hash_.hex();
  if (size_ != promised_.size || digest != promised_.digest) {
    return fail(Code::kDataLoss, "promised " + promised_.digest + " of " + std::to_string(promised_.size) +
                                     " bytes, got " + digest + " of " + std::to_string(size_));
  }
  std::error_code error;
  fs::create_directories(target_.parent_path(), error);
  if (error) return disk_error(target_, "create", error.value());
  if (::fchmod(file_, 0444) != 0 || ::fsync(file_) != 0) return disk_error(temporary_, "write", errno);
  if (::rename(temporary_.c_str(), target_.c_str()) != 0) return disk_error(target_, "rename to", errno);
  return {};
}

}  // namespace radfarm
