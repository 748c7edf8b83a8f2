#include "estimate/render_tile.h"

#include <algorithm>
#include <array>
#include <cmath>

namespace radfarm {
namespace {

constexpr std::uint32_t kFilmDimension = 0;
constexpr std::uint32_t kLensDimension = 7;
// What sharing leaves of the noise where neighbours look at one smooth surface.
constexpr double kSharedNoise = 1.0 / 3;
// Neighbours look at no smooth surface where the mean of their normals is so much shorter than 1, or their places are such a share of
// their distances off a plane.
constexpr double kBent = 0.03, kOffPlane = 0.1;

/// The camera ray of one sample of a pixel.
Ray film_ray(const Film& film, int x, int y, const PixelSampler& sampler) {
  const Vec2 jitter = sampler.two(kFilmDimension);
  const float film_x = static_cast<float>(x) + jitter.x, film_y = static_cast<float>(y) + jitter.y;
  Ray ray = film.camera.lens_diameter > 0
                ? camera_ray(film.camera, film.width, film.height, film_x, film_y, sampler.two(kLensDimension))
                : camera_ray(film.camera, film.width, film.height, film_x, film_y);
  if (film.cone_samples > 0) ray.cone = pixel_cone(film.camera, film.height, ray.direction, film.cone_samples);
  return ray;
}

/// All that is kept of one pixel.
struct Pixel {
  PixelSums light;
  AovSums aovs;
  SharingSums sharing;
  double squared_emission = 0;  // luminance
};

struct Painter {
  const Film& film;
  const SampleRadiance& radiance;
  const SampleEmission& emission;
  Counters& counters;
  Kept kept;
};

/// One sample, and what its pixel keeps of it.
void add_sample(const Painter& painter, int x, int y, std::uint32_t index, Pixel& pixel) {
  const bool is_odd = painter.kept.sharing && index % 2 == 1;
  const std::uint32_t sample = painter.kept.sharing ? index / 2 : index;
  const PixelSampler sampler(painter.film.seed, is_odd ? Stream::kRenderOdd : Stream::kRender, x, y, sample);
  const Ray ray = film_ray(painter.film, x, y, sampler);
  const Counters before = painter.counters;
  FirstSurface seen;
  const bool looks = painter.kept.aovs || painter.kept.sharing;
  const RadianceParts parts = painter.radiance(ray, sampler, painter.counters, looks ? &seen : nullptr);
  pixel.light.add(parts);
  if (painter.kept.aovs) pixel.aovs.add_cost(before, painter.counters);
  if (!is_light(parts)) return;
  const auto emitted = static_cast<double>(luminance(parts.emission));
  pixel.squared_emission += emitted * emitted;
  const Camera& camera = painter.film.camera;
  if (painter.kept.aovs) pixel.aovs.add(seen, dot(seen.position - camera.position, camera.forward));
  if (painter.kept.sharing) pixel.sharing.add(is_odd, parts, seen);
}

/// Samples [first, last) of a pixel.
void add_samples(const Painter& painter, int x, int y, std::uint32_t first, std::uint32_t last, Pixel& pixel) {
  const std::uint32_t dropped = pixel.light.dropped;
  for (std::uint32_t i = first; i < last; ++i) add_sample(painter, x, y, i, pixel);
  painter.counters.dropped_samples += pixel.light.dropped - dropped;
}

/// Samples the emission alone `count` times; its mean with that of the pixel's samples stands for theirs.
void add_emission(const Painter& painter, int x, int y, std::uint32_t count, Pixel& pixel) {
  SpectrumD sum = pixel.light.emission;
  double kept = pixel.light.samples;
  for (std::uint32_t i = 0; i < count; ++i) {
    const PixelSampler sampler(painter.film.seed, Stream::kEmission, x, y, i);
    const Spectrum seen = painter.emission(film_ray(painter.film, x, y, sampler), sampler, painter.counters);
    if (!is_light({seen, {}, {}, {}})) continue;
    sum += SpectrumD(seen);
    kept += 1;
  }
  if (kept > 0) pixel.light.emission = sum * (pixel.light.samples / kept);
}

/// The pixels of a rectangle and one more on each side, as far as the film goes.
PixelRect with_neighbours(const PixelRect& rect, const Film& film) {
  return {std::max(0, rect.x0 - 1), std::max(0, rect.y0 - 1), std::min(film.width, rect.x1 + 1),
          std::min(film.height, rect.y1 + 1)};
}

/// First samples of the pixels of a rectangle.
struct FirstSamples {
  PixelRect rect;
  std::vector<Pixel> pixels;  // row by row
  const Pixel& at(int x, int y) const {
    return pixels[static_cast<std::size_t>(y - rect.y0) * static_cast<std::size_t>(rect.width()) +
                  static_cast<std::size_t>(x - rect.x0)];
  }
};

FirstSamples sample_first(const Painter& painter, const PixelRect& rect, std::uint32_t samples) {
  FirstSamples first{rect, {}};
  first.pixels.reserve(static_cast<std::size_t>(rect.width()) * static_cast<std::size_t>(rect.height()));
  for (int y = rect.y0; y < rect.y1; ++y) {
    for (int x = rect.x0; x < rect.x1; ++x) add_samples(painter, x, y, 0, samples, first.pixels.emplace_back());
  }
  return first;
}

/// Variance of one sample of a pixel's reflected luminance.
double sample_variance(const PixelSums& sums) {
  if (sums.samples < 2) return 0;
  const double n = sums.samples, mean = luminance(sums.reflected()) / n;
  return std::max(0.0, sums.squared_luminance / n - mean * mean) * n / (n - 1);
}

/// The up to eight pixels about one.
struct Neighbours {
  std::array<const Pixel*, 8> pixels;
  std::size_t count = 0;
};

Neighbours neighbours_of(const FirstSamples& first, int x, int y) {
  Neighbours about;
  for (int j = std::max(first.rect.y0, y - 1); j < std::min(first.rect.y1, y + 2); ++j) {
    for (int i = std::max(first.rect.x0, x - 1); i < std::min(first.rect.x1, x + 2); ++i) {
      if (i != x || j != y) about.pixels[about.count++] = &first.at(i, j);
    }
  }
  return about;
}

std::uint32_t within(const SampleBudget& budget, double wanted) {
  return static_cast<std::uint32_t>(
      std::clamp(std::ceil(wanted), static_cast<double>(budget.first), static_cast<double>(budget.most)));
}

/// How little the neighbours look at one smooth surface: 0, they could share their light, to 1.
double roughness(const Neighbours& about) {
  Vec3d normal(0, 0, 0), middle(0, 0, 0);
  double hits = 0, samples = 0;
  for (std::size_t k = 0; k < about.count; ++k) {
    const Pixel& p = *about.pixels[k];
    normal += p.sharing.normal, middle += p.sharing.position;
    hits += p.sharing.hits, samples += p.light.samples;
  }
  if (!(hits > 0) || hits < samples) return 1;
  normal /= hits, middle /= hits;
  double off = 0, away = 0;
  for (std::size_t k = 0; k < about.count; ++k) {
    const SharingSums& s = about.pixels[k]->sharing;
    const Vec3d d = s.position / static_cast<double>(s.hits) - middle;
    off += std::fabs(dot(d, normal)), away += length(d);
  }
  return std::min(1.0, (1 - length(normal)) / kBent + (away > 0 ? off / away / kOffPlane : 0));
}

/// Samples of a pixel by its neighbours' noise.
std::uint32_t samples_for(const Neighbours& about, const SampleBudget& budget, bool shares) {
  if (about.count == 0) return budget.first;
  double variance = 0;
  for (std::size_t k = 0; k < about.count; ++k) variance += sample_variance(about.pixels[k]->light);
  const double alone = shares ? kSharedNoise + (1 - kSharedNoise) * roughness(about) : 1;
  return within(budget, alone * std::sqrt(variance / static_cast<double>(about.count)) / static_cast<double>(budget.noise));
}

/// Samples of a pixel's emission by how its neighbours' differs, within them and among them.
std::uint32_t emission_samples_for(const Neighbours& about, const SampleBudget& budget) {
  double sum = 0, squares = 0, samples = 0;
  for (std::size_t k = 0; k < about.count; ++k) {
    sum += luminance(about.pixels[k]->light.emission);
    squares += about.pixels[k]->squared_emission;
    samples += about.pixels[k]->light.samples;
  }
  if (!(samples > 0)) return budget.first;
  const double variance = squares / samples - sum / samples * (sum / samples);
  return within(budget, std::sqrt(std::max(0.0, variance)) / static_cast<double>(budget.noise));
}

/// What the neighbours make a pixel need beyond its first samples.
void add_more(const Painter& painter, const SampleBudget& budget, const Neighbours& about, int x, int y, Pixel& pixel) {
  const std::uint32_t samples = samples_for(about, budget, painter.kept.sharing);
  add_samples(painter, x, y, budget.first, samples, pixel);
  if (!painter.emission) return;
  const std::uint32_t of_emission = emission_samples_for(about, budget);
  if (of_emission > samples) add_emission(painter, x, y, of_emission - samples, pixel);
}

void keep(const Kept& kept, const Pixel& pixel, TilePixels& tile) {
  tile.light.push_back(pixel.light);
  if (kept.aovs) tile.aovs.push_back(pixel.aovs);
  if (kept.sharing) tile.sharing.push_back(pixel.sharing);
}

}  // namespace

PixelSums sample_pixel(const Film& film, Stream stream, int x, int y, std::uint32_t first, std::uint32_t count,
                       const SampleRadiance& radiance, Counters& counters) {
  PixelSums sums;
  for (std::uint32_t i = first; i < first + count; ++i) {
    const PixelSampler sampler(film.seed, stream, x, y, i);
    sums.add(radiance(film_ray(film, x, y, sampler), sampler, counters, nullptr));
  }
  counters.dropped_samples += sums.dropped;
  return sums;
}

TilePixels render_tile(const Film& film, const PixelRect& rect, const SampleBudget& budget, const SampleRadiance& radiance,
                       Counters& counters, const Kept& kept, const SampleEmission& emission) {
  const Painter painter{film, radiance, emission, counters, kept};
  const bool is_even = !(budget.noise > 0) || budget.most <= budget.first;
  const FirstSamples first = sample_first(painter, is_even ? rect : with_neighbours(rect, film), budget.first);
  TilePixels tile;
  for (int y = rect.y0; y < rect.y1; ++y) {
    for (int x = rect.x0; x < rect.x1; ++x) {
      Pixel pixel = first.at(x, y);
      if (!is_even) add_more(painter, budget, neighbours_of(first, x, y), x, y, pixel);
      keep(kept, pixel, tile);
    }
  }
  return tile;
}

}  // namespace radfarm
