// Radiosity held to path tracing, for any settings: what tests/bench/oracle_experiment.py asks.
//
//   radiosity_lab reference SCENE POINTS PATHS > REFERENCE.json     irradiance at points even by area, two estimates a point
//   radiosity_lab solve SCENE REFERENCE.json < SETTINGS             one JSON object a line in, one a line out
//
// SETTINGS {"oracle": "KL", "literal": false, "error": 1e-4, "seed": 1, "paths": 0, ...}; radiosity/settings.h has the defaults.
// The error is that of the piecewise constant function: mean over the points of (B - B1) (B - B2), B_k = rho E_k with the
// reflectance of the element, E_k independent and unbiased, so that their noise adds nothing. "indirect" is the same of light that
// was reflected before, which is what links and paths bring; "clipped" is that again with all three cut off at four times the mean, so that no
// small bright patch decides. RADFARM_THREADS bounds threads.

#include <algorithm>
#include <atomic>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <fstream>
#include <iostream>

#include <nlohmann/json.hpp>

#include "base/parallel.h"
#include "base/stopwatch.h"
#include "estimate/path_irradiance.h"
#include "frame/request.h"
#include "math/sampling.h"
#include "math/sobol.h"
#include "radiosity/deliveries.h"
#include "radiosity/solve.h"
#include "scene/load_scene.h"

namespace {
std::atomic<std::uint64_t> ray_count{0};  // counted where the linker wraps the ray caster's two entries
}
extern "C" {
void __real_rtcOccluded1(void*, void*, void*);
void __real_rtcIntersect1(void*, void*, void*);
void __wrap_rtcOccluded1(void* a, void* b, void* c) {
  ray_count.fetch_add(1, std::memory_order_relaxed);
  __real_rtcOccluded1(a, b, c);
}
void __wrap_rtcIntersect1(void* a, void* b, void* c) {
  ray_count.fetch_add(1, std::memory_order_relaxed);
  __real_rtcIntersect1(a, b, c);
}
}

namespace radfarm {
namespace {

using nlohmann::json;

constexpr std::uint64_t kPointSeed = 1;
constexpr std::size_t kBlocks = 32;  // of points, for the error's own error

struct ReferencePoint {
  std::uint32_t side = 0;  // SideNumbers
  Vec3 position{0, 0, 0};
  Arrived first, second;
};

Arrived mean_of_paths(const World& world, const SurfacePoint& point, Stream stream, int index, std::uint32_t paths) {
  SpectrumD direct, indirect;
  Counters counters;
  for (std::uint32_t i = 0; i < paths; ++i) {
    const PixelSampler own(kPointSeed, stream, index, 0, i), onward(kPointSeed, stream, index, 1, i);
    const Arrived path = path_irradiance(world, point, own, onward, counters);
    direct += SpectrumD(path.direct), indirect += SpectrumD(path.indirect);
  }
  return {Spectrum(direct / static_cast<double>(paths)), Spectrum(indirect / static_cast<double>(paths))};
}

json as_json(const ReferencePoint& p) {
  json row = {p.side, p.position.x, p.position.y, p.position.z};
  for (const Spectrum& s : {p.first.direct, p.first.indirect, p.second.direct, p.second.indirect}) {
    for (const float channel : {s.r, s.g, s.b}) row.push_back(channel);
  }
  return row;
}

ReferencePoint from_json(const json& j) {
  const auto at = [&](std::size_t i) { return j[i].get<float>(); };
  const auto light = [&](std::size_t i) { return Spectrum(at(i), at(i + 1), at(i + 2)); };
  return {j[0].get<std::uint32_t>(), Vec3(at(1), at(2), at(3)), {light(4), light(7)}, {light(10), light(13)}};
}

json make_reference(const World& world, std::size_t count, std::uint32_t paths) {
  const SideNumbers sides(world.scene);
  const Hierarchy hierarchy = build_hierarchy(world, sides, reachable_sides(world, sides, kPointSeed));
  std::vector<ReferencePoint> points(count);
  parallel_for(count, 16, [&](std::size_t begin, std::size_t end) {
    for (std::size_t i = begin; i < end; ++i) {
      const auto index = static_cast<std::uint32_t>(i);
      const auto choice = static_cast<double>(sobol_owen_1d(index, combine(kPointSeed, 1)));
      const NodeSample sample = sample_node(hierarchy, hierarchy.nodes[0], SampleBy::kArea, choice,
                                            sobol_owen_2d(index, combine(kPointSeed, 2)));
      const Patch& patch = hierarchy.patches[sample.patch];
      SurfacePoint point = world.surfaces.at(world.surfaces.hit_at(patch.instance, patch.triangle, sample.position));
      face(point, patch.normal);
      points[i] = {sides.of(patch.instance, patch.triangle, patch.is_front != 0), sample.position,
                   mean_of_paths(world, point, Stream::kAuditFirst, static_cast<int>(i), paths),
                   mean_of_paths(world, point, Stream::kAuditSecond, static_cast<int>(i), paths)};
    }
  });
  json rows = json::array();
  for (const ReferencePoint& p : points) rows.push_back(as_json(p));
  return rows;
}

Result<RadiositySettings> settings_of(const json& line) {
  RadiositySettings settings;
  RADFARM_TRY(settings.oracle.criterion, oracle_from_string(line.value("oracle", "KL")));
  settings.oracle.form = line.value("literal", false) ? OracleForm::kLiteral : OracleForm::kPower;
  settings.max_link_error = line.value("error", settings.max_link_error);
  settings.min_patch_area = line.value("min_patch_area", settings.min_patch_area);
  settings.samples_per_link = line.value("samples", settings.samples_per_link);
  settings.hits_per_patch = line.value("paths", settings.hits_per_patch);
  settings.max_passes = line.value("passes", settings.max_passes);
  settings.direct_samples = line.value("direct_samples", settings.direct_samples);
  return settings;
}

/// Nodes of whole sides by side number; kNone where the solve left a side out.
std::vector<std::uint32_t> nodes_of_sides(const Hierarchy& hierarchy, const SideNumbers& sides) {
  std::vector<std::uint32_t> nodes(sides.count, kNone);
  for (const std::uint32_t leaf : hierarchy.leaves) {
    const Patch& patch = hierarchy.patches[hierarchy.nodes[leaf].patch];
    nodes[sides.of(patch.instance, patch.triangle, patch.is_front != 0)] = leaf;
  }
  return nodes;
}

/// At one point: what was solved, and two independent estimates.
struct Compared {
  double b, first, second;
};

double mean_reference(const std::vector<Compared>& all) {
  double sum = 0;
  for (const Compared& c : all) sum += (c.first + c.second) / 2;
  return sum / static_cast<double>(all.size());
}

/// Mean square error by blocks of points, and the reference's mean.
json errors(const std::vector<Compared>& all) {
  std::vector<double> blocks(kBlocks);
  double bias = 0;
  const auto n = static_cast<double>(all.size());
  for (std::size_t i = 0; i < all.size(); ++i) {
    const auto& [b, first, second] = all[i];
    blocks[i % kBlocks] += (b - first) * (b - second) * kBlocks / n;
    bias += (b - (first + second) / 2) / n;
  }
  return {{"blocks", blocks}, {"mean", mean_reference(all)}, {"bias", bias}};
}

std::vector<Compared> clip(std::vector<Compared> all) {
  const double most = 4 * mean_reference(all);
  for (Compared& c : all) c = {std::min(c.b, most), std::min(c.first, most), std::min(c.second, most)};
  return all;
}

/// Luminous radiosity at the reference's points.
json compare(const SideNumbers& sides, const RadiositySolution& solution, const std::vector<ReferencePoint>& points) {
  const Hierarchy& hierarchy = solution.hierarchy;
  const std::vector<std::uint32_t> nodes = nodes_of_sides(hierarchy, sides);
  std::vector<Compared> whole(points.size()), indirect(points.size());
  for (std::size_t i = 0; i < points.size(); ++i) {
    const ReferencePoint& p = points[i];
    if (nodes[p.side] == kNone) continue;  // light reaches it by so few rays that it counts as dark in both
    const std::uint32_t part = part_at(hierarchy, nodes[p.side], p.position);
    const Spectrum reflectance = hierarchy.nodes[nodes[p.side]].reflectance;
    const auto reflects = [&](const Spectrum& lux) { return static_cast<double>(luminance(reflectance * lux)); };
    const auto radiosity = [&](const Spectrum& power) {
      return static_cast<double>(luminance(power) / hierarchy.nodes[part].area);
    };
    const double b = radiosity(solution.reflected_power[part]);
    const double direct = solution.reflected_direct.empty() ? 0 : radiosity(solution.reflected_direct[part]);
    whole[i] = {b, reflects(p.first.direct + p.first.indirect), reflects(p.second.direct + p.second.indirect)};
    indirect[i] = {b - direct, reflects(p.first.indirect), reflects(p.second.indirect)};
  }
  json out = errors(whole);
  out["indirect"] = errors(indirect);
  out["clipped"] = errors(clip(indirect));
  return out;
}

json solve_line(const World& world, const std::vector<ReferencePoint>& points, const json& line) {
  const auto settings = settings_of(line);
  if (!settings) return {{"failed", settings.error().message}};
  ray_count = 0;
  const Stopwatch watch;
  const RadiositySolution solution = solve_radiosity(world, *settings, line.value("seed", std::uint64_t{1}));
  const double cpu = watch.cpu_seconds();
  const std::vector<Node>& nodes = solution.hierarchy.nodes;
  json out = compare(SideNumbers(world.scene), solution, points);
  out["settings"] = line;
  out["cpu_s"] = cpu;
  out["rays"] = ray_count.load();
  out["links"] = solution.links;
  out["elements"] = std::count_if(nodes.begin(), nodes.end(), is_undivided);
  out["closure_error"] = solution.energy.closure_error;
  return out;
}

int run(int count, char** arguments) {
  const std::string verb = arguments[1];
  auto scene = load_scene(arguments[2]);
  if (!scene) return std::fprintf(stderr, "%s\n", scene.error().message.c_str()), 3;
  const World world(std::move(*scene));
  if (verb == "reference" && count == 5) {
    std::cout << make_reference(world, std::strtoul(arguments[3], nullptr, 10),
                                static_cast<std::uint32_t>(std::strtoul(arguments[4], nullptr, 10)));
    return 0;
  }
  std::ifstream file(arguments[3]);
  const json rows = json::parse(file, nullptr, false);
  if (!rows.is_array()) return std::fprintf(stderr, "%s: no reference\n", arguments[3]), 3;
  std::vector<ReferencePoint> points;
  for (const json& row : rows) points.push_back(from_json(row));
  for (std::string text; std::getline(std::cin, text);) {
    const json line = json::parse(text, nullptr, false);
    std::cout << (line.is_object() ? solve_line(world, points, line) : json{{"failed", "no JSON object"}}) << std::endl;
  }
  return 0;
}

}  // namespace
}  // namespace radfarm

int main(int count, char** arguments) {
  if (count < 4) return std::fprintf(stderr, "usage: radiosity_lab reference|solve SCENE ...\n"), 2;
  const char* threads = std::getenv("RADFARM_THREADS");
  const radfarm::ThreadLimit limit(threads != nullptr ? std::atoi(threads) : 256);
  return radfarm::run(count, arguments);
}
