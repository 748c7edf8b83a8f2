#include "effects/detail.h"

#include <algorithm>

#include "base/parallel.h"
#include "image/tone_map.h"
#include "image/visibility_threshold.h"

namespace radfarm {
namespace {

constexpr int kMostPixels = 320;  // along each side

/// Reflectance that a ray meets; what is not met does not reflect.
float reflectance_along(const World& world, const Camera& camera, const LuminanceImage& image, float x, float y) {
  Ray ray = camera_ray(camera, image.width, image.height, x, y);
  ray.cone = pixel_cone(camera, image.height, ray.direction, 1);
  const auto hit = world.caster.closest(ray, 0);
  return hit ? luminance(world.surfaces.reflectance(world.surfaces.met(*hit, ray))) : 0;
}

}  // namespace

double detail_elevation(const World& world, const Camera& camera, int width, int height, float most) {
  const int block = (std::max(width, height) + kMostPixels - 1) / kMostPixels;
  LuminanceImage image{(width + block - 1) / block, (height + block - 1) / block, {}};
  const auto columns = static_cast<std::size_t>(image.width), rows = static_cast<std::size_t>(image.height);
  image.values.resize(columns * rows);
  parallel_for(rows, 4, [&](std::size_t begin, std::size_t end) {
    for (std::size_t i = begin * columns; i < end * columns; ++i) {
      const float x = static_cast<float>(i % columns) + 0.5F, y = static_cast<float>(i / columns) + 0.5F;
      image.values[i] = reflectance_along(world, camera, image, x, y);
    }
  });
  const LuminanceImage shown = displayed(image, auto_exposure(image.values));
  return mean_of(judge_visibility(shown, pixels_per_degree(camera, image.height), most).elevation);
}

}  // namespace radfarm
