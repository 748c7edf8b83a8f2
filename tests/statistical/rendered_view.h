#pragma once

#include <cmath>
#include <vector>

#include "base/parallel.h"
#include "estimate/gather.h"
#include "estimate/paper_gather.h"
#include "estimate/path_reference.h"
#include "estimate/render_tile.h"
#include "scene/world.h"

namespace radfarm::test {

/// The mean over an image's pixels, cd/m^2.
struct Mean {
  double value = 0;    // of reflected luminance
  double error = 0;    // its standard error
  double direct = 0;   // of its part
  double largest = 0;  // pixel
  std::uint64_t dropped = 0;
};

inline Mean mean_of(const Film& film, std::uint32_t samples, const SampleRadiance& radiance) {
  std::vector<std::vector<PixelSums>> rows(static_cast<std::size_t>(film.height));
  parallel_for(rows.size(), 1, [&](std::size_t begin, std::size_t end) {
    Counters counters;
    for (std::size_t y = begin; y < end; ++y) {
      rows[y] =
          render_tile(film, {0, static_cast<int>(y), film.width, static_cast<int>(y) + 1}, {samples, samples, 0},
                      radiance, counters);
    }
  });
  Mean mean;
  const double pixels = static_cast<double>(film.width) * film.height;
  double variance = 0;
  for (const auto& row : rows) {
    for (const PixelSums& p : row) {
      const double n = p.samples;
      const double pixel = luminance(p.reflected()) / n;
      mean.value += pixel / pixels;
      mean.direct += luminance(p.direct) / n / pixels;
      variance += std::max(0.0, p.squared_luminance / n - pixel * pixel) / (n - 1) / (pixels * pixels);
      mean.largest = std::max(mean.largest, pixel);
      mean.dropped += p.dropped;
    }
  }
  mean.error = std::sqrt(variance);
  return mean;
}

inline Mean path_traced(const World& world, const Film& film, std::uint32_t samples) {
  return mean_of(film, samples, [&](const Ray& ray, const PixelSampler& sampler, Counters& counters, FirstSurface*) {
    return trace_path(world, ray, sampler, counters);
  });
}

/// Solved, classified and gathered, at the thresholds of standard quality.
inline Mean gathered(const World& world, const Film& film, std::uint32_t samples, Gather gather = Gather::kDefault) {
  const RadiositySolution solution = solve_radiosity(world, RadiositySettings(), film.seed);
  const SenderTree tree = make_sender_tree(solution, gather == Gather::kPaper ? SenderChoice::kAll : SenderChoice::kBright);
  SenderSettings settings;
  settings.gather = gather;
  const float area = solution.hierarchy.nodes.at(0).area / 2;
  settings.threshold = 0.01F * luminance(solution.reflected_power.at(0)) / (kPi * area);
  const SenderGrid senders(classify_visible(world, tree, film.camera, film.width, film.height, settings, film.seed).file,
                           world, tree, settings, film.seed);
  const ReflectorLookup lookup(world, tree);
  const GatherContext context{world, tree, lookup, senders, settings};
  return mean_of(film, samples, [&](const Ray& ray, const PixelSampler& sampler, Counters& counters, FirstSurface*) {
    return gather == Gather::kPaper ? paper_gather_radiance(context, ray, sampler, counters)
                                    : gather_radiance(context, ray, sampler, counters);
  });
}

}  // namespace radfarm::test
