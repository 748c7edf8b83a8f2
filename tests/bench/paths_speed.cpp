// What photon paths cost, on one thread. Prints Markdown tables (docs/benchmarks.md "Photon paths: speed").
//
//   paths_speed discs
//   paths_speed grid [PATHS]
//   paths_speed map leaves|room
//   paths_speed memory PATHS
//
// discs: ns a segment and a counted crossing, 1k to 1M discs. grid: the paper's ray discretisation against discs in
// Embree, with the same segments, discs and crossings. map: the photon map, at the same paths and at the same error;
// memory: the peak, on all threads.
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <string>

#include "base/parallel.h"
#include "base/stopwatch.h"
#include "bench/density_race.h"
#include "bench/path_scenes.h"
#include "bench/ray_grid.h"
#include "paths/density.h"
#include "paths/photon_map.h"
#include "paths/radius.h"

namespace radfarm::bench {
namespace {

/// Seconds of following so many paths past the discs, and what these counted.
struct Counted {
  double build = 0, seconds = 0, crossings = 0;
};
Counted count(const World& world, const Components& components, const std::vector<Disc>& discs, std::uint64_t paths) {
  Counted counted;
  const Stopwatch build;
  const DiscSet set(world, components, discs);
  counted.build = build.cpu_seconds();
  std::vector<DiscSums> sums(discs.size());
  const Stopwatch watch;
  add_batch(world, set, kAllOrigins, {1, 0, paths}, sums);
  counted.seconds = watch.cpu_seconds();
  for (const DiscSums& s : sums) counted.crossings += static_cast<double>(s.crossings);
  return counted;
}

/// Each number of discs at a radius that one segment in seven crosses, and at four times that: what differs is
/// crossings.
void print_discs() {
  const ThreadLimit alone(1);
  const World world(leaf_cloud(20000, .03F));
  const Components components(world.scene);
  constexpr std::uint64_t kPaths = 200000;
  std::uint64_t segments = 0;
  const Stopwatch watch;
  follow_batch(
      world, {1, 0, kPaths}, [&](const Segment&) { ++segments; }, [] {});
  const double bare = watch.cpu_seconds(), scale = 1e9 / static_cast<double>(segments);
  std::printf(
      "| discs | radius, m | made, s | following, ns a segment | all, ns a segment | crossings a segment | ns a "
      "crossing more |\n"
      "|---|---|---|---|---|---|---|\n");
  for (const std::size_t discs : {1000U, 10000U, 100000U, 1000000U}) {
    const float radius = 2.5F / std::sqrt(static_cast<float>(discs));
    const std::vector<Disc> chosen = upper_discs(world, components, discs, 1);
    const Counted few = count(world, components, with_radius(chosen, radius), kPaths);
    const Counted many = count(world, components, with_radius(chosen, 4 * radius), kPaths);
    for (const auto& [r, counted] : {std::pair(radius, few), std::pair(4 * radius, many)}) {
      std::printf("| %zu | %.4f | %.2f | %.0f | %.0f | %.3f | %.0f |\n", discs, static_cast<double>(r), counted.build,
                  bare * scale, counted.seconds * scale, counted.crossings / static_cast<double>(segments),
                  1e9 * (many.seconds - few.seconds) / (many.crossings - few.crossings));
      std::fflush(stdout);
    }
  }
}

struct Query {
  const Piece& piece;
  std::span<const OrientedDisc> discs;
  std::uint64_t& crossings;
};

double print_embree(std::span<const Piece> pieces, std::span<const OrientedDisc> discs) {
  const Stopwatch watch;
  const DiscCaster caster(discs);
  const double build = watch.cpu_seconds();
  std::uint64_t crossings = 0;
  for (const Piece& piece : pieces) {
    Query query{piece, discs, crossings};
    const auto visit = [](void* user, std::uint32_t disc) {
      const Query& q = *static_cast<Query*>(user);
      q.crossings += crosses(q.piece, q.discs[disc]) ? 1 : 0;
    };
    caster.crossed(piece.ray, piece.begin, piece.end * (1 + 1e-4F), visit, &query);
  }
  const double all = watch.cpu_seconds();
  std::printf("| discs in Embree | - | - | %.2f | %.2f | %.2f | 1 | %llu |\n", build, all - build, all,
              static_cast<unsigned long long>(crossings));
  return all;
}

void print_grid(std::uint64_t paths) {
  const ThreadLimit alone(1);
  const World world(paper_room());
  const Components components(world.scene);
  std::vector<OrientedDisc> discs;
  for (const Disc& disc : paper_discs(world, components)) discs.push_back(disc.shape);
  std::vector<Piece> pieces;
  follow_batch(
      world, {1, 0, paths},
      [&](const Segment& s) {
        pieces.push_back({s.ray, s.begin, s.end});
      },
      [] {});
  std::printf("%zu discs, %zu segments of %llu paths\n\n", discs.size(), pieces.size(),
              static_cast<unsigned long long>(paths));
  std::printf(
      "| | patches of directions | cells each | built, s | searched, s | together, s | times ours | crossings |\n"
      "|---|---|---|---|---|---|---|---|\n");
  const double ours = print_embree(pieces, discs);
  for (const auto& [rings, columns] : {std::pair(4, 32), {8, 32}, {16, 32}, {16, 64}, {24, 64}, {32, 64}}) {
    const Stopwatch watch;
    const RayGrid grid(pieces, {0, 0, 0}, 10.1, {rings, columns});
    const double build = watch.cpu_seconds();
    std::uint64_t crossings = 0;
    for (const OrientedDisc& disc : discs) grid.crossed(disc, [&](std::uint32_t) { ++crossings; });
    const double all = watch.cpu_seconds();
    std::printf("| ray discretisation [3] | %zu | %d | %.2f | %.2f | %.2f | %.1f | %llu |\n", grid.patches(),
                columns * columns, build, all - build, all, all / ours, static_cast<unsigned long long>(crossings));
    std::fflush(stdout);
  }
}

struct Run {
  double error, seconds;
};

/// The best of all radii from `radius`, the best of fewer paths, down to 4 mm; it becomes that.
Run best_run(const World& world, const Components& components, const std::vector<Disc>& discs, const Truth& truth,
             const Experiment& experiment, float& radius) {
  Run best{1e30, 0};
  for (float r = radius; r > .004F; r /= 1.5F) {
    const Estimates found = estimate(world, components, with_radius(discs, r), experiment);
    const double error = relative_error(found, truth);
    if (!(error < best.error)) continue;
    best = {error, found.cpu_seconds};
    radius = r;
  }
  return best;
}

/// CPU seconds for that error, between the runs about it; those of the first run where that is better already.
double seconds_for(double error, std::span<const Run> runs) {
  if (error >= runs[0].error) return runs[0].seconds;
  std::size_t k = 1;
  while (k + 1 < runs.size() && runs[k].error > error) ++k;
  const Run &a = runs[k - 1], &b = runs[k];
  const double share = std::log(error / a.error) / std::log(b.error / a.error);
  return std::exp(std::log(a.seconds) + share * std::log(b.seconds / a.seconds));
}

void print_race(const char* name, const Scene& scene) {
  const World world(scene);
  const Components components(world.scene);
  const std::vector<Disc> discs = upper_discs(world, components, 4000, 1);
  const Truth truth = find_truth(world, discs, 4096);
  const std::uint64_t counts[] = {300, 2000, 20000, 80000, 320000, 1280000};
  std::vector<Run> runs[2];
  std::printf("\n| scene | | paths | best radius, m | error | CPU s |\n|---|---|---|---|---|---|\n");
  for (const Way way : {Way::kPaths, Way::kMap}) {
    float radius = 1.05F;
    for (const std::uint64_t paths : counts) {
      Experiment experiment;
      experiment.way = way, experiment.paths = paths;
      const Run run = best_run(world, components, discs, truth, experiment, radius);
      runs[way == Way::kPaths ? 0 : 1].push_back(run);
      std::printf("| %s | %s | %llu | %.3f | %.2f %% | %.2f |\n", name, way == Way::kPaths ? "paths" : "photon map",
                  static_cast<unsigned long long>(paths), static_cast<double>(radius), 100 * run.error, run.seconds);
      std::fflush(stdout);
    }
  }
  std::printf("\n%s, paths' time over the photon map's: at equal paths", name);
  for (std::size_t k = 0; k < std::size(counts); ++k) std::printf(" %.2f", runs[0][k].seconds / runs[1][k].seconds);
  std::printf("; at the errors of the photon map's runs");
  for (const Run& run : runs[1]) {
    std::printf(" %s%.2f", run.error >= runs[0][0].error ? "<" : "", seconds_for(run.error, runs[0]) / run.seconds);
  }
  std::printf("\n\n");
}

/// Radii by a pilot against the nearest photons of one map of all.
void print_nearest(const char* name, const Scene& scene) {
  const World world(scene);
  const Components components(world.scene);
  std::vector<Disc> discs = upper_discs(world, components, 4000, 1);
  const Truth truth = find_truth(world, discs, 4096);
  const std::vector<float> least(discs.size(), 1e-5F);
  std::printf("| scene | nearest | of one map | radii by a pilot |\n|---|---|---|---|\n");
  for (const std::size_t nearest : {50U, 200U, 800U}) {
    Experiment experiment{Way::kNearest, 320000, 1, {}, nearest};
    const double one_map = relative_error(estimate(world, components, with_radius(discs, 1), experiment), truth);
    const std::vector<float> radii =
        radii_by_nearest(world, discs, kAllOrigins, {1, 0, 320000}, static_cast<double>(nearest), least, 1);
    for (std::size_t i = 0; i < discs.size(); ++i) discs[i].shape.radius = radii[i];
    experiment.way = Way::kMap;
    const double pilot = relative_error(estimate(world, components, discs, experiment), truth);
    std::printf("| %s | %zu | %.2f %% | %.2f %% |\n", name, nearest, 100 * one_map, 100 * pilot);
  }
}

void print_map(const std::string& name) {
  const Scene scene = name == "room" ? plain_room() : leaf_cloud(5000, .02F);
  print_nearest(name.c_str(), scene);
  print_race(name.c_str(), scene);
}

void print_memory(std::uint64_t paths) {
  const World world(plain_room());
  const Components components(world.scene);
  const DiscSet set(world, components, upper_discs(world, components, 50000, .02F));
  const long long before = peak_memory_bytes();
  constexpr std::size_t kBatches = 2;
  std::vector<std::vector<DiscSums>> sums(kBatches, std::vector<DiscSums>(set.discs().size()));
  const Stopwatch watch;
  parallel_for(kBatches, 1, [&](std::size_t begin, std::size_t end) {
    for (std::size_t b = begin; b < end; ++b) add_batch(world, set, kAllOrigins, {1, b, paths / kBatches}, sums[b]);
  });
  std::printf("| %llu | %.0f | %.1f | %.1f |\n", static_cast<unsigned long long>(paths), watch.cpu_seconds(),
              static_cast<double>(before) / 1e6, static_cast<double>(peak_memory_bytes()) / 1e6);
}

int run(int argc, char** argv) {
  const std::string what = argc > 1 ? argv[1] : "";
  const std::uint64_t paths = argc > 2 ? std::strtoull(argv[2], nullptr, 10) : 100000;
  if (what == "discs")
    print_discs();
  else if (what == "grid")
    print_grid(paths);
  else if (what == "map")
    print_map(argc > 2 ? argv[2] : "leaves");
  else if (what == "memory")
    print_memory(paths);
  else
    return std::fprintf(stderr, "paths_speed discs | grid [PATHS] | map leaves|room | memory PATHS\n"), 2;
  return 0;
}

}  // namespace
}  // namespace radfarm::bench

int main(int argc, char** argv) { return radfarm::bench::run(argc, argv); }
