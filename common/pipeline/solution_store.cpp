#include "pipeline/solution_store.h"

#include <algorithm>
#include <span>
#include <system_error>

#include "base/digest.h"
#include "base/file.h"
#include "base/flat_file.h"
#include "base/log.h"
#include "senders/sender_tree.h"

namespace radfarm {
namespace {

namespace fs = std::filesystem;

constexpr std::uint32_t kVersion = 1;
constexpr std::size_t kKeyDigits = 64;

/// Over everything that an entry says, the file by its digest, so that no damaged byte is trusted.
std::string checksum(const std::string& key, const SolvedLight& light) {
  Sha256 hash;
  hash.update(key);
  hash.update(std::as_bytes(std::span(&light.facts, 1)));
  hash.update(light.digest);
  return hash.hex();
}

std::vector<std::byte> encode(const std::string& key, const SolvedLight& light) {
  FlatFileWriter file("solved", kVersion);
  file.add_text("key", key);
  file.add_text("checksum", checksum(key, light));
  file.add_value("facts", light.facts);
  file.add("file", light.file);
  return file.finish();
}

Result<SolvedLight> decode(const std::string& key, std::span<const std::byte> bytes) {
  RADFARM_TRY(const FlatFileReader file, FlatFileReader::open(bytes, "solved", kVersion));
  RADFARM_TRY(const std::string said, file.get_text("checksum"));
  SolvedLight light;
  RADFARM_TRY(light.facts, file.get_value<SolvedLight::Facts>("facts"));
  RADFARM_TRY(light.file, file.copy<std::byte>("file"));
  light.digest = sha256_hex(light.file);
  if (said != checksum(key, light)) return fail(Code::kDataLoss, "its checksum is another");
  if (light.facts.form != LightForm::kElements) RADFARM_TRY_STATUS(decode_sender_tree(light.file));
  return light;
}

struct Entry {
  fs::path path;
  std::uint64_t bytes;
  fs::file_time_type used;
};

/// Entries, and what interrupted writers left of one. Nothing else in the folder is ours.
std::vector<Entry> entries_of(const fs::path& folder) {
  std::vector<Entry> entries;
  std::error_code gone;  // another process may remove what we look at
  for (fs::directory_iterator at(folder, gone), end; !gone && at != end; at.increment(gone)) {
    if (!is_sha256_hex(at->path().filename().string().substr(0, kKeyDigits))) continue;
    const std::uint64_t bytes = at->file_size(gone);
    const fs::file_time_type used = at->last_write_time(gone);
    if (!gone) entries.push_back({at->path(), bytes, used});
    gone.clear();
  }
  return entries;
}

void evict(const fs::path& folder, const fs::path& newest, std::uint64_t max_bytes) {
  std::vector<Entry> entries = entries_of(folder);
  std::sort(entries.begin(), entries.end(), [](const Entry& a, const Entry& b) { return a.used < b.used; });
  std::uint64_t total = 0;
  for (const Entry& entry : entries) total += entry.bytes;
  for (const Entry& entry : entries) {
    if (total <= max_bytes) return;
    if (entry.path == newest) continue;
    std::error_code ignored;
    fs::remove(entry.path, ignored);
    total -= entry.bytes;
  }
}

}  // namespace

std::optional<SolvedLight> SolutionStore::find(const std::string& key) const {
  if (!keeps()) return std::nullopt;
  const fs::path path = folder_ / key;
  const Result<MappedFile> file = MappedFile::open(path);
  if (!file) return std::nullopt;
  Result<SolvedLight> light = decode(key, file->bytes());
  if (!light) {
    spdlog::warn("{}: solved again: {}", path.string(), light.error().message);
    return std::nullopt;
  }
  std::error_code ignored;  // a folder that may only be read still serves
  fs::last_write_time(path, fs::file_time_type::clock::now(), ignored);
  return std::move(*light);
}

void SolutionStore::keep(const std::string& key, const SolvedLight& light) const {
  if (!keeps()) return;
  const std::vector<std::byte> bytes = encode(key, light);
  if (bytes.size() > max_bytes_) return;
  std::error_code error;
  fs::create_directories(folder_, error);
  if (const Status written = write_file_atomically(folder_ / key, bytes); !written) {
    return spdlog::warn("the solution is not kept: {}", written.error().message);
  }
  evict(folder_, folder_ / key, max_bytes_);
}

}  // namespace radfarm
