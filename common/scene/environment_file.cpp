#include "scene/environment_file.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <span>
#include <string>
#include <utility>

#include "base/file.h"
#include "image/exr.h"
#include "scene/limits.h"
#include "scene/radiance_hdr.h"

namespace radfarm {
namespace {

Result<HdrImage> decode_exr_map(std::string_view bytes) {
  RADFARM_TRY(const Image image, decode_exr(std::as_bytes(std::span(bytes))));
  const auto channel = [&](const char* name) {
    const auto found = image.channels.find(name);
    return found == image.channels.end() ? nullptr : &found->second;
  };
  const auto* grey = channel("Y");
  const auto *r = channel("R"), *g = channel("G"), *b = channel("B");
  if (!(r && g && b) && !grey) {
    std::string there;
    for (const auto& [name, values] : image.channels) {
      if (there.size() < 100) there += (there.empty() ? "" : ", ") + name;
    }
    return fail(Code::kInvalidArgument, "OpenEXR map has channels " + there + ", should have R, G and B, or Y");
  }
  if (!(r && g && b)) r = g = b = grey;
  HdrImage map;
  map.width = static_cast<std::uint32_t>(image.width);
  map.height = static_cast<std::uint32_t>(image.height);
  map.pixels.resize(image.pixel_count());
  for (std::size_t i = 0; i < map.pixels.size(); ++i) map.pixels[i] = {(*r)[i], (*g)[i], (*b)[i]};
  return map;
}

Status check_shape(const HdrImage& map) {
  const double wanted = 2.0 * map.height;
  if (std::fabs(map.width - wanted) <= 0.01 * wanted) return {};
  return fail(Code::kInvalidArgument, "environment map is " + std::to_string(map.width) + " x " +
                                          std::to_string(map.height) +
                                          " pixels, should be twice as wide as high: latitude-longitude, " +
                                          std::to_string(2 * map.height) + " x " + std::to_string(map.height));
}

/// Negative values, which filters of image editors leave, become 0.
Status clean(HdrImage& map) {
  std::size_t bad = 0, first = 0;
  for (std::size_t i = 0; i < map.pixels.size(); ++i) {
    Spectrum& pixel = map.pixels[i];
    const bool is_good = is_finite(pixel) && static_cast<double>(max_component(pixel)) <= limits::kLight;
    if (!is_good && bad++ == 0) first = i;
    pixel = {std::max(0.0F, pixel.r), std::max(0.0F, pixel.g), std::max(0.0F, pixel.b)};
  }
  if (bad == 0) return {};
  return fail(Code::kInvalidArgument,
              "environment map has " + std::to_string(bad) +
                  " pixels that are undefined, infinite or above 1e18 cd/m^2, the first in column " +
                  std::to_string(first % map.width) + " of row " + std::to_string(first / map.width));
}

}  // namespace

Result<Environment> decode_environment(std::string_view bytes) {
  const bool is_exr = bytes.starts_with("\x76\x2f\x31\x01"), is_hdr = bytes.starts_with("#?");
  if (!is_exr && !is_hdr) {
    return fail(Code::kInvalidArgument,
                "environment map is neither a Radiance picture (.hdr) nor an OpenEXR file (.exr)");
  }
  RADFARM_TRY(HdrImage map, is_exr ? decode_exr_map(bytes) : decode_radiance_hdr(bytes));
  RADFARM_TRY_STATUS(check_shape(map));
  RADFARM_TRY_STATUS(clean(map));
  Environment environment;
  environment.width = map.width;
  environment.height = map.height;
  environment.radiance = std::move(map.pixels);
  return environment;
}

Result<Environment> read_environment(const std::filesystem::path& path) {
  RADFARM_TRY(const std::string bytes, read_file(path, limits::kTextureFileBytes));
  Result<Environment> environment = decode_environment(bytes);
  if (!environment) return annotate(environment.error(), path.string());
  return environment;
}

}  // namespace radfarm
