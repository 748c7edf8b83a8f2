#pragma once

#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include <CLI/CLI.hpp>

#include "base/status.h"
#include "frame/request.h"

namespace radfarm::cli {

/// The flags that shape an image, as typed; shared by render, submit and explain.
struct RequestFlags {
  std::optional<std::string> camera, eye, look_at, up_vector, size;
  std::optional<double> fov, orthographic;
  std::optional<std::string> quality, error, time;
  std::string up = "Y", integrator = "auto", oracle = to_string(RenderRequest().oracle), effects, gather = "default", criterion = "uniform";
  std::optional<int> samples;
  std::optional<std::uint64_t> photons;
  std::optional<float> radius, link_error, threshold, lens_diameter, focus_distance;
  std::string env;
  std::vector<std::string> ies, aov;
  std::uint64_t seed = 1;
  int tile = 32;
  bool no_audit = false, no_sharing = false, mesh = false;
};

void add_request_flags(CLI::App& app, RequestFlags& flags);

/// A relative error: "2%" or ".02". INVALID_ARGUMENT as below.
Result<double> parse_error_target(const std::string& text);

/// INVALID_ARGUMENT names the flag and says what would be right.
Result<RenderRequest> parse_request(const RequestFlags& flags);

/// Files that a request names beside the scene: what each is called on this machine and in the job.
struct Attachment {
  std::filesystem::path local;
  std::string in_job;
};
/// Changes the request to name its files as they are called in the job.
std::vector<Attachment> attach_files(RenderRequest& request);
/// Changes the request to name its files by absolute paths, for use on this machine.
void locate_files(RenderRequest& request);

}  // namespace radfarm::cli
