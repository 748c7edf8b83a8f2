#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "scene/scene.h"

namespace radfarm {

/// A direction in an environment map: longitude in [0, 2 pi), clockwise seen from above, from -z over +x; colatitude in
/// [0, pi] from +y.
struct LatLong {
  double longitude = 0;
  double colatitude = 0;
};

/// Unit. Columns of an environment map run along the longitude, rows along the colatitude.
Vec3d direction_at(const LatLong& place);
/// The inverse, for a vector of any length; accurate near the poles too. Longitude 0 straight up and down.
LatLong latlong_of(const Vec3d& direction);

/// The texels of an environment map as what is interpolated between their centres: wrapped in longitude, clamped at the
/// poles. Borrows the map. A texel's cell is the part of the sphere nearest to it in both angles.
class LatLongMap {
 public:
  /// Requires: environment.width > 0.
  explicit LatLongMap(const Environment& environment);

  std::uint32_t width() const { return map_->width; }
  std::uint32_t height() const { return map_->height; }
  /// Bilinear, cd/m^2.
  Spectrum radiance(const LatLong& place) const;

  struct Texel {
    std::uint32_t row = 0;
    std::uint32_t column = 0;
  };
  /// Whose cell holds the place.
  Texel texel_at(const LatLong& place) const;
  /// The point of a texel's cell for u in [0, 1)^2, uniform over its solid angle.
  LatLong place_in(const Texel& texel, double along_row, double down) const;

  /// Of one cell in a row, sr.
  double solid_angle(std::uint32_t row) const { return rows_[row].solid_angle; }
  /// The integral over a texel's cell of the bilinear radiance: exact, and of three by three texels.
  SpectrumD integral(const Texel& texel) const;

 private:
  struct Row {
    double solid_angle = 0;         // sr, of one cell
    std::array<double, 3> weights;  // sr: of the row above, this one, the one below in the cell's integral
  };
  const Spectrum& at(std::uint32_t row, std::uint32_t column) const {
    return map_->radiance[std::size_t{row} * map_->width + column];
  }

  const Environment* map_;
  std::vector<Row> rows_;
};

}  // namespace radfarm
