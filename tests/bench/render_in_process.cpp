// The three functions of the product in one process, without a farm: what the farm's overhead is measured against.
//
//   render_in_process SCENE OUT.exr [REQUEST-JSON [REPORT.json]]
//
// Runs tasks on all cores and prints stages, counts and audited error. Thread count: RADFARM_THREADS. Unlike in a farm's report
// the stage `tasks` is the image's alone; what the audit took is the stage `audit`.

#include <algorithm>
#include <cstdio>
#include <cstdlib>
#include <fstream>
#include <span>

#include <nlohmann/json.hpp>

#include "base/file.h"
#include "base/parallel.h"
#include "base/stopwatch.h"
#include "image/exr.h"
#include "pipeline/pipeline.h"

namespace radfarm {
namespace {

int failed(const Error& error) {
  std::fprintf(stderr, "%s\n", error.message.c_str());
  return 3;
}

void print_summary(const nlohmann::json& report, double finish_seconds) {
  for (const auto& stage : report["stages"]) {
    std::printf("%-14s wall %8.2f s  cpu %8.2f s\n", stage["name"].get<std::string>().c_str(),
                stage["wall_s"].get<double>(), stage["cpu_s"].get<double>());
  }
  std::printf("finish         wall %8.2f s\n", finish_seconds);
  std::printf("counts %s\n", report["counts"].dump().c_str());
  std::printf("energy %s\n", report["energy"].dump().c_str());
  std::printf("accuracy %s\n", report["accuracy"].dump().c_str());
  std::printf("peak memory %.0f MB\n", static_cast<double>(peak_memory_bytes()) * 1e-6);
}

struct Took {
  double wall_seconds = 0, cpu_seconds = 0;
};

/// On all cores.
Took run_tasks(const Prepared& prepared, std::span<const Task> tasks, std::span<std::vector<std::byte>> results) {
  const Stopwatch watch;
  parallel_for(tasks.size(), 1, [&](std::size_t begin, std::size_t end) {
    for (std::size_t i = begin; i < end; ++i) results[i] = *run_task(prepared, tasks[i]);
  });
  return {watch.wall_seconds(), watch.cpu_seconds()};
}

int run(int count, char** arguments) {
  const auto json = nlohmann::json::parse(count > 3 ? arguments[3] : "{}", nullptr, false);
  const auto request = render_request_from_json(json);
  if (!request) return failed(request.error());
  const auto files = prepare(arguments[1], *request);
  if (!files) return failed(files.error());
  const auto prepared = Prepared::open(files->scene, files->solution, files->view);
  if (!prepared) return failed(prepared.error());
  const auto tasks = cut_tasks(files->view);
  if (!tasks) return failed(tasks.error());

  std::vector<std::vector<std::byte>> results(tasks->size());
  const auto is_audit = [](const Task& task) { return task.kind == Task::Kind::kAudit; };
  const auto tiles = static_cast<std::size_t>(std::find_if(tasks->begin(), tasks->end(), is_audit) - tasks->begin());
  const Took image = run_tasks(*prepared, std::span(*tasks).first(tiles), std::span(results).first(tiles));
  const Took audit = run_tasks(*prepared, std::span(*tasks).subspan(tiles), std::span(results).subspan(tiles));
  FarmFacts farm;
  farm.tasks_wall_seconds = image.wall_seconds;
  farm.workers.push_back({"in-process", static_cast<int>(tasks->size()), image.cpu_seconds, peak_memory_bytes()});

  const Stopwatch finish_watch;
  auto finished = finish(files->view, results, farm);
  if (!finished) return failed(finished.error());
  auto& stages = (*finished->report)["stages"];
  if (tiles < tasks->size()) stages.push_back({{"name", "audit"}, {"wall_s", audit.wall_seconds}, {"cpu_s", audit.cpu_seconds}});
  const auto exr = encode_exr(finished->image);
  if (!exr) return failed(exr.error());
  if (const auto written = write_file_atomically(arguments[2], *exr); !written) return failed(written.error());
  if (count > 4) std::ofstream(arguments[4]) << finished->report->dump(1) << "\n";
  print_summary(*finished->report, finish_watch.wall_seconds());
  return 0;
}

}  // namespace
}  // namespace radfarm

int main(int count, char** arguments) {
  if (count < 3) {
    std::fprintf(stderr, "usage: render_in_process SCENE OUT.exr [REQUEST-JSON [REPORT.json]]\n");
    return 2;
  }
  const char* threads = std::getenv("RADFARM_THREADS");
  const radfarm::ThreadLimit limit(threads != nullptr ? std::atoi(threads) : 256);
  return radfarm::run(count, arguments);
}
