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

inline Mean mean_of_pixels(const std::vector<PixelSums>& pixels) {
  Mean mean;
  const double count = static_cast<double>(pixels.size());
  double variance = 0;
  for (const PixelSums& p : pixels) {
    const double n = p.samples;
    const double pixel = luminance(p.reflected()) / n;
    mean.value += pixel / count;
    mean.direct += luminance(p.direct) / n / count;
    variance += std::max(0.0, p.squared_luminance / n - pixel * pixel) / (n - 1) / (count * count);
    mean.largest = std::max(mean.largest, pixel);
    mean.dropped += p.dropped;
  }
  mean.error = std::sqrt(variance);
  return mean;
}

/// Means of a film's blocks of `side` pixels, row by row of blocks.
inline std::vector<Mean> means_of_blocks(const Film& film, std::uint32_t samples, int side, const SampleRadiance& radiance) {
  std::vector<PixelRect> rects;
  for (int y = 0; y < film.height; y += side) {
    for (int x = 0; x < film.width; x += side) {
      rects.push_back({x, y, std::min(film.width, x + side), std::min(film.height, y + side)});
    }
  }
  std::vector<Mean> means(rects.size());
  parallel_for(rects.size(), 1, [&](std::size_t begin, std::size_t end) {
    Counters counters;
    for (std::size_t i = begin; i < end; ++i) {
      means[i] = mean_of_pixels(render_tile(film, rects[i], {samples, samples, 0}, radiance, counters).light);
    }
  });
  return means;
}

/// Of the whole film.
inline Mean mean_of(const Film& film, std::uint32_t samples, const SampleRadiance& radiance) {
  std::vector<std::vector<PixelSums>> rows(static_cast<std::size_t>(film.height));
  parallel_for(rows.size(), 1, [&](std::size_t begin, std::size_t end) {
    Counters counters;
    for (std::size_t y = begin; y < end; ++y) {
      rows[y] = render_tile(film, {0, static_cast<int>(y), film.width, static_cast<int>(y) + 1}, {samples, samples, 0},
                            radiance, counters).light;
    }
  });
  std::vector<PixelSums> pixels;
  for (const std::vector<PixelSums>& row : rows) pixels.insert(pixels.end(), row.begin(), row.end());
  return mean_of_pixels(pixels);
}

inline SampleRadiance path_tracer(const World& world) {
  return [&world](const Ray& ray, const PixelSampler& sampler, Counters& counters, FirstSurface*) {
    return trace_path(world, ray, sampler, counters);
  };
}

inline Mean path_traced(const World& world, const Film& film, std::uint32_t samples) {
  return mean_of(film, samples, path_tracer(world));
}

inline std::vector<Mean> path_traced_blocks(const World& world, const Film& film, std::uint32_t samples, int side) {
  return means_of_blocks(film, samples, side, path_tracer(world));
}

/// Solved and classified, at the thresholds of standard quality: what a gather borrows. `threshold` is a share of the mean radiance.
class GatheredView {
 public:
  GatheredView(const World& world, const Film& film, Gather gather = Gather::kDefault, float threshold = 0.01F)
      : solution_(solve_radiosity(world, radiosity_settings(), film.seed)),
        tree_(make_sender_tree(solution_, gather == Gather::kPaper ? SenderChoice::kAll : SenderChoice::kBright)),
        settings_(settings_for(solution_, gather, threshold)),
        senders_(classify_visible(world, tree_, film.camera, film.width, film.height, settings_, film.seed).file, world, tree_,
                 settings_, film.seed),
        lookup_(world, tree_),
        context_{world, tree_, lookup_, senders_, settings_} {}

  const PerspectiveGrid& grid() const { return senders_.grid(); }
  const GatherContext& context() const { return context_; }
  SampleRadiance integrator() const {
    return [this](const Ray& ray, const PixelSampler& sampler, Counters& counters, FirstSurface*) {
      return settings_.gather == Gather::kPaper ? paper_gather_radiance(context_, ray, sampler, counters)
                                                : gather_radiance(context_, ray, sampler, counters);
    };
  }

 private:
  static RadiositySettings radiosity_settings() {
    RadiositySettings settings;
    settings.max_link_error = 2e-5F;
    return settings;
  }
  static SenderSettings settings_for(const RadiositySolution& solution, Gather gather, float threshold) {
    SenderSettings settings;
    settings.gather = gather;
    const float area = solution.hierarchy.nodes.at(0).area / 2;
    settings.threshold = threshold * luminance(solution.reflected_power.at(0)) / (kPi * area);
    return settings;
  }

  const RadiositySolution solution_;
  const SenderTree tree_;
  const SenderSettings settings_;
  const SenderGrid senders_;
  const ReflectorLookup lookup_;
  const GatherContext context_;
};

inline Mean gathered(const World& world, const Film& film, std::uint32_t samples, Gather gather = Gather::kDefault) {
  const GatheredView view(world, film, gather);
  return mean_of(film, samples, view.integrator());
}

inline std::vector<Mean> gathered_blocks(const World& world, const Film& film, std::uint32_t samples, int side) {
  const GatheredView view(world, film);
  return means_of_blocks(film, samples, side, view.integrator());
}

}  // namespace radfarm::test
