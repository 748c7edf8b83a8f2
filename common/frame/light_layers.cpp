#include "frame/light_layers.h"

#include <cstddef>
#include <string_view>

namespace radfarm {
namespace {

constexpr std::string_view kPrefix = "light.";
constexpr std::string_view kRed = ".R";

std::string channel_of(std::string_view group, char color) { return std::string(kPrefix).append(group) + '.' + color; }

/// What the sums of samples that are `before` become when they stand for `after`.
double rescaled(std::uint32_t before, std::uint32_t after) { return before > 0 ? static_cast<double>(after) / before : 0; }

/// The sum of squares of samples with this variance of their mean.
double squares_of(const PixelSums& pixel, double variance) {
  const double n = pixel.samples, mean = luminance(pixel.reflected()) / n;
  return n * (variance * (n - 1) + mean * mean);
}

PixelSums sum_of(const PixelSums& a, const PixelSums& b) {
  PixelSums sum;
  sum.dropped = a.dropped + b.dropped;
  if (a.samples == 0 || b.samples == 0) return sum;
  sum.samples = a.samples + b.samples;
  for (const PixelSums* one : {&a, &b}) {
    const double scale = rescaled(one->samples, sum.samples);
    sum.emission += one->emission * scale;
    sum.direct += one->direct * scale;
    sum.indirect += one->indirect * scale;
    sum.specular += one->specular * scale;
  }
  sum.squared_luminance = squares_of(sum, variance_of_mean(a) + variance_of_mean(b));
  return sum;
}

/// `scale` keeps means over all samples of a pixel what they were; the rest are means over hits.
void add_aovs(const AovSums& group, double scale, AovSums& sum) {
  sum.albedo = sum.albedo * scale;
  sum.normal = sum.normal * scale;
  const double hits = rescaled(group.hits, sum.hits);
  sum.irradiance += group.irradiance * hits;
  sum.threshold += group.threshold * hits;
  sum.camera_rays += group.camera_rays;
  sum.visibility_rays += group.visibility_rays;
  sum.form_factor_samples += group.form_factor_samples;
}

}  // namespace

void add_light_layer(const std::string& group, const Raster& raster, Image& image) {
  std::vector<float> r, g, b;
  for (const PixelSums& pixel : raster.pixels) {
    const SpectrumD mean = pixel.reflected() / static_cast<double>(pixel.samples);
    r.push_back(static_cast<float>(mean.r));
    g.push_back(static_cast<float>(mean.g));
    b.push_back(static_cast<float>(mean.b));
  }
  image.channels[channel_of(group, 'R')] = std::move(r);
  image.channels[channel_of(group, 'G')] = std::move(g);
  image.channels[channel_of(group, 'B')] = std::move(b);
}

void add_light_group(const Raster& group, Raster& sum) {
  sum.counters += group.counters;
  for (std::size_t i = 0; i < sum.pixels.size(); ++i) {
    const PixelSums both = sum_of(sum.pixels[i], group.pixels[i]);
    if (!sum.aovs.empty()) add_aovs(group.aovs[i], rescaled(sum.pixels[i].samples, both.samples), sum.aovs[i]);
    sum.pixels[i] = both;
    if (!sum.noise.empty()) sum.noise[i] += group.noise[i];
  }
}

std::vector<std::string> light_groups_of(const Image& image) {
  std::vector<std::string> groups;
  for (const auto& [name, values] : image.channels) {
    if (!name.starts_with(kPrefix) || !name.ends_with(kRed)) continue;
    groups.push_back(name.substr(kPrefix.size(), name.size() - kPrefix.size() - kRed.size()));
  }
  return groups;
}

Image light_layer(const Image& image, const std::string& group) {
  Image layer{image.width, image.height, {}, {}};
  for (const char color : {'R', 'G', 'B'}) layer.channels[std::string(1, color)] = image.channels.at(channel_of(group, color));
  return layer;
}

}  // namespace radfarm
