#include "scene/draft_scene.h"

#include <algorithm>

namespace radfarm {

void add_note(Scene& scene, std::string note) {
  if (std::find(scene.notes.begin(), scene.notes.end(), note) == scene.notes.end()) {
    scene.notes.push_back(std::move(note));
  }
}

}  // namespace radfarm
