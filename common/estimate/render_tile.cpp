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
  PixelNeeds needs;
  double squared_emission = 0;  // luminance, of its first samples
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

/// Samples the emission alone, up to `wanted` times in all.
void add_emission(const Painter& painter, int x, int y, std::uint32_t wanted, Pixel& pixel) {
  PixelNeeds& needs = pixel.needs;
  for (; needs.emission_taken < wanted; ++needs.emission_taken) {
    const PixelSampler sampler(painter.film.seed, Stream::kEmission, x, y, needs.emission_taken);
    const Spectrum seen = painter.emission(film_ray(painter.film, x, y, sampler), sampler, painter.counters);
    if (!is_light({seen, {}, {}, {}})) continue;
    needs.emission_sum += SpectrumD(seen);
    ++needs.emission_kept;
  }
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

/// How much samples scatter that a pixel's light needs, cd/m^2, by its neighbours' noise.
double light_needs(const Neighbours& about, bool shares) {
  if (about.count == 0) return 0;
  double variance = 0;
  for (std::size_t k = 0; k < about.count; ++k) variance += sample_variance(about.pixels[k]->light);
  const double alone = shares ? kSharedNoise + (1 - kSharedNoise) * roughness(about) : 1;
  return alone * std::sqrt(variance / static_cast<double>(about.count));
}

/// The same of its emission, by how its neighbours' differs, within them and among them.
double emission_needs(const Neighbours& about) {
  double sum = 0, squares = 0, samples = 0;
  for (std::size_t k = 0; k < about.count; ++k) {
    sum += luminance(about.pixels[k]->light.emission);
    squares += about.pixels[k]->squared_emission;
    samples += about.pixels[k]->light.samples;
  }
  if (!(samples > 0)) return 0;
  const double variance = squares / samples - sum / samples * (sum / samples);
  return std::sqrt(std::max(0.0, variance));
}

/// What a pixel lacks of the budget.
void add_more(const Painter& painter, const SampleBudget& budget, int x, int y, Pixel& pixel) {
  const std::uint32_t taken = pixel.light.samples + pixel.light.dropped;
  add_samples(painter, x, y, taken, samples_of(budget, pixel.needs), pixel);
  if (painter.emission) add_emission(painter, x, y, emission_samples_of(budget, pixel.needs), pixel);
}

void keep(const Kept& kept, bool has_needs, const Pixel& pixel, TilePixels& tile) {
  tile.light.push_back(pixel.light);
  if (kept.aovs) tile.aovs.push_back(pixel.aovs);
  if (kept.sharing) tile.sharing.push_back(pixel.sharing);
  if (has_needs) tile.needs.push_back(pixel.needs);
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
  const FirstSamples first = sample_first(painter, is_even(budget) ? rect : with_neighbours(rect, film), budget.first);
  TilePixels tile;
  for (int y = rect.y0; y < rect.y1; ++y) {
    for (int x = rect.x0; x < rect.x1; ++x) {
      Pixel pixel = first.at(x, y);
      if (!is_even(budget)) {
        const Neighbours about = neighbours_of(first, x, y);
        pixel.needs.light = light_needs(about, kept.sharing);
        pixel.needs.emission = emission ? emission_needs(about) : 0;
      }
      add_more(painter, budget, x, y, pixel);
      keep(kept, !is_even(budget), pixel, tile);
    }
  }
  return tile;
}

TilePixels resume_tile(const Film& film, const PixelRect& rect, const SampleBudget& budget, const SampleRadiance& radiance,
                       Counters& counters, const Kept& kept, const SampleEmission& emission, const TilePixels& before) {
  const Painter painter{film, radiance, emission, counters, kept};
  TilePixels tile;
  std::size_t i = 0;
  for (int y = rect.y0; y < rect.y1; ++y) {
    for (int x = rect.x0; x < rect.x1; ++x, ++i) {
      Pixel pixel;
      pixel.light = before.light[i];
      if (kept.aovs) pixel.aovs = before.aovs[i];
      if (kept.sharing) pixel.sharing = before.sharing[i];
      if (!is_even(budget)) pixel.needs = before.needs[i];
      add_more(painter, budget, x, y, pixel);
      keep(kept, !is_even(budget), pixel, tile);
    }
  }
  return tile;
}

}  // namespace radfarm
