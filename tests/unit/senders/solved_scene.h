#pragma once

#include <string>

#include "senders/sender_grid.h"
#include "support/small_scenes.h"

namespace radfarm::test {

/// One of our scenes with a coarse radiosity solution, as the sender stage gets it.
struct SolvedScene {
  explicit SolvedScene(const std::string& name) : SolvedScene(own_scene(name)) {}
  explicit SolvedScene(Scene scene)
      : world(std::move(scene)),
        solution(solve_radiosity(world, coarse(), 1)),
        tree(make_sender_tree(solution, SenderChoice::kAll)),
        settings(small_grid(solution)) {}

  static RadiositySettings coarse() {
    RadiositySettings settings;
    settings.max_link_error = 2e-3F;
    settings.min_patch_area = 1e-3F;
    return settings;
  }
  static SenderSettings small_grid(const RadiositySolution& solved) {
    SenderSettings settings;
    settings.columns = 6, settings.rows = 5, settings.slices = 4;
    settings.max_senders = 80, settings.vertex_samples = 300;
    // A hundredth of the mean reflected radiance, as the standard quality has it.
    const float area = solved.hierarchy.nodes.at(0).area;
    settings.threshold = 0.01F * luminance(solved.reflected_power.at(0)) / (kPi * area);
    return settings;
  }
  std::size_t patches() const { return world.environment.patches().size(); }
  const Camera& camera() const { return world.scene.cameras.at(0); }
  SenderGridFile classify(std::uint64_t seed = 1) const {
    return classify_visible(world, tree, camera(), 24, 20, settings, seed).file;
  }

  World world;
  RadiositySolution solution;
  SenderTree tree;
  SenderSettings settings;
};

}  // namespace radfarm::test
