#include "estimate/render_tile.h"

namespace radfarm {
namespace {

constexpr std::uint32_t kFilmDimension = 0;
constexpr std::uint32_t kLensDimension = 7;

}  // namespace

PixelSums sample_pixel(const Film& film, Stream stream, int x, int y, std::uint32_t first, std::uint32_t count,
                       const SampleRadiance& radiance, Counters& counters) {
  PixelSums sums;
  for (std::uint32_t i = first; i < first + count; ++i) {
    const PixelSampler sampler(film.seed, stream, x, y, i);
    const Vec2 jitter = sampler.two(kFilmDimension);
    const float film_x = static_cast<float>(x) + jitter.x, film_y = static_cast<float>(y) + jitter.y;
    Ray ray = film.camera.lens_diameter > 0
                        ? camera_ray(film.camera, film.width, film.height, film_x, film_y, sampler.two(kLensDimension))
                        : camera_ray(film.camera, film.width, film.height, film_x, film_y);
    if (film.cone_samples > 0) ray.cone = pixel_cone(film.camera, film.height, ray.direction, film.cone_samples);
    sums.add(radiance(ray, sampler, counters));
  }
  counters.dropped_samples += sums.dropped;
  return sums;
}

std::vector<PixelSums> render_tile(const Film& film, const PixelRect& rect, std::uint32_t samples,
                                   const SampleRadiance& radiance, Counters& counters) {
  std::vector<PixelSums> sums;
  sums.reserve(static_cast<std::size_t>(rect.width()) * static_cast<std::size_t>(rect.height()));
  for (int y = rect.y0; y < rect.y1; ++y) {
    for (int x = rect.x0; x < rect.x1; ++x) {
      sums.push_back(sample_pixel(film, Stream::kRender, x, y, 0, samples, radiance, counters));
    }
  }
  return sums;
}

}  // namespace radfarm
