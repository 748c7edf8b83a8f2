#pragma once

#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "base/status.h"
#include "meters/meter.h"

namespace radfarm {

/// Meters of a CSV file: a line each of x,y,z or x,y,z,nx,ny,nz in metres, in the scene file's coordinates (after
/// --up); without a normal they look up. Empty lines, lines that begin with # and one header line are skipped. `origin`
/// is Scene::origin. INVALID_ARGUMENT names the line; RESOURCE_EXHAUSTED above 10^7 of them.
Result<std::vector<Meter>> read_meters(std::string_view csv, const Vec3d& origin);

/// One line a meter, with a header: x,y,z,nx,ny,nz,lux,lux_low,lux_high,red,green,blue,samples.
std::string write_readings(std::span<const Meter> meters, std::span<const Reading> readings, const Vec3d& origin);

}  // namespace radfarm
