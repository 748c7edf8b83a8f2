#pragma once

#include "base/status.h"
#include "scene/scene.h"

namespace radfarm {

/// Proves what scene.h promises: indices in range, optional arrays as long as positions, floats finite and below 1e18,
/// normals and axes unit, reflectance in [0, 1], emission and intensity not negative, instances affine and invertible,
/// sizes below limits.h. The first fault is INVALID_ARGUMENT, as "meshes[3] 'door': what is wrong". Cost: O(scene).
Status validate(const Scene& scene);

/// Whether an affine matrix has an inverse that float precision can use.
bool is_invertible(const Matrix4& matrix);

}  // namespace radfarm
