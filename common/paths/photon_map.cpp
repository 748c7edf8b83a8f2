#include "paths/photon_map.h"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <utility>

#include <nanoflann.hpp>

namespace radfarm {
namespace {

/// The photons as nanoflann reads them.
struct Cloud {
  std::vector<Photon> photons;

  std::size_t kdtree_get_point_count() const { return photons.size(); }
  float kdtree_get_pt(std::size_t i, std::size_t axis) const { return photons[i].position[static_cast<int>(axis)]; }
  template <class Box>
  bool kdtree_get_bbox(Box&) const {
    return false;
  }
};

using Index = nanoflann::KDTreeSingleIndexAdaptor<nanoflann::L2_Simple_Adaptor<float, Cloud>, Cloud, 3, std::uint32_t>;

/// nanoflann's result sets: told of points by squared distance, in the order in which it finds them.
class Within {
 public:
  Within(const Cloud& cloud, const OrientedDisc& disc, const std::function<void(const Photon&)>& see)
      : cloud_(cloud), disc_(disc), see_(see) {}
  std::size_t size() const { return 0; }
  bool full() const { return true; }
  float worstDist() const { return disc_.radius * disc_.radius; }
  bool addPoint(float, std::uint32_t index) {
    const Photon& photon = cloud_.photons[index];
    if (dot(photon.normal, disc_.normal) > 0) see_(photon);
    return true;
  }

 private:
  const Cloud& cloud_;
  const OrientedDisc& disc_;
  const std::function<void(const Photon&)>& see_;
};

class Nearest {
 public:
  Nearest(const Cloud& cloud, const OrientedDisc& disc, std::size_t count)
      : cloud_(cloud), disc_(disc), count_(count) {}
  std::size_t size() const { return squares_.size(); }
  bool full() const { return squares_.size() == count_; }
  float worstDist() const { return full() ? squares_.front() : disc_.radius * disc_.radius; }
  bool addPoint(float square, std::uint32_t index) {
    if (!(dot(cloud_.photons[index].normal, disc_.normal) > 0)) return true;
    if (full() && !(square < squares_.front())) return true;  // a leaf is asked once for the worst
    if (full()) {
      std::pop_heap(squares_.begin(), squares_.end());
      squares_.pop_back();
    }
    squares_.push_back(square);
    std::push_heap(squares_.begin(), squares_.end());
    return true;
  }

 private:
  const Cloud& cloud_;
  const OrientedDisc& disc_;
  const std::size_t count_;
  std::vector<float> squares_;  // a heap: the farthest first
};

}  // namespace

struct PhotonMap::Tree {
  Cloud cloud;
  Index index;

  explicit Tree(std::vector<Photon> photons) : cloud{std::move(photons)}, index(3, cloud) {}

  template <class Results>
  void find(const OrientedDisc& disc, Results& results) const {
    const float centre[3] = {disc.centre.x, disc.centre.y, disc.centre.z};
    index.findNeighbors(results, centre, nanoflann::SearchParams());
  }
};

std::vector<Photon> photons_of(const World& world, OriginSet origins, const PathBatch& batch) {
  std::vector<Photon> photons;
  const SeeSegment see = [&](const Segment& s) {
    if (s.instance == kNone || !contains(origins, s.origin)) return;
    if (world.surfaces.is_pane(world.scene.instances[s.instance].mesh)) return;
    photons.push_back({s.ray.origin + s.ray.direction * s.end, s.end_normal, s.power, s.origin});
  };
  follow_batch(world, batch, see, [] {});
  return photons;
}

PhotonMap::PhotonMap(std::vector<Photon> photons) : tree_(std::make_unique<Tree>(std::move(photons))) {}
PhotonMap::PhotonMap(PhotonMap&&) noexcept = default;
PhotonMap::~PhotonMap() = default;

void PhotonMap::each_near(const OrientedDisc& disc, const std::function<void(const Photon&)>& see) const {
  Within within(tree_->cloud, disc, see);
  tree_->find(disc, within);
}

float PhotonMap::distance_of(std::size_t count, const OrientedDisc& disc) const {
  Nearest nearest(tree_->cloud, disc, count);
  tree_->find(disc, nearest);
  return nearest.full() ? std::sqrt(nearest.worstDist()) : disc.radius;
}

std::size_t PhotonMap::size() const { return tree_->cloud.photons.size(); }

}  // namespace radfarm
