#include "frame/aov_picture.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>
#include <span>

#include "image/tone_map.h"
#include "math/spectrum.h"

namespace radfarm {
namespace {

using Values = std::vector<float>;

/// What to make a picture of, from the values of its channels.
struct Drawing {
  std::vector<const char*> channels;
  const char* unit;  // of what is drawn in false colour; none: `draw` makes the pixel
  Rgba8 (*draw)(std::span<const float> values);
  const char* legend;
};

std::uint8_t byte_of(float unit) { return static_cast<std::uint8_t>(std::lround(255 * std::clamp(unit, 0.0F, 1.0F))); }

bool has_nan(std::span<const float> v) { return std::any_of(v.begin(), v.end(), [](float x) { return std::isnan(x); }); }

Rgba8 draw_albedo(std::span<const float> v) {
  return {byte_of(srgb_from_linear(v[0])), byte_of(srgb_from_linear(v[1])), byte_of(srgb_from_linear(v[2])), 255};
}

Rgba8 draw_normal(std::span<const float> v) {
  return {byte_of((v[0] + 1) / 2), byte_of((v[1] + 1) / 2), byte_of((v[2] + 1) / 2), 255};
}

Rgba8 draw_grid(std::span<const float> v) { return color_of_id(v[0]); }

/// Dark blue, green, red and white, by share; black where no sender is.
Rgba8 draw_classes(std::span<const float> v) {
  return {byte_of(v[2] + v[3]), byte_of(v[1] + v[3]), byte_of(0.5F * v[0] + v[3]), 255};
}

Drawing drawing_of(Aov aov) {
  switch (aov) {
    case Aov::kAlbedo: return {{"albedo.R", "albedo.G", "albedo.B"}, nullptr, draw_albedo, "reflectance as it is"};
    case Aov::kNormal: return {{"normal.X", "normal.Y", "normal.Z"}, nullptr, draw_normal, "(n + 1) / 2"};
    case Aov::kDepth: return {{"depth.Z"}, "m", nullptr, ""};
    case Aov::kIrradiance: return {{"irradiance.R", "irradiance.G", "irradiance.B"}, "lux", nullptr, ""};
    case Aov::kCameraSamples: return {{"samples.camera"}, "a pixel", nullptr, ""};
    case Aov::kVisibilitySamples: return {{"samples.visibility"}, "a pixel", nullptr, ""};
    case Aov::kFormFactorSamples: return {{"samples.formfactor"}, "a pixel", nullptr, ""};
    case Aov::kVariance: return {{"variance.Y"}, "(cd/m^2)^2", nullptr, ""};
    case Aov::kClassification:
      return {{"classification.interpolated", "classification.formfactor", "classification.visibility", "classification.both"},
              nullptr,
              draw_classes,
              "senders interpolated: blue; resampled in form factor: green, in visibility: red, in both: white"};
    case Aov::kGrid: return {{"grid.cell", "grid.vertex"}, nullptr, draw_grid, "a colour a cell"};
    case Aov::kMasking: return {{"masking.elevation", "masking.threshold"}, "times the threshold without detail", nullptr, ""};
  }
  return {};
}

/// The values of a pixel that is drawn in false colour: the first, or the luminance of three.
Values brightness(const std::vector<const Values*>& channels) {
  if (channels.size() < 3) return *channels[0];
  Values values;
  for (std::size_t i = 0; i < channels[0]->size(); ++i) {
    values.push_back(luminance(Spectrum((*channels[0])[i], (*channels[1])[i], (*channels[2])[i])));
  }
  return values;
}

/// Depth is 0 where nothing is seen: that is no end of the scale.
Values on_scale(const Values& values, Aov aov) {
  if (aov != Aov::kDepth) return values;
  Values seen;
  std::copy_if(values.begin(), values.end(), std::back_inserter(seen), [](float v) { return v > 0; });
  return seen;
}

AovPicture draw_values(const Values& values, const ValueRange& range, const char* unit) {
  AovPicture picture;
  for (const float value : values) picture.pixels.push_back(viridis(range.place(value)));
  std::array<char, 96> text{};
  std::snprintf(text.data(), text.size(), "%.4g to %.4g %s, violet to yellow", static_cast<double>(range.low),
                static_cast<double>(range.high), unit);
  picture.legend = text.data();
  return picture;
}

}  // namespace

AovSet aovs_of(const Image& image) {
  AovSet set = 0;
  for (std::size_t k = 0; k < kAovCount; ++k) {
    const auto aov = static_cast<Aov>(k);
    const std::vector<const char*> names = drawing_of(aov).channels;
    if (std::all_of(names.begin(), names.end(), [&](const char* name) { return image.channels.contains(name); })) {
      set |= set_of(aov);
    }
  }
  return set;
}

AovPicture draw_aov(const Image& image, Aov aov) {
  const Drawing drawing = drawing_of(aov);
  std::vector<const Values*> channels;
  for (const char* name : drawing.channels) channels.push_back(&image.channels.at(name));
  if (drawing.draw == nullptr) {
    const Values values = brightness(channels);
    return draw_values(values, robust_range(on_scale(values, aov)), drawing.unit);
  }
  AovPicture picture{{}, drawing.legend};
  Values pixel(channels.size());
  for (std::size_t i = 0; i < image.pixel_count(); ++i) {
    for (std::size_t c = 0; c < pixel.size(); ++c) pixel[c] = (*channels[c])[i];
    picture.pixels.push_back(has_nan(pixel) ? kNotANumber : drawing.draw(pixel));
  }
  return picture;
}

}  // namespace radfarm
