#pragma once

#include <stdexcept>
#include <string>
#include <utility>
#include <vector>

#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include "base/parallel.h"
#include "pipeline/pipeline.h"
#include "support/small_scenes.h"

namespace radfarm::test {

/// A request's view, and what its tasks returned.
struct RanTasks {
  PreparedFiles files;
  std::vector<std::vector<std::byte>> results;
};

/// A scene of tests/scenes up to its results, without a farm.
inline RanTasks run_tasks(const std::string& scene, const RenderRequest& request) {
  Result<PreparedFiles> files = prepare(own_scene_path(scene), request);
  if (!files) throw std::runtime_error(files.error().message);  // the test fails, and says why
  const Result<Prepared> prepared = Prepared::open(files->scene, files->solution, files->view);
  EXPECT_TRUE(prepared) << prepared.error().message;
  const std::vector<Task> tasks = *cut_tasks(files->view);
  std::vector<std::vector<std::byte>> results(tasks.size());
  parallel_for(tasks.size(), 1, [&](std::size_t begin, std::size_t end) {
    for (std::size_t i = begin; i < end; ++i) results[i] = *run_task(*prepared, tasks[i]);
  });
  return {std::move(*files), std::move(results)};
}

/// The same to its image and report.
inline Finished rendered(const std::string& scene, const RenderRequest& request) {
  const RanTasks ran = run_tasks(scene, request);
  Result<Finished> finished = finish(ran.files.view, ran.results, {});
  EXPECT_TRUE(finished) << finished.error().message;
  return std::move(*finished);
}

}  // namespace radfarm::test
