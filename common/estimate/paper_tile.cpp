#include "estimate/paper_tile.h"

#include <array>
#include <cmath>
#include <optional>

namespace radfarm {
namespace {

constexpr std::uint32_t kLensDimension = 7;
constexpr float kMostTurned = 0.9F;  // cosine between the normals of what counts as one object
constexpr float kMostApart = 0.05F;  // of the distance, off each other's plane

/// What a corner of a pixel sees.
struct Corner {
  RadianceParts parts;
  std::optional<Hit> hit;
  SurfacePoint point;
};

Corner look_through(const World& world, const Film& film, int x, int y, const SampleRadiance& radiance, Counters& counters) {
  const PixelSampler sampler(film.seed, Stream::kCorner, x, y, 0);
  const float film_x = static_cast<float>(x), film_y = static_cast<float>(y);
  // Without a lens, camera_ray() takes any point of it for the pinhole.
  Ray ray = camera_ray(film.camera, film.width, film.height, film_x, film_y, sampler.two(kLensDimension));
  if (film.cone_samples > 0) ray.cone = pixel_cone(film.camera, film.height, ray.direction, 1);
  Corner corner{radiance(ray, sampler, counters, nullptr), world.caster.closest(ray, sampler.key(kLensDimension)), {}};
  if (corner.hit) {
    corner.point = world.surfaces.at(*corner.hit);
    face(corner.point, -ray.direction);
  }
  return corner;
}

bool is_one_object(const Corner& a, const Corner& b) {
  if (!a.hit || !b.hit) return !a.hit && !b.hit;
  if (a.hit->instance != b.hit->instance || a.point.material != b.point.material) return false;
  if (dot(a.point.geometric_normal, b.point.geometric_normal) < kMostTurned) return false;
  return std::fabs(dot(a.point.geometric_normal, b.point.position - a.point.position)) <= kMostApart * a.hit->distance;
}

}  // namespace

std::vector<PixelSums> render_paper_tile(const World& world, const Film& film, const PixelRect& rect, std::uint32_t samples,
                                         const SampleRadiance& radiance, Counters& counters) {
  std::vector<Corner> corners;
  for (int y = rect.y0; y <= rect.y1; ++y) {
    for (int x = rect.x0; x <= rect.x1; ++x) corners.push_back(look_through(world, film, x, y, radiance, counters));
  }
  const auto corner = [&](int x, int y) -> const Corner& {
    return corners[static_cast<std::size_t>((y - rect.y0) * (rect.width() + 1) + x - rect.x0)];
  };
  std::vector<PixelSums> pixels;
  for (int y = rect.y0; y < rect.y1; ++y) {
    for (int x = rect.x0; x < rect.x1; ++x) {
      const std::array around{&corner(x, y), &corner(x + 1, y), &corner(x, y + 1), &corner(x + 1, y + 1)};
      PixelSums sums;
      bool is_even = true;
      for (const Corner* one : around) {
        sums.add(one->parts);
        is_even = is_even && is_one_object(*around[0], *one);
      }
      counters.dropped_samples += sums.dropped;
      if (!is_even) sums.add(sample_pixel(film, Stream::kRender, x, y, 0, samples, radiance, counters));
      pixels.push_back(sums);
    }
  }
  return pixels;
}

}  // namespace radfarm
