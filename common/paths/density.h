#pragma once

#include <cstdint>
#include <functional>
#include <span>

#include "math/spectrum.h"
#include "paths/crossing.h"

namespace radfarm {

/// What paths brought to one disc: resumable sums.
struct DiscSums {
  SpectrumD flux;               // lm/m^2, summed over paths: over their number, the irradiance in lux
  double inner = 0;             // luminance, of the inner disc of half the area
  double squared = 0;           // of the luminance that each path brought
  std::uint64_t crossings = 0;  // that counted

  DiscSums& operator+=(const DiscSums& o) {
    flux += o.flux;
    inner += o.inner;
    squared += o.squared;
    crossings += o.crossings;
    return *this;
  }
  friend bool operator==(const DiscSums&, const DiscSums&) = default;
};

/// Who is shown where the segments of a path cross discs, and where the path ends.
struct SeeCrossings {
  std::function<void(const Segment&, std::uint32_t disc, const CountedArea&)> crossing;
  std::function<void()> end_path;  // may be empty
};

/// Shows where segments of a batch's paths, of the classes in `origins`, count at discs, path by path.
///                                                                             docs/pipeline.md (paths.2)
/// On the caller's thread. Requires: emitters.size() > 0. Cost: about 1 us a segment, and as much a crossing.
PathLosses each_crossing(const World& world, const DiscSet& discs, OriginSet origins, const PathBatch& batch,
                         const SeeCrossings& see, const CrossingRules& rules = {});

/// Adds to each disc each_crossing() shows. Requires: one sum a disc.
PathLosses add_batch(const World& world, const DiscSet& discs, OriginSet origins, const PathBatch& batch,
                     std::span<DiscSums> sums, const CrossingRules& rules = {});

/// Variance, lux^2, of the irradiance that `paths` paths gave, if their random numbers were independent. (paths.5)
double variance_of(const DiscSums& sums, double paths);

}  // namespace radfarm
