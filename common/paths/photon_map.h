#pragma once

#include <cstddef>
#include <functional>
#include <memory>
#include <span>
#include <vector>

#include "paths/disc.h"
#include "paths/photon_path.h"

namespace radfarm {

/// Where a segment of a light path met a surface.
struct Photon {
  Vec3 position;
  Vec3 normal;     // unit, geometric, on the side that the light came from
  Spectrum power;  // lm, as the segment's
  Origin origin = Origin::kEmitter;
};

/// The photons that a batch's segments of the classes in `origins` leave; none on panes. On the caller's thread; 40
/// bytes a photon.
std::vector<Photon> photons_of(const World& world, OriginSet origins, const PathBatch& batch);

/// Density estimation by impacts [Jensen 2001], for comparison with paths: photons on the front of a surface in a ball
/// around a point, over the area of its great circle. docs/pipeline.md (map.1) It is biased where that circle is not
/// all surface, or not all of one: on edges, in corners, on leaves. Immutable: thread-safe.
class PhotonMap {
 public:
  /// O(n log n), on the caller's thread.
  explicit PhotonMap(std::vector<Photon> photons);
  PhotonMap(PhotonMap&&) noexcept;
  ~PhotonMap();

  /// Calls see(photon) for each within the disc's radius, on surfaces that face its normal. In an order that depends on
  /// the photons alone.
  void each_near(const OrientedDisc& disc, const std::function<void(const Photon&)>& see) const;

  /// Distance, m, of the `count`-th nearest of them; at most the disc's radius, which is the answer where there are
  /// fewer.
  float distance_of(std::size_t count, const OrientedDisc& disc) const;

  std::size_t size() const;

 private:
  struct Tree;
  std::unique_ptr<Tree> tree_;
};

}  // namespace radfarm
