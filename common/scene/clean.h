#pragma once

#include "scene/scene.h"

namespace radfarm {

/// Brings a loaded scene into the form that validate() proves, with a note for whatever it drops or replaces: triangles
/// without area (ALGORITHMS.md H1) or exactly on others of their mesh, meshes without triangles, instances of zero scale; normals become unit, and those
/// that are zero become the surface's own.
void clean_scene(Scene& scene);

/// |e1 x e2| <= 4 eps max|e|^2: no area beyond rounding.
bool is_degenerate(const Vec3& a, const Vec3& b, const Vec3& c);

}  // namespace radfarm
