#pragma once

#include <optional>

#include "base/status.h"
#include "scene/ray_cone.h"
#include "scene/scene.h"

namespace radfarm {

struct Ray {
  Vec3 origin;
  Vec3 direction;  // unit, unless a function says otherwise
  RayCone cone = {};
};

/// The ray through the film at (x, y) in pixels, (0, 0) the top left corner of the image, pixel centres at .5.
Ray camera_ray(const Camera& camera, int width, int height, float x, float y);

/// The same through the point of the lens that the uniform random numbers `lens` choose, evenly over its disc: all of
/// these rays meet where the pinhole's ray meets the plane of focus. Orthographic cameras and those without a lens
/// diameter give the pinhole's ray, bit for bit.
Ray camera_ray(const Camera& camera, int width, int height, float x, float y, const Vec2& lens);

/// The cone of one of `samples` rays through a pixel: each stands for a part of it whose width is the pixel's by the root of
/// their number (docs/decisions/0016). A lens widens nothing: its blur is what the samples cover.
RayCone pixel_cone(const Camera& camera, int height, const Vec3& direction, std::uint32_t samples);

/// Pixels of an image so high per degree of the field of view of an eye where the camera is; an orthographic image is looked
/// at as if it were 45 degrees high.
double pixels_per_degree(const Camera& camera, int height);

/// A camera that looks from `eye` at `look_at`. INVALID_ARGUMENT when they coincide; an up vector along the view is
/// replaced by another axis.
Result<Camera> place_camera(const Vec3& eye, const Vec3& look_at, const Vec3& up, float vertical_fov);

/// A camera of the scene by name or by index; NOT_FOUND lists what there is.
Result<Camera> find_camera(const Scene& scene, std::string_view name_or_index);

/// A camera that sees the bulk of the geometry (the box of the area-weighted 1st to 99th percentiles): when that box
/// looks like a room (its surfaces face inwards), through its open side or else from inside; from outside otherwise.
Camera frame_scene(const Scene& scene);

}  // namespace radfarm
