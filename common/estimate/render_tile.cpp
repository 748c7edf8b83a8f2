#include "estimate/render_tile.h"

#include <algorithm>
#include <cmath>

namespace radfarm {
namespace {

constexpr std::uint32_t kFilmDimension = 0;
constexpr std::uint32_t kLensDimension = 7;

/// One sample, and what its pixel's AOVs get of it.
RadianceParts sample_aovs(const Film& film, const Ray& ray, const PixelSampler& sampler, const SampleRadiance& radiance,
                          Counters& counters, AovSums& aovs) {
  const Counters before = counters;
  FirstSurface seen;
  const RadianceParts parts = radiance(ray, sampler, counters, &seen);
  aovs.add_cost(before, counters);
  if (is_light(parts)) aovs.add(seen, dot(seen.position - film.camera.position, film.camera.forward));
  return parts;
}

}  // namespace

PixelSums sample_pixel(const Film& film, Stream stream, int x, int y, std::uint32_t first, std::uint32_t count,
                       const SampleRadiance& radiance, Counters& counters, AovSums* aovs) {
  PixelSums sums;
  for (std::uint32_t i = first; i < first + count; ++i) {
    const PixelSampler sampler(film.seed, stream, x, y, i);
    const Vec2 jitter = sampler.two(kFilmDimension);
    const float film_x = static_cast<float>(x) + jitter.x, film_y = static_cast<float>(y) + jitter.y;
    Ray ray = film.camera.lens_diameter > 0
                        ? camera_ray(film.camera, film.width, film.height, film_x, film_y, sampler.two(kLensDimension))
                        : camera_ray(film.camera, film.width, film.height, film_x, film_y);
    if (film.cone_samples > 0) ray.cone = pixel_cone(film.camera, film.height, ray.direction, film.cone_samples);
    sums.add(aovs != nullptr ? sample_aovs(film, ray, sampler, radiance, counters, *aovs)
                             : radiance(ray, sampler, counters, nullptr));
  }
  counters.dropped_samples += sums.dropped;
  return sums;
}

namespace {

/// The pixels of a rectangle and one more on each side, as far as the film goes.
PixelRect with_neighbours(const PixelRect& rect, const Film& film) {
  return {std::max(0, rect.x0 - 1), std::max(0, rect.y0 - 1), std::min(film.width, rect.x1 + 1),
          std::min(film.height, rect.y1 + 1)};
}

/// First samples of the pixels of a rectangle.
struct FirstSamples {
  PixelRect rect;
  std::vector<PixelSums> pixels;  // row by row
  std::vector<AovSums> aovs;      // one a pixel, or none
  std::size_t index(int x, int y) const {
    return static_cast<std::size_t>(y - rect.y0) * static_cast<std::size_t>(rect.width()) + static_cast<std::size_t>(x - rect.x0);
  }
};

FirstSamples sample_first(const Film& film, const PixelRect& rect, std::uint32_t samples, const SampleRadiance& radiance,
                          Counters& counters, bool with_aovs) {
  const std::size_t count = static_cast<std::size_t>(rect.width()) * static_cast<std::size_t>(rect.height());
  FirstSamples first{rect, {}, std::vector<AovSums>(with_aovs ? count : 0)};
  first.pixels.reserve(count);
  for (int y = rect.y0; y < rect.y1; ++y) {
    for (int x = rect.x0; x < rect.x1; ++x) {
      AovSums* const aovs = with_aovs ? &first.aovs[first.pixels.size()] : nullptr;
      first.pixels.push_back(sample_pixel(film, Stream::kRender, x, y, 0, samples, radiance, counters, aovs));
    }
  }
  return first;
}

/// Variance of one sample of a pixel's reflected luminance.
double sample_variance(const PixelSums& sums) {
  if (sums.samples < 2) return 0;
  const double n = sums.samples, mean = luminance(sums.reflected()) / n;
  return std::max(0.0, sums.squared_luminance / n - mean * mean) * n / (n - 1);
}

/// Samples of a pixel by its neighbours' noise.
std::uint32_t samples_for(const FirstSamples& first, const SampleBudget& budget, int x, int y) {
  double variance = 0;
  int neighbours = 0;
  for (int j = std::max(first.rect.y0, y - 1); j < std::min(first.rect.y1, y + 2); ++j) {
    for (int i = std::max(first.rect.x0, x - 1); i < std::min(first.rect.x1, x + 2); ++i) {
      if (i == x && j == y) continue;
      variance += sample_variance(first.pixels[first.index(i, j)]);
      ++neighbours;
    }
  }
  if (neighbours == 0) return budget.first;
  const double wanted = std::sqrt(variance / neighbours) / static_cast<double>(budget.noise);
  return static_cast<std::uint32_t>(
      std::clamp(std::ceil(wanted), static_cast<double>(budget.first), static_cast<double>(budget.most)));
}

}  // namespace

std::vector<PixelSums> render_tile(const Film& film, const PixelRect& rect, const SampleBudget& budget,
                                   const SampleRadiance& radiance, Counters& counters, std::vector<AovSums>* aovs) {
  const bool is_even = !(budget.noise > 0) || budget.most <= budget.first;
  FirstSamples first = sample_first(film, is_even ? rect : with_neighbours(rect, film), budget.first, radiance, counters,
                                    aovs != nullptr);
  if (aovs != nullptr) aovs->clear();
  std::vector<PixelSums> pixels;
  pixels.reserve(static_cast<std::size_t>(rect.width()) * static_cast<std::size_t>(rect.height()));
  for (int y = rect.y0; y < rect.y1; ++y) {
    for (int x = rect.x0; x < rect.x1; ++x) {
      pixels.push_back(first.pixels[first.index(x, y)]);
      if (aovs != nullptr) aovs->push_back(first.aovs[first.index(x, y)]);
      const std::uint32_t more = is_even ? 0 : samples_for(first, budget, x, y) - budget.first;
      pixels.back().add(sample_pixel(film, Stream::kRender, x, y, budget.first, more, radiance, counters,
                                     aovs != nullptr ? &aovs->back() : nullptr));
    }
  }
  return pixels;
}

}  // namespace radfarm
