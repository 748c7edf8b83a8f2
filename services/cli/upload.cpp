#include "cli/upload.h"

#include <array>
#include <cstdio>
#include <random>
#include <set>
#include <vector>

#include <nlohmann/json.hpp>

#include "base/file.h"
#include "base/utf8.h"
#include "cli/request_flags.h"
#include "rpc/blob_client.h"
#include "scene/scene_files.h"

namespace radfarm::cli {
namespace {

struct LocalFile {
  SceneFile file;
  MappedFile contents;
};

/// Its digest takes a second for each GB.
Result<LocalFile> open_file(const std::filesystem::path& path, std::string in_job, const radfarm::Progress& progress) {
  RADFARM_TRY(MappedFile contents, MappedFile::open(path));
  RADFARM_TRY(BlobRef blob, rpc::blob_ref(contents.bytes(), progress));
  return LocalFile{{std::move(in_job), std::move(blob)}, std::move(contents)};
}

Result<std::vector<LocalFile>> open_files(const std::filesystem::path& scene, const radfarm::Progress& progress) {
  RADFARM_TRY(const std::vector<std::filesystem::path> paths, scene_files(scene));
  std::vector<LocalFile> files;
  for (const std::filesystem::path& path : paths) {
    // The transport cannot carry such a name; the coordinator would not even see it.
    if (!is_utf8(path.string())) return fail(Code::kInvalidArgument, "a file's name is not UTF-8: " + path.string());
    RADFARM_TRY(LocalFile file, open_file(scene.parent_path() / path, path.generic_string(), progress));
    files.push_back(std::move(file));
  }
  return files;
}

Status open_attachments(const std::vector<Attachment>& attachments, const radfarm::Progress& progress,
                        std::vector<LocalFile>& files) {
  for (const Attachment& attachment : attachments) {
    if (!is_utf8(attachment.in_job)) return fail(Code::kInvalidArgument, "a file's name is not UTF-8: " + attachment.in_job);
    RADFARM_TRY(LocalFile file, open_file(attachment.local, attachment.in_job, progress));
    files.push_back(std::move(file));
  }
  return {};
}

Status upload_missing(FarmClient& client, const std::vector<LocalFile>& files, const radfarm::Progress& progress) {
  std::vector<std::string> digests;
  for (const LocalFile& local : files) digests.push_back(local.file.blob.digest);
  RADFARM_TRY(const std::vector<std::string> list, client.blobs().find_missing(digests));
  std::set<std::string> missing(list.begin(), list.end());
  for (const LocalFile& local : files) {
    if (missing.erase(local.file.blob.digest) == 0) continue;
    RADFARM_TRY_STATUS(progress.check());
    RADFARM_TRY_STATUS(client.blobs().upload(local.file.blob, local.contents.bytes(), progress));
  }
  return {};
}

}  // namespace

std::string new_request_id() {
  std::random_device random;
  std::array<char, 33> text{};
  std::snprintf(text.data(), text.size(), "%08x%08x%08x%08x", random(), random(), random(), random());
  return text.data();
}

Result<JobStatus> submit_scene(FarmClient& client, const std::filesystem::path& scene, const RenderRequest& request,
                               const radfarm::Progress& progress) {
  RADFARM_TRY(std::vector<LocalFile> files, open_files(scene, progress));
  RenderRequest in_job = request;
  RADFARM_TRY_STATUS(open_attachments(attach_files(in_job), progress, files));
  RADFARM_TRY_STATUS(upload_missing(client, files, progress));
  JobSpec spec;
  spec.display_name = utf8_prefix(scene.filename().string(), 100);
  for (const LocalFile& local : files) spec.files.push_back(local.file);
  spec.entry_path = files.front().file.path;
  spec.render_request_json = to_json(in_job).dump(-1, ' ', false, nlohmann::json::error_handler_t::replace);
  return client.create(new_request_id(), spec);
}

}  // namespace radfarm::cli
