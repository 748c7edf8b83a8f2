#pragma once

#include <cstdint>
#include <optional>
#include <string>

#include <CLI/CLI.hpp>

#include "base/status.h"
#include "cli/unbuilt_flags.h"
#include "frame/request.h"

namespace radfarm::cli {

/// The flags that shape an image, as typed; shared by render, submit and explain.
struct RequestFlags {
  std::optional<std::string> camera, eye, look_at, up_vector, size;
  std::optional<double> fov;
  std::string up = "Y", integrator = "auto", quality = "standard", effects, gather = "default", criterion = "uniform";
  std::optional<int> samples;
  std::optional<float> threshold;
  std::uint64_t seed = 1;
  int tile = 32;
  bool no_audit = false;
  UnbuiltFlags unbuilt;
};

void add_request_flags(CLI::App& app, RequestFlags& flags);

/// INVALID_ARGUMENT names the flag and says what would be right.
Result<RenderRequest> parse_request(const RequestFlags& flags);

}  // namespace radfarm::cli
