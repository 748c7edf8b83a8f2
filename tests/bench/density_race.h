#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "paths/crossing.h"
#include "paths/disc.h"

namespace radfarm::bench {

/// Ways to estimate irradiance by the same paths, for comparison.
enum class Way {
  kPaths,    // segments through discs
  kMap,      // photons within the disc's radius
  kNearest,  // the `nearest` photons of one map of all, within the disc's radius
};

struct Experiment {
  Way way = Way::kPaths;
  std::uint64_t paths = 0;
  std::uint64_t seed = 1;
  CrossingRules rules;      // of kPaths
  std::size_t nearest = 0;  // of kNearest
};

struct Estimates {
  std::vector<double> lux;  // one a disc, luminance
  double cpu_seconds = 0;   // of everything: what is built, followed, counted
};

/// Irradiance at discs, on the caller's thread.
Estimates estimate(const World& world, const Components& components, const std::vector<Disc>& discs,
                   const Experiment& experiment);

/// What is true, by unbiased paths from the points. On all threads.
struct Truth {
  std::vector<double> lux;
  double mean = 0;
  double variance = 0;  // lux^2, of one point's, mean
};
Truth find_truth(const World& world, std::span<const Disc> discs, std::uint64_t samples);

/// Root of the mean squared error over the mean, less what the truth's own noise adds.
double relative_error(const Estimates& estimates, const Truth& truth);

/// The discs with another radius.
std::vector<Disc> with_radius(std::vector<Disc> discs, float radius);

}  // namespace radfarm::bench
