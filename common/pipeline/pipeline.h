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
#include "frame/round.h"
#include "frame/task.h"
#include "image/image.h"
#include "pipeline/effort.h"
#include "pipeline/round_figures.h"
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
/// `effort`: what rounds of a job before found that it takes. Errors: what load_scene refuses, no emitter, a camera that does not
/// exist, CANCELLED. Cost: seconds; uses all threads.
Result<PreparedFiles> prepare(const std::filesystem::path& scene_file, const RenderRequest& request,
                              const PrepareContext& context = {}, const Effort& effort = {});

/// How a prepared view is rendered first; a job that has a target decides by what comes of it (pipeline/next_round.h).
Result<Round> first_round(std::span<const std::byte> view);

/// `expected` of its facts: what the request and others are expected to cost (docs/formats.md).
Result<nlohmann::json> expected_cost_of(std::span<const std::byte> view);

/// What a request's job is asked for.
Target target_of(const RenderRequest& request);

/// The tasks of a round of a prepared view, in the order in which they are best run. Tiles, light group by light group, then
/// audit tasks.
Result<std::vector<Task>> cut_tasks(std::span<const std::byte> view, const Round& round);
Result<std::vector<Task>> cut_tasks(std::span<const std::byte> view);  // of the first

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

/// What a task of one round starts from.
struct TaskRound {
  Round round;
  std::span<const std::byte> before = {};  // what the same task returned in a round before it, of a smaller scale; may be empty
};

/// One task's encoded sums: the same bytes whoever runs it, and whether it goes on or starts anew, on the caller's thread alone.
/// Cost: up to seconds. DATA_LOSS when what it should go on from is of another task.
Result<std::vector<std::byte>> run_task(const Prepared& prepared, const Task& task, const TaskRound& of);
Result<std::vector<std::byte>> run_task(const Prepared& prepared, const Task& task);  // of the first round

struct Finished {
  Image image;                             // layers and header attributes of DESIGN section 9
  std::unique_ptr<nlohmann::json> report;  // the report JSON of DESIGN section 9
};

/// All results of a round put together and audited: what decides whether the job goes on, and what image and report are made of.
class AssembledRound {
 public:
  AssembledRound(AssembledRound&&) noexcept;
  AssembledRound& operator=(AssembledRound&&) noexcept;
  ~AssembledRound();
  struct Parts;
  explicit AssembledRound(std::unique_ptr<Parts> parts);
  const Parts& parts() const { return *parts_; }
  Parts& parts() { return *parts_; }

  const RoundFigures& figures() const;  // kind and costs are the caller's to fill in

 private:
  std::unique_ptr<Parts> parts_;
};

/// Results in cut_tasks order. DATA_LOSS when one is damaged or missing, INTERNAL when the share of dropped samples is above its
/// limit.
Result<AssembledRound> assemble_round(std::span<const std::byte> view, const Round& round,
                                      std::span<const std::vector<std::byte>> results);

/// What the report says of a job besides its last round.
struct JobFacts {
  FarmFacts farm;
  Target target;
  std::optional<bool> target_met;    // nothing: there is none, or the image is black
  std::vector<RoundFigures> rounds;  // all that were rendered; empty: the assembled one alone
  double elapsed_seconds = 0;        // of wall time, where the target is one of seconds
};

/// Image and report of an assembled round, the job's last.
Finished finish(AssembledRound round, JobFacts job);

/// Of a job that has one round: assembled from all results and audited.
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
