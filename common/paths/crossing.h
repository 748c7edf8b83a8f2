#pragma once

#include "paths/disc.h"
#include "paths/photon_path.h"

namespace radfarm {

/// Rules of the estimator that an experiment may switch off.
struct CrossingRules {
  bool goes_on = true;    // concave surfaces: a segment goes on to its second surface
  bool reachable = true;  // the area that a segment's origin cannot reach is left out
  bool reach = true;      // what stands on a disc cuts it
};

/// Where a segment counts at a disc: the area, m^2, that its power is spread over; 0 where it does not count. The same
/// of the inner disc of half the area, for judging what the radius does to the estimate.
struct CountedArea {
  double whole = 0;
  double inner = 0;
};

/// How one segment crosses discs.
///                                                                             docs/pipeline.md (paths.3), (paths.4),
///                                                                             [3, 4]
/// It counts where it comes from the front of shading and geometric normal, within the disc, before the surface that it
/// meets; also beyond, where that surface goes on with the disc's own (concave surfaces, tessellated ones), before the
/// next. In double.
class Crossing {
 public:
  Crossing(const World& world, const DiscSet& set, const Segment& segment, const CrossingRules& rules = {});
  CountedArea at(std::uint32_t disc);
  /// Up to where discs may count it.
  float far() const;

 private:
  bool is_before_surface(const Disc& disc, double distance, double cosine);
  bool belongs_to_surface(const Disc& disc, double distance, double cosine) const;
  double second_surface();
  double free_area(const Disc& disc, const Reach* reach, double radius) const;

  const World& world_;
  const DiscSet& set_;
  const Segment& segment_;
  const CrossingRules rules_;
  double second_ = -1;  // distance of the next surface; not known yet
};

/// The area of a disc of radius 1 on one side of a line at signed distance d of its centre: all of it from d = 1 on.
/// (paths.3)
double disc_segment(double d);

}  // namespace radfarm
