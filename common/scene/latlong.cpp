#include "scene/latlong.h"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace radfarm {
namespace {

constexpr double kPiD = std::numbers::pi;

}  // namespace

Vec3d direction_at(const LatLong& place) {
  const double sine = std::sin(place.colatitude);
  return {sine * std::sin(place.longitude), std::cos(place.colatitude), -sine * std::cos(place.longitude)};
}

LatLong latlong_of(const Vec3d& direction) {
  // atan2 of -0 would tell up from up.
  const double longitude = direction.x == 0 && direction.z == 0 ? 0 : std::atan2(direction.x, -direction.z);
  LatLong place;
  place.longitude = longitude < 0 ? longitude + 2 * kPiD : longitude;
  if (place.longitude >= 2 * kPiD) place.longitude = 0;
  place.colatitude = std::atan2(std::sqrt(direction.x * direction.x + direction.z * direction.z), direction.y);
  return place;
}

LatLongMap::LatLongMap(const Environment& environment) : map_(&environment), rows_(environment.height) {
  const double step = kPiD / height(), across = 2 * kPiD / width();
  for (std::uint32_t r = 0; r < height(); ++r) {
    const double top = r * step, middle = (r + 0.5) * step, bottom = (r + 1.0) * step;
    // The solid angle is that of cos(top) - cos(bottom), without the cancellation. What the rows above and below give
    // falls off linearly from 1/2 at the cell's edges to 0 at its middle: integral of |colatitude - middle| / step
    // times the sine.
    const double whole = 2 * std::sin(middle) * std::sin(step / 2);
    const double above = (std::sin(top) - std::sin(middle) + step / 2 * std::cos(top)) / step;
    const double below = (std::sin(bottom) - std::sin(middle) - step / 2 * std::cos(bottom)) / step;
    rows_[r].solid_angle = across * whole;
    rows_[r].weights = {across * above, across * (whole - above - below), across * below};
  }
}

Spectrum LatLongMap::radiance(const LatLong& place) const {
  const double x = place.longitude / (2 * kPiD) * width() - 0.5, y = place.colatitude / kPiD * height() - 0.5;
  const double left = std::floor(x), top = std::floor(y);
  const auto right_share = static_cast<float>(x - left), bottom_share = static_cast<float>(y - top);
  const auto column = [&](double c) { return static_cast<std::uint32_t>(c < 0 ? c + width() : c) % width(); };
  const auto row = [&](double r) { return static_cast<std::uint32_t>(std::clamp(r, 0.0, height() - 1.0)); };
  const std::uint32_t c0 = column(left), c1 = column(left + 1), r0 = row(top), r1 = row(top + 1);
  const Spectrum upper = at(r0, c0) * (1 - right_share) + at(r0, c1) * right_share;
  const Spectrum lower = at(r1, c0) * (1 - right_share) + at(r1, c1) * right_share;
  return upper * (1 - bottom_share) + lower * bottom_share;
}

LatLongMap::Texel LatLongMap::texel_at(const LatLong& place) const {
  const double x = place.longitude / (2 * kPiD) * width(), y = place.colatitude / kPiD * height();
  return {std::min(static_cast<std::uint32_t>(y), height() - 1), std::min(static_cast<std::uint32_t>(x), width() - 1)};
}

LatLong LatLongMap::place_in(const Texel& texel, double along_row, double down) const {
  const double step = kPiD / height(), top = texel.row * step;
  // 1 - cos and its inverse by half angles keep the digits at the poles.
  const double lower_half = std::sin((top + step) / 2), upper_half = std::sin(top / 2);
  const double height_below_pole = std::lerp(upper_half * upper_half, lower_half * lower_half, down);
  const double colatitude =
      2 * std::atan2(std::sqrt(height_below_pole), std::sqrt(std::max(0.0, 1 - height_below_pole)));
  return {2 * kPiD * (texel.column + along_row) / width(), std::clamp(colatitude, top, top + step)};
}

SpectrumD LatLongMap::integral(const Texel& texel) const {
  // Between columns the mean over a cell is 1/8, 3/4, 1/8.
  const std::uint32_t left = texel.column == 0 ? width() - 1 : texel.column - 1;
  const std::uint32_t right = texel.column + 1 == width() ? 0 : texel.column + 1;
  SpectrumD sum;
  for (std::uint32_t i = 0; i < 3; ++i) {
    const std::uint32_t row = std::clamp(texel.row + i, 1U, height()) - 1;
    const SpectrumD mean =
        (SpectrumD(at(row, left)) + SpectrumD(at(row, right))) * 0.125 + SpectrumD(at(row, texel.column)) * 0.75;
    sum += mean * rows_[texel.row].weights[i];
  }
  return sum;
}

}  // namespace radfarm
