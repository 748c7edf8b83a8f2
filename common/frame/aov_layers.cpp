#include "frame/aov_layers.h"

#include <algorithm>
#include <limits>

namespace radfarm {
namespace {

constexpr double kNothing = -1;  // no cell, no vertex

struct Channel {
  Aov aov;
  const char* name;
  double (*value)(const PixelSums&, const AovSums&);
};

/// The mean over those samples that saw a surface, 0 where none did.
double of_hits(double sum, const AovSums& aovs) { return aovs.hits > 0 ? sum / aovs.hits : 0; }

double share(std::size_t kind, const AovSums& aovs) { return aovs.classified > 0 ? aovs.classes[kind] / aovs.classified : 0; }

double number(std::uint32_t id) { return id == kNone ? kNothing : id; }

using P = PixelSums;
using A = AovSums;
constexpr Channel kChannels[] = {
    {Aov::kAlbedo, "albedo.R", [](const P& p, const A& a) { return a.albedo.r / p.samples; }},
    {Aov::kAlbedo, "albedo.G", [](const P& p, const A& a) { return a.albedo.g / p.samples; }},
    {Aov::kAlbedo, "albedo.B", [](const P& p, const A& a) { return a.albedo.b / p.samples; }},
    {Aov::kNormal, "normal.X", [](const P& p, const A& a) { return a.normal.x / p.samples; }},
    {Aov::kNormal, "normal.Y", [](const P& p, const A& a) { return a.normal.y / p.samples; }},
    {Aov::kNormal, "normal.Z", [](const P& p, const A& a) { return a.normal.z / p.samples; }},
    {Aov::kDepth, "depth.Z", [](const P&, const A& a) { return of_hits(a.depth, a); }},
    {Aov::kIrradiance, "irradiance.R", [](const P&, const A& a) { return of_hits(a.irradiance.r, a); }},
    {Aov::kIrradiance, "irradiance.G", [](const P&, const A& a) { return of_hits(a.irradiance.g, a); }},
    {Aov::kIrradiance, "irradiance.B", [](const P&, const A& a) { return of_hits(a.irradiance.b, a); }},
    {Aov::kCameraSamples, "samples.camera", [](const P&, const A& a) { return static_cast<double>(a.camera_rays); }},
    {Aov::kVisibilitySamples, "samples.visibility",
     [](const P&, const A& a) { return static_cast<double>(a.visibility_rays); }},
    {Aov::kFormFactorSamples, "samples.formfactor",
     [](const P&, const A& a) { return static_cast<double>(a.form_factor_samples); }},
    {Aov::kVariance, "variance.Y", [](const P& p, const A&) { return variance_of_mean(p); }},
    {Aov::kClassification, "classification.interpolated", [](const P&, const A& a) { return share(0, a); }},
    {Aov::kClassification, "classification.formfactor", [](const P&, const A& a) { return share(1, a); }},
    {Aov::kClassification, "classification.visibility", [](const P&, const A& a) { return share(2, a); }},
    {Aov::kClassification, "classification.both", [](const P&, const A& a) { return share(3, a); }},
    {Aov::kGrid, "grid.cell", [](const P&, const A& a) { return number(a.cell); }},
    {Aov::kGrid, "grid.vertex", [](const P&, const A& a) { return number(a.vertex); }},
    {Aov::kMasking, "masking.threshold", [](const P&, const A& a) { return of_hits(a.threshold, a); }},
};

/// The block of a film that a pixel lies in, of as many along an axis.
int block_of(int pixel, int pixels, int blocks) { return static_cast<int>(static_cast<std::int64_t>(pixel) * blocks / pixels); }

/// How much the detail that a pixel shows raises what it may be wrong by; 1 without masking.
float elevation_at(const LuminanceImage& elevation, const Image& image, std::size_t pixel) {
  if (elevation.values.empty()) return 1;
  const auto width = static_cast<std::size_t>(image.width);
  const int x = block_of(static_cast<int>(pixel % width), image.width, elevation.width);
  const int y = block_of(static_cast<int>(pixel / width), image.height, elevation.height);
  return elevation.values[static_cast<std::size_t>(y) * static_cast<std::size_t>(elevation.width) + static_cast<std::size_t>(x)];
}

void add_elevation(const Raster& raster, Image& image) {
  std::vector<float>& values = image.channels["masking.elevation"];
  for (std::size_t i = 0; i < raster.pixels.size(); ++i) {
    const bool is_lost = raster.pixels[i].samples == 0;
    values.push_back(is_lost ? std::numeric_limits<float>::quiet_NaN() : elevation_at(raster.elevation, image, i));
  }
}

}  // namespace

void add_aov_layers(AovSet set, const Raster& raster, Image& image) {
  if (contains(set, Aov::kMasking)) add_elevation(raster, image);
  for (const Channel& channel : kChannels) {
    if (!contains(set, channel.aov)) continue;
    std::vector<float>& values = image.channels[channel.name];
    values.reserve(raster.pixels.size());
    for (std::size_t i = 0; i < raster.pixels.size(); ++i) {
      const bool is_lost = raster.pixels[i].samples == 0;
      const double value = is_lost ? std::numeric_limits<double>::quiet_NaN() : channel.value(raster.pixels[i], raster.aovs[i]);
      values.push_back(static_cast<float>(value));
    }
  }
}

}  // namespace radfarm
