#pragma once

#include <cstddef>
#include <filesystem>
#include <functional>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include <nlohmann/json_fwd.hpp>

#include "base/progress.h"
#include "base/status.h"
#include "frame/report.h"
#include "frame/request.h"
#include "frame/task.h"
#include "image/image.h"
#include "pipeline/solution_store.h"

namespace radfarm {

/// The product in three functions. `radfarm render` on a laptop and a job on a thousand workers run the same three; all
/// that passes between them is bytes (docs/formats.md), so it may cross a network.

/// What prepare() leaves for the workers: flat files, one blob each.
struct PreparedFiles {
  std::vector<std::byte> scene;     // geometry, materials, lights
  std::vector<std::byte> solution;  // radiosity; nothing camera-dependent. Empty when no integrator needs it
  std::vector<std::byte> view;      // camera, resolved settings, grid, of each light group; what report() says of all stages
};

/// What prepare() may use besides scene and request. None of it changes a bit of scene, solution and image.
struct PrepareContext {
  SolutionStore solutions;  // light that was solved before is not solved again; keeps nothing by default
  Progress progress;        // phases: load, acceleration, effects, radiosity, senders, and the parts of each
};

/// Loads and validates a scene, plans its effects, solves radiosity, classifies senders for one view.
/// Errors: what load_scene refuses, no emitter, a camera that does not exist, CANCELLED. Cost: seconds; uses all threads.
Result<PreparedFiles> prepare(const std::filesystem::path& scene_file, const RenderRequest& request,
                              const PrepareContext& context = {});

/// The tasks of a prepared view, in the order in which they are best run. Tiles, light group by light group, then audit tasks.
Result<std::vector<Task>> cut_tasks(std::span<const std::byte> view);

/// A prepared view opened for running tasks: acceleration structures built, arrays ready. Thread-safe when const.
class Prepared {
 public:
  /// The bytes are copied or used in place: they must outlive this object.
  static Result<Prepared> open(std::span<const std::byte> scene, std::span<const std::byte> solution,
                               std::span<const std::byte> view);
  Prepared(Prepared&&) noexcept;
  Prepared& operator=(Prepared&&) noexcept;
  ~Prepared();

  struct Parts;
  const Parts& parts() const { return *parts_; }

 private:
  explicit Prepared(std::unique_ptr<Parts> parts);
  std::unique_ptr<Parts> parts_;
};

/// One task's encoded sums: the same bytes whoever runs it, on the caller's thread alone. Cost: up to seconds.
Result<std::vector<std::byte>> run_task(const Prepared& prepared, const Task& task);

struct Finished {
  Image image;                             // layers and header attributes of DESIGN section 9
  std::unique_ptr<nlohmann::json> report;  // the report JSON of DESIGN section 9
};

/// Assembles the image from all results (in cut_tasks order) and audits it. DATA_LOSS when a result is damaged or missing,
/// INTERNAL when the share of dropped samples is above its limit.
Result<Finished> finish(std::span<const std::byte> view, std::span<const std::vector<std::byte>> results,
                        const FarmFacts& farm);

/// `radfarm bake`: the radiosity solution of a scene as a glTF binary with vertex colours, for walk-throughs (docs/formats.md).
struct Baked {
  std::vector<std::byte> glb;
  float exposure_ev = 0;
  std::size_t elements = 0;  // undivided ones
  std::size_t triangles = 0;
};
/// Of `request` the light, the quality, the seed and the effects count. By default, the exposure makes the mean middle grey.
/// Errors as prepare(). Uses all threads.
Result<Baked> bake(const std::filesystem::path& scene_file, const RenderRequest& request,
                   const std::optional<float>& exposure_ev = {}, const PrepareContext& context = {});

/// What `radfarm explain` and `radfarm info` print.
Result<nlohmann::json> explain(const std::filesystem::path& scene_file, const RenderRequest& request);
Result<nlohmann::json> describe_scene(const std::filesystem::path& scene_file);

}  // namespace radfarm
