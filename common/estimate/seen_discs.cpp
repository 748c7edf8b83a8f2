#include "estimate/seen_discs.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <utility>

#include "base/parallel.h"
#include "paths/photon_map.h"
#include "paths/radius.h"

namespace radfarm {
namespace {

constexpr float kOneSurface = 0.95F;  // cosine between normals of what shares a disc
constexpr float kFlat = 0.1F;         // height over the tangent plane, over the distance
constexpr float kWide = 4;            // footprints that one disc stands for

/// Nothing shines on anything.
class Darkness : public DiffuseLight {
 public:
  Arrived seen(const SeenPoint&, const PixelSampler&, Counters&) const override { return {}; }
  Arrived beyond(const Hit&, const Vertex&, const Spectrum&, const PixelSampler&, std::uint32_t,
                 Counters&) const override {
    return {};
  }
};

/// The discs of one pixel, in the making.
class PixelDiscs {
 public:
  PixelDiscs(const Components& components, const Film& film, std::uint32_t pixel, std::uint32_t samples)
      : components_(components), film_(film), pixel_(pixel), share_(1 / static_cast<float>(samples)) {}

  void see(const Hit& hit, const SurfacePoint& point, const Spectrum& weight) {
    const Disc disc = disc_at(point, components_.of(hit.instance, hit.triangle), 1);
    const float footprint = footprint_at(point.position);
    for (std::size_t i = 0; i < found.discs.size(); ++i) {
      if (!is_shared(found.discs[i], disc, footprint)) continue;
      found.shown[i].weight += weight * share_;
      return;
    }
    found.discs.push_back(disc);
    found.shown.push_back({pixel_, weight * share_});
    found.footprints.push_back(footprint);
  }

  SeenDiscs found;

 private:
  static bool is_shared(const Disc& a, const Disc& b, float footprint) {
    if (a.component != b.component || dot(a.shape.normal, b.shape.normal) < kOneSurface) return false;
    const Vec3 across = b.shape.centre - a.shape.centre;
    const float distance = length(across);
    return distance <= kWide * footprint && std::fabs(dot(across, a.geometric_normal)) <= kFlat * distance;
  }

  /// How wide a pixel is across the view there, as if it were seen straight.
  float footprint_at(const Vec3& position) const {
    const Camera& camera = film_.camera;
    const auto height = static_cast<float>(film_.height);
    if (camera.kind == Camera::Kind::kOrthographic) return 2 * camera.half_height / height;
    return 2 * std::tan(camera.vertical_fov / 2) / height * length(position - camera.position);
  }

  const Components& components_;
  const Film& film_;
  const std::uint32_t pixel_;
  const float share_;
};

SeenDiscs see_pixel(const World& world, const Components& components, const Film& film, std::uint32_t pixel,
                    std::uint32_t samples) {
  const int x = static_cast<int>(pixel) % film.width, y = static_cast<int>(pixel) / film.width;
  PixelDiscs pixel_discs(components, film, pixel, samples);
  const SeeReceiver see = [&](const Hit& hit, const SurfacePoint& point, const Spectrum& weight) {
    pixel_discs.see(hit, point, weight);
  };
  const Darkness dark;
  const EyeChainContext context{world, dark, true, nullptr, &see};
  Counters counters;
  const SampleRadiance look = [&](const Ray& ray, const PixelSampler& sampler, Counters& c, FirstSurface*) {
    return trace_eye_chain(context, ray, sampler, c);
  };
  (void)sample_pixel(film, Stream::kPhotonView, x, y, 0, samples, look, counters);
  return std::move(pixel_discs.found);
}

void append(SeenDiscs&& more, SeenDiscs& all) {
  all.discs.insert(all.discs.end(), more.discs.begin(), more.discs.end());
  all.shown.insert(all.shown.end(), more.shown.begin(), more.shown.end());
  all.footprints.insert(all.footprints.end(), more.footprints.begin(), more.footprints.end());
}

SeenDiscs see_all(const World& world, const Components& components, const Film& film, std::uint32_t samples) {
  const std::size_t pixels = static_cast<std::size_t>(film.width) * static_cast<std::size_t>(film.height);
  constexpr std::size_t kGrain = 256;
  std::vector<SeenDiscs> pieces((pixels + kGrain - 1) / kGrain);
  parallel_for(pixels, kGrain, [&](std::size_t begin, std::size_t end) {
    for (std::size_t i = begin; i < end; ++i) {
      append(see_pixel(world, components, film, static_cast<std::uint32_t>(i), samples), pieces[begin / kGrain]);
    }
  });
  SeenDiscs all;
  for (SeenDiscs& piece : pieces) append(std::move(piece), all);
  return all;
}

std::vector<float> radii_of(const World& world, const Components& components, const SeenDiscs& seen, std::uint64_t seed,
                            const SeenDiscSettings& settings) {
  const PathBatch paths{seed, 0, settings.photons};
  const auto crossings = static_cast<double>(settings.crossings);
  const float most = kMostRadius * world.radius;
  return settings.is_map
             ? radii_by_nearest(world, seen.discs, settings.origins, paths, crossings, seen.footprints, most)
             : radii_by_pilot(world, components, seen.discs, settings.origins, paths, crossings, seen.footprints, most);
}

/// Radiance that a batch brings pixels by their discs.
class PixelLight {
 public:
  PixelLight(std::span<const ShownDisc> shown, std::size_t pixels) : shown_(shown), sums_(pixels) {}

  void add(std::uint32_t disc, const Spectrum& power, Origin origin, double area) {
    Sums& pixel = sums_[shown_[disc].pixel];
    SpectrumD& part =
        origin == Origin::kEmitter ? pixel.direct : (origin == Origin::kDiffuse ? pixel.indirect : pixel.specular);
    part += SpectrumD(power) * SpectrumD(shown_[disc].weight) * (1 / area);
  }

  PhotonResult result(std::uint64_t paths) const {
    PhotonResult result;
    result.paths = paths;
    result.pixels.reserve(sums_.size());
    for (const Sums& s : sums_)
      result.pixels.push_back({Spectrum(s.direct), Spectrum(s.indirect), Spectrum(s.specular)});
    return result;
  }

 private:
  struct Sums {
    SpectrumD direct, indirect, specular;
  };
  const std::span<const ShownDisc> shown_;
  std::vector<Sums> sums_;
};

}  // namespace

SeenDiscs see_discs(const World& world, const Components& components, const Film& film,
                    const SeenDiscSettings& settings) {
  SeenDiscs seen = see_all(world, components, film, settings.samples);
  if (settings.radius > 0) {
    for (Disc& disc : seen.discs) disc.shape.radius = settings.radius;
  } else if (world.emitters.size() > 0) {
    const std::vector<float> radii = radii_of(world, components, seen, film.seed, settings);
    for (std::size_t i = 0; i < radii.size(); ++i) seen.discs[i].shape.radius = radii[i];
  }
  return seen;
}

PhotonResult bring_light(const World& world, const DiscSet& set, std::span<const ShownDisc> shown, std::size_t pixels,
                         OriginSet origins, const PathBatch& batch) {
  PixelLight light(shown, pixels);
  SeeCrossings see;
  see.crossing = [&](const Segment& segment, std::uint32_t disc, const CountedArea& area) {
    light.add(disc, segment.power, segment.origin, area.whole);
  };
  if (world.emitters.size() > 0) each_crossing(world, set, origins, batch, see);
  return light.result(batch.paths);
}

PhotonResult bring_photons(const World& world, const SeenDiscs& seen, std::size_t pixels, OriginSet origins,
                           const PathBatch& batch) {
  PixelLight light(seen.shown, pixels);
  if (!(world.emitters.size() > 0)) return light.result(batch.paths);
  const PhotonMap map(photons_of(world, origins, batch));
  for (std::uint32_t i = 0; i < seen.discs.size(); ++i) {
    const OrientedDisc& disc = seen.discs[i].shape;
    const double area = std::numbers::pi * static_cast<double>(disc.radius) * static_cast<double>(disc.radius);
    map.each_near(disc, [&](const Photon& photon) { light.add(i, photon.power, photon.origin, area); });
  }
  return light.result(batch.paths);
}

RadianceParts unlit_radiance(const World& world, const Ray& ray, const PixelSampler& sampler, Counters& counters,
                             FirstSurface* first) {
  const Darkness dark;
  return trace_eye_chain({world, dark, true, first, nullptr}, ray, sampler, counters);
}

}  // namespace radfarm
