#include "scene/environment_light.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

#include "base/parallel.h"
#include "scene/cumulative.h"

namespace radfarm {
namespace {

constexpr double kPiD = std::numbers::pi;
constexpr double kByPower = 0.9;

float to_pdf(double pdf) {
  // Light from where a float cannot tell the density from 0 must stay finite when divided by it.
  return pdf > 0 ? std::max(static_cast<float>(pdf), std::numeric_limits<float>::min()) : 0;
}

}  // namespace

EnvironmentLight::EnvironmentLight(const Environment& environment) : environment_(&environment) {
  if (environment.width > 0 && environment.height > 0) add_map();
  add_sun();
  double solid_angle = 0;
  for (const SkyPatch& p : patches_) solid_angle += static_cast<double>(p.solid_angle);
  const double power = luminance(total_);
  std::vector<double> weights;
  for (std::uint32_t i = 0; i < patches_.size(); ++i) {
    weights.push_back(kByPower * power_of(i) / power +
                      (1 - kByPower) * static_cast<double>(patches_[i].solid_angle) / solid_angle);
  }
  choice_ = DiscreteDistribution(weights);
}

void EnvironmentLight::add_map() {
  map_.emplace(*environment_);
  const std::uint32_t width = map_->width();
  column_sums_.resize(std::size_t{width} * map_->height());
  parallel_for(map_->height(), 16, [&](std::size_t begin, std::size_t end) {
    for (auto row = static_cast<std::uint32_t>(begin); row < end; ++row) {
      for (std::uint32_t c = 0; c < width; ++c) {
        column_sums_[std::size_t{row} * width + c] = luminance(map_->integral({row, c}));
      }
    }
  });
  tree_ = PatchTree(*map_, column_sums_);
  std::vector<Vec3d> meridians;  // of the columns' middles, on the horizon
  for (std::uint32_t c = 0; c < width; ++c) meridians.push_back(direction_at({2 * kPiD * (c + 0.5) / width, kPiD / 2}));
  for (const TexelRect& rect : tree_.rects()) add_patch(rect, meridians);
  for (const Spectrum& texel : environment_->radiance) max_luminance_ = std::max(max_luminance_, luminance(texel));
}

void EnvironmentLight::add_patch(const TexelRect& rect, std::span<const Vec3d> meridians) {
  SpectrumD irradiance;
  Vec3d towards(0.0);
  double solid_angle = 0, rows = 0;
  first_row_.push_back(row_sums_.size());
  for (std::uint32_t row = rect.row_begin; row < rect.row_end; ++row) {
    double columns = 0;
    Vec3d across(0.0);
    for (std::uint32_t c = rect.column_begin; c < rect.column_end; ++c) {
      double& power = column_sums_[std::size_t{row} * map_->width() + c];
      irradiance += map_->integral({row, c});
      across += meridians[c] * power;
      columns += power;
      power = columns;
    }
    const double colatitude = map_->place_in({row, 0}, 0.5, 0.5).colatitude;
    towards += across * std::sin(colatitude) + Vec3d(0, columns * std::cos(colatitude), 0);
    rows += columns;
    row_sums_.push_back(rows);
    solid_angle += map_->solid_angle(row) * (rect.column_end - rect.column_begin);
  }
  total_ += irradiance;
  // Opposite directions of a map of few texels may cancel.
  const LatLongMap::Texel centre{(rect.row_begin + rect.row_end) / 2, (rect.column_begin + rect.column_end) / 2};
  const bool has_mean = length(towards) > 1e-6 * rows;
  SkyPatch patch;
  patch.direction = to_float(has_mean ? normalize(towards) : direction_at(map_->place_in(centre, 0, 0)));
  patch.texels = rect;
  push_patch(patch, irradiance, solid_angle);
}

void EnvironmentLight::push_patch(SkyPatch patch, const SpectrumD& irradiance, double solid_angle) {
  patch.irradiance = Spectrum(irradiance);
  patch.solid_angle = static_cast<float>(solid_angle);
  patch.illuminance = static_cast<float>(luminance(irradiance));
  patch.radius = static_cast<float>(std::sqrt(solid_angle / kPiD));
  patches_.push_back(patch);
}

void EnvironmentLight::add_sun() {
  const Environment::Sun& sun = environment_->sun;
  sun_direction_ = normalize(to_double(sun.direction));
  sun_height_ = 1 - static_cast<double>(sun.cos_radius);
  if (!(luminance(sun.radiance) > 0) || !(sun_height_ > 0)) return;
  const float behind = map_ ? luminance(map_->radiance(latlong_of(sun_direction_))) : 0;
  max_luminance_ = std::max(max_luminance_, luminance(sun.radiance) + behind);
  SkyPatch patch;
  patch.direction = sun.direction;
  const double solid_angle = 2 * kPiD * sun_height_;
  const SpectrumD irradiance = SpectrumD(sun.radiance) * solid_angle;
  total_ += irradiance;
  push_patch(patch, irradiance, solid_angle);
  has_sun_ = true;
}

bool EnvironmentLight::is_in_sun(const Vec3d& direction) const {
  // 1 - cosine is half the squared chord, which keeps the digits that the cosine of a small angle has lost.
  const Vec3d chord = normalize(direction) - sun_direction_;
  return has_sun_ && dot(chord, chord) / 2 <= sun_height_;
}

Spectrum EnvironmentLight::radiance(const Vec3& direction) const {
  const Vec3d way = to_double(direction);
  Spectrum sum = map_ ? map_->radiance(latlong_of(way)) : Spectrum();
  if (is_in_sun(way)) sum += environment_->sun.radiance;
  return sum;
}

double EnvironmentLight::power_of(std::uint32_t patch) const {
  if (is_sun(patch)) return luminance(SpectrumD(environment_->sun.radiance)) * (2 * kPiD * sun_height_);
  const TexelRect& rect = patches_[patch].texels;
  return row_sums_[first_row_[patch] + (rect.row_end - rect.row_begin) - 1];
}

double EnvironmentLight::pdf_in_patch(std::uint32_t patch, const LatLongMap::Texel& texel) const {
  return luminance(map_->integral(texel)) / power_of(patch) / map_->solid_angle(texel.row);
}

double EnvironmentLight::pdf_of_map(const LatLongMap::Texel& texel) const {
  const std::uint32_t patch = tree_.find(texel);
  return patch == kNone ? 0 : choice_.probability(patch) * pdf_in_patch(patch, texel);
}

double EnvironmentLight::pdf_of_sun() const {
  return choice_.probability(patches_.size() - 1) / (2 * kPiD * sun_height_);
}

float EnvironmentLight::pdf(const Vec3& direction) const {
  const Vec3d way = to_double(direction);
  const double from_map = map_ ? pdf_of_map(map_->texel_at(latlong_of(way))) : 0;
  return to_pdf(from_map + (is_in_sun(way) ? pdf_of_sun() : 0));
}

EnvironmentLight::Choice EnvironmentLight::choose_texel(const SkyPatch& patch, std::size_t first_row,
                                                        const Vec2& u) const {
  const TexelRect& rect = patch.texels;
  const std::size_t rows = rect.row_end - rect.row_begin, columns = rect.column_end - rect.column_begin;
  const CumulativePosition row = find_in_sums(std::span(row_sums_).subspan(first_row, rows), static_cast<double>(u.x));
  Choice choice;
  choice.texel.row = rect.row_begin + static_cast<std::uint32_t>(row.index);
  const std::size_t start = std::size_t{choice.texel.row} * map_->width() + rect.column_begin;
  const CumulativePosition column =
      find_in_sums(std::span(column_sums_).subspan(start, columns), static_cast<double>(u.y));
  choice.texel.column = rect.column_begin + static_cast<std::uint32_t>(column.index);
  choice.place = map_->place_in(choice.texel, column.share, row.share);
  return choice;
}

Vec3 EnvironmentLight::sample_sun(const Vec2& u) const {
  const double below = static_cast<double>(u.x) * sun_height_, angle = 2 * kPiD * static_cast<double>(u.y);
  const double sine = std::sqrt(std::max(0.0, below * (2 - below)));
  const Frame frame(to_float(sun_direction_));
  const Vec3d across = to_double(frame.tangent) * std::cos(angle) + to_double(frame.bitangent) * std::sin(angle);
  return to_float(normalize(sun_direction_ * (1 - below) + across * sine));
}

EnvironmentLight::Sample EnvironmentLight::sample(double choice, const Vec2& u) const {
  const auto patch = static_cast<std::uint32_t>(choice_.sample(choice).index);
  Sample sample;
  if (!is_sun(patch)) {
    const Choice chosen = choose_texel(patches_[patch], first_row_[patch], u);
    sample.direction = to_float(direction_at(chosen.place));
    const Vec3d rounded = to_double(sample.direction);
    const bool in_sun = is_in_sun(rounded);
    // What radiance() and pdf() say of this direction; but rounding may step over an edge into the dark.
    const LatLong place = latlong_of(rounded);
    const double from_map = pdf_of_map(map_->texel_at(place));
    sample.radiance = map_->radiance(place) + (in_sun ? environment_->sun.radiance : Spectrum());
    sample.pdf = to_pdf((from_map > 0 ? from_map : pdf_of_map(chosen.texel)) + (in_sun ? pdf_of_sun() : 0));
    return sample;
  }
  sample.direction = sample_sun(u);
  // What was drawn from the disc is in it, even if rounding moved it over the edge.
  const LatLong place = latlong_of(to_double(sample.direction));
  sample.radiance = environment_->sun.radiance + (map_ ? map_->radiance(place) : Spectrum());
  sample.pdf = to_pdf(pdf_of_sun() + (map_ ? pdf_of_map(map_->texel_at(place)) : 0));
  return sample;
}

EnvironmentLight::Sample EnvironmentLight::sample_map(double choice, const Vec2& u) const {
  const double share = has_sun_ ? 1 - choice_.probability(patches_.size() - 1) : 1;
  const auto chosen = choice_.sample(choice * share);  // the sun is last
  Sample sample = sample_patch(static_cast<std::uint32_t>(chosen.index), u);
  sample.pdf = to_pdf(static_cast<double>(sample.pdf) * chosen.probability / share);
  return sample;
}

EnvironmentLight::Sample EnvironmentLight::sample_patch(std::uint32_t patch, const Vec2& u) const {
  if (is_sun(patch)) {
    return {sample_sun(u), environment_->sun.radiance, to_pdf(1 / (2 * kPiD * sun_height_))};
  }
  const Choice chosen = choose_texel(patches_[patch], first_row_[patch], u);
  return {to_float(direction_at(chosen.place)), map_->radiance(chosen.place),
          to_pdf(pdf_in_patch(patch, chosen.texel))};
}

}  // namespace radfarm
