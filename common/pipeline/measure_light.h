#pragma once

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include "base/progress.h"
#include "base/status.h"
#include "meters/meter.h"
#include "meters/work_plane.h"
#include "scene/load_scene.h"

namespace radfarm {

/// What `radfarm measure` asks for.
struct MeasureRequest {
  enum class Method { kGather, kPaths };
  LoadOptions load;
  std::string env;
  std::map<std::string, std::string> ies;
  std::optional<std::string> points;  // text of a CSV file (meter_file.h); else a work plane
  WorkPlaneSettings plane;            // its floor in the scene file's coordinates
  Method method = Method::kGather;
  double error = .02;                 // aimed at by kGather: half the width of the 95 % interval over the reading
  std::uint64_t samples = 0;          // kGather: paths a meter; 0: by `error`
  std::uint64_t photons = 4'000'000;  // kPaths
  float radius = 0;                   // kPaths, m; 0: by density
  std::uint64_t seed = 1;
  bool picture = false;
};

struct MeasuredLight {
  std::vector<Meter> meters;
  std::vector<Reading> readings;
  Vec3d origin{0, 0, 0};  // to be added to get the file's coordinates
  Summary summary;
  std::optional<float> floor;      // of a work plane, m, in the file's coordinates
  std::vector<double> levels;      // of the picture's contour lines, lux
  std::vector<std::byte> png;      // of a work plane, where asked for
  std::vector<std::string> notes;  // what no path of the method meets
};

/// Illuminance at points of a scene, with 95 % intervals: all effects simulated. docs/pipeline.md (meters.1),
/// (meters.2) Errors: what load_scene and light_scene refuse, no emitter, points or a plane that make no sense,
/// CANCELLED. On all threads.
Result<MeasuredLight> measure_light(const std::filesystem::path& scene_file, const MeasureRequest& request,
                                    const Progress& progress = {});

}  // namespace radfarm
