// The figures of paper 3 as experiments of ours: pictures into a folder, numbers as JSON lines.
// tests/bench/paper_figures.py calls it and plots the numbers.
//   paper_figures OUT-FOLDER [plane|concave|corner|table|rectangles...]    all by default
#include <algorithm>
#include <cmath>
#include <cstdio>
#include <numbers>
#include <span>
#include <string>
#include <utility>

#include "base/parallel.h"
#include "bench/density_race.h"
#include "bench/panels.h"
#include "bench/path_scenes.h"
#include "estimate/seen_discs.h"

namespace radfarm::bench {
namespace {

constexpr std::uint64_t kFew = 55000, kMany = 2455000;  // the paper's

struct Output {
  std::filesystem::path folder;

  void write(const std::string& name, const std::vector<std::vector<Panel>>& rows, double white, int scale) const {
    const Status written = write_panels(folder / name, rows, white, scale);
    if (!written) std::fprintf(stderr, "%s\n", written.error().message.c_str());
  }
};

/// Discs on the lower plane of shadow_plane(), n x n of them, row by row.
std::vector<Disc> plane_discs(const World& world, const Components& components, int n, bool with_border) {
  std::vector<Disc> discs;
  for (int row = 0; row < n; ++row) {
    for (int column = 0; column < n; ++column) {
      const auto at = [&](int i) {
        const float share = with_border ? static_cast<float>(i) / static_cast<float>(n - 1)
                                        : (static_cast<float>(i) + .5F) / static_cast<float>(n);
        return .998F * (2 * share - 1);
      };
      const auto hit = world.caster.closest({{at(column), .2F, at(row)}, {0, -1, 0}}, 0);
      SurfacePoint point = world.surfaces.at(*hit);
      face(point, {0, 1, 0});
      discs.push_back(disc_at(point, components.of(hit->instance, hit->triangle), 1));
    }
  }
  return discs;
}

Experiment by(Way way, std::uint64_t paths, const CrossingRules& rules = {}) { return {way, paths, 1, rules, 0}; }

Panel square(int n, std::vector<double> values) { return {n, n, std::move(values)}; }

/// The shadow, estimated at n x n points.
struct Plane {
  const World& world;
  const Components& components;
  int n;
  std::vector<Disc> discs = plane_discs(world, components, n, false);
  Truth truth = find_truth(world, discs, 1024);

  Estimates at(float radius, std::uint64_t paths) const {
    return estimate(world, components, with_radius(discs, radius), by(Way::kPaths, paths));
  }
};

/// Figures 1 to 4: rows of pictures.
void show_noise_and_bias(const Output& output, const Plane& plane) {
  std::vector<std::vector<Panel>> rows(3);
  for (const std::uint64_t paths : {5000U, 105000U, 1005000U, 2455000U})
    rows[0].push_back(square(plane.n, plane.at(.05F, paths).lux));
  for (const float radius : {.2F, .15F, .1F, .05F}) {
    rows[1].push_back(square(plane.n, plane.at(radius, kFew).lux));
    rows[2].push_back(square(plane.n, plane.at(radius, kMany).lux));
  }
  for (std::vector<Panel>& row : rows) row.push_back(square(plane.n, plane.truth.lux));
  output.write("photon-paths-shadow.png", rows, quantile_of(rows[0].back(), .98), 1);
}

/// RMSE over paths and radii.
void print_errors(const Plane& plane) {
  std::vector<std::pair<std::uint64_t, float>> runs;
  for (const std::uint64_t paths : {5000U, 20000U, 55000U, 200000U, 455000U, 1005000U, 2455000U}) {
    for (float radius = .4F; radius > .009F; radius /= std::numbers::sqrt2_v<float>) runs.emplace_back(paths, radius);
  }
  for (const auto& [paths, radius] : runs) {
    std::printf("{\"figure\": \"errors\", \"paths\": %llu, \"radius\": %.5f, \"error\": %.6f}\n",
                static_cast<unsigned long long>(paths), static_cast<double>(radius),
                relative_error(plane.at(radius, paths), plane.truth));
    std::fflush(stdout);
  }
}

/// Figure 5: estimated at vertices, linear between.
void show_vertices(const Output& output, const Plane& plane) {
  std::vector<Panel> row;
  for (const int n : {6, 21, 51, 71}) {
    const std::vector<Disc> vertices = with_radius(plane_discs(plane.world, plane.components, n, true), .02F);
    const std::vector<double> lux = estimate(plane.world, plane.components, vertices, by(Way::kPaths, kMany)).lux;
    Estimates shown;
    for (int y = 0; y < plane.n; ++y) {
      for (int x = 0; x < plane.n; ++x) {
        const double u = (x + .5) / plane.n * (n - 1), v = (y + .5) / plane.n * (n - 1);
        const int i = static_cast<int>(u), k = static_cast<int>(v);
        const auto at = [&](int column, int r) { return lux[static_cast<std::size_t>(r * n + column)]; };
        const double above = std::lerp(at(i, k), at(i + 1, k), u - i),
                     below = std::lerp(at(i, k + 1), at(i + 1, k + 1), u - i);
        shown.lux.push_back(std::lerp(above, below, v - k));
      }
    }
    std::printf("{\"figure\": \"vertices\", \"vertices\": %d, \"error\": %.6f}\n", n * n,
                relative_error(shown, plane.truth));
    row.push_back(square(plane.n, shown.lux));
  }
  row.push_back(square(plane.n, plane.truth.lux));
  output.write("photon-paths-vertices.png", {row}, quantile_of(row.back(), .98), 1);
}

struct View {
  const char* name;
  Scene scene;
  Vec3 eye, look_at, up;
  float fov;
  float radius;
  std::uint64_t paths;
  std::vector<std::pair<const char*, Experiment>> ways;
};

/// One picture a way, and the truth.
void show_view(const Output& output, const View& view) {
  const World world(view.scene);
  const Components components(world.scene);
  constexpr int kWidth = 240, kHeight = 180;
  const Film film{*place_camera(view.eye, view.look_at, view.up, view.fov), kWidth, kHeight, 1, 0};
  const SeenDiscs seen = see_discs(world, components, film, {4, view.paths, view.radius});
  const auto shown = [&](const std::vector<double>& lux) {
    Panel panel{kWidth, kHeight, std::vector<double>(static_cast<std::size_t>(kWidth * kHeight))};
    for (std::size_t i = 0; i < lux.size(); ++i)
      panel.values[seen.shown[i].pixel] += static_cast<double>(seen.shown[i].weight.g) * lux[i];
    return panel;
  };
  const Truth truth = find_truth(world, seen.discs, 128);
  std::vector<Panel> row;
  for (const auto& [name, experiment] : view.ways) {
    const Estimates found = estimate(world, components, seen.discs, experiment);
    double mean = 0;
    for (const double lux : found.lux) mean += lux / static_cast<double>(found.lux.size());
    std::printf("{\"figure\": \"%s\", \"way\": \"%s\", \"error\": %.6f, \"mean\": %.5f}\n", view.name, name,
                relative_error(found, truth), mean / truth.mean);
    std::fflush(stdout);
    row.push_back(shown(found.lux));
  }
  row.push_back(shown(truth.lux));
  output.write(std::string("photon-paths-") + view.name + ".png", {row}, 1.1 * quantile_of(row.back(), .995), 1);
}

std::vector<View> views() {
  const std::uint64_t many = 300000, little = 50000;
  const Experiment paths = by(Way::kPaths, many), map = by(Way::kMap, many);
  const CrossingRules not_on{false, true, true}, all_area{true, false, false};
  return {{"concave",
           waves(),
           {1.6F, 2, 2},
           {0, -.1F, 0},
           {0, 1, 0},
           .75F,
           .1F,
           many,
           {{"first surface only", by(Way::kPaths, many, not_on)}, {"to the second", paths}}},
          {"corner",
           plain_room(),
           {1.6F, 1.8F, 1.6F},
           {-1.8F, .8F, -1.8F},
           {0, 1, 0},
           1,
           .25F,
           many,
           {{"all of the area", by(Way::kPaths, many, all_area)}, {"what can be reached", paths}}},
          {"table",
           table(),
           {1.3F, 1.5F, 1.5F},
           {0, 1, 0},
           {0, 1, 0},
           .5F,
           .1F,
           many,
           {{"photon map", map}, {"paths", paths}}},
          {"rectangles",
           leaf_cloud(600, .1F),
           {.1F, 3.6F, 0},
           {0, 1, 0},
           {0, 0, -1},
           .8F,
           .1F,
           little,
           {{"photon map", by(Way::kMap, little)}, {"paths", by(Way::kPaths, little)}}}};
}

void show_plane(const Output& output) {
  const World world(shadow_plane());
  const Components components(world.scene);
  const Plane plane{world, components, 128};
  show_noise_and_bias(output, plane);
  show_vertices(output, plane);
  print_errors(Plane{world, components, 40});
}

void show(const Output& output, std::span<const std::string> names) {
  const auto wants = [&](const char* name) {
    return names.empty() || std::find(names.begin(), names.end(), name) != names.end();
  };
  if (wants("plane")) show_plane(output);
  for (const View& view : views()) {
    if (wants(view.name)) show_view(output, view);
  }
}

}  // namespace
}  // namespace radfarm::bench

int main(int argc, char** argv) {
  if (argc < 2) return std::fprintf(stderr, "paper_figures OUT-FOLDER [plane|concave|corner|table|rectangles...]\n"), 2;
  const std::vector<std::string> names(argv + 2, argv + argc);
  radfarm::bench::show({argv[1]}, names);
  return 0;
}
