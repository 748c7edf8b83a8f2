#pragma once

#include <string>
#include <utility>
#include <vector>

#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include "base/parallel.h"
#include "pipeline/pipeline.h"
#include "support/small_scenes.h"

namespace radfarm::test {

/// A scene of tests/scenes from end to end, without a farm.
inline Finished rendered(const std::string& scene, const RenderRequest& request) {
  const Result<PreparedFiles> files = prepare(own_scene_path(scene), request);
  EXPECT_TRUE(files) << files.error().message;
  const Result<Prepared> prepared = Prepared::open(files->scene, files->solution, files->view);
  EXPECT_TRUE(prepared) << prepared.error().message;
  const std::vector<Task> tasks = *cut_tasks(files->view);
  std::vector<std::vector<std::byte>> results(tasks.size());
  parallel_for(tasks.size(), 1, [&](std::size_t begin, std::size_t end) {
    for (std::size_t i = begin; i < end; ++i) results[i] = *run_task(*prepared, tasks[i]);
  });
  Result<Finished> finished = finish(files->view, results, {});
  EXPECT_TRUE(finished) << finished.error().message;
  return std::move(*finished);
}

}  // namespace radfarm::test
