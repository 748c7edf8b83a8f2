#pragma once

#include <string>
#include <vector>

#include "scene/scene.h"

namespace radfarm {

/// A scene on its way from a file to recentre(): what will be rounded to float after recentring is still double here,
/// so that geometry far from the file's origin keeps its precision.
struct DraftScene {
  Scene scene;                                // instances, lights and cameras still without their place
  std::vector<std::vector<Vec3d>> positions;  // per mesh; empty where Mesh::positions already has the file's floats
  std::vector<Matrix4d> instance_to_world;    // per instance
  std::vector<Vec3d> light_positions;         // per light
  std::vector<Vec3d> camera_positions;        // per camera
};

/// Says a note once, however often its cause occurs.
void add_note(Scene& scene, std::string note);

}  // namespace radfarm
