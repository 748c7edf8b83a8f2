#include "pipeline/solution_key.h"

#include <functional>
#include <set>

#include <gtest/gtest.h>

#include "support/small_scenes.h"

namespace radfarm {
namespace {

struct Solved {
  Scene scene = test::own_scene("effects/all");
  RadiositySettings settings;
  std::uint64_t seed = 1;
  bool is_reflecting = true;
  LightForm form = LightForm::kSenders;
  Shining shining = {};
};

std::string key_of(const Solved& solved) {
  return solution_key(solved.scene, solved.settings, solved.seed, solved.is_reflecting, solved.form, solved.shining);
}

std::string key_after(const std::function<void(Solved&)>& change) {
  Solved solved;
  change(solved);
  return key_of(solved);
}

TEST(SolutionKey, IsADigestThatStaysTheSame) {
  EXPECT_EQ(key_of({}).size(), 64U);
  EXPECT_EQ(key_of({}), key_of({}));
}

TEST(SolutionKey, DoesNotDependOnCamerasAndNotes) {
  ASSERT_FALSE(Solved().scene.cameras.empty());
  EXPECT_EQ(key_after([](Solved& s) { s.scene.cameras[0].lens_diameter = 0.1F; }), key_of({}));
  EXPECT_EQ(key_after([](Solved& s) { s.scene.notes.emplace_back("a note"); }), key_of({}));
  EXPECT_EQ(key_after([](Solved& s) { s.scene.cameras.clear(); }), key_of({}));
}

TEST(SolutionKey, DependsOnEverythingElse) {
  const std::vector<std::function<void(Solved&)>> changes = {
      [](Solved&) {},
      [](Solved& s) { s.scene.meshes[0].positions[0].x += 1e-3F; },
      [](Solved& s) { s.scene.instances[0].to_world[3][0] += 1; },
      [](Solved& s) { s.scene.materials[0].base_color.r *= 0.5F; },
      [](Solved& s) { s.scene.materials[0].emission += Spectrum(1.0F); },
      [](Solved& s) { s.scene.textures.at(0).texels.at(0)[0] ^= 1; },
      [](Solved& s) { s.scene.lights.at(0).intensity *= 2; },
      [](Solved& s) { s.scene.environment = {1, 1, {Spectrum(1.0F)}, {}}; },
      [](Solved& s) { s.settings.max_link_error *= 0.5F; },
      [](Solved& s) { s.settings.min_patch_area *= 0.5F; },
      [](Solved& s) { s.settings.residual *= 0.5F; },
      [](Solved& s) { ++s.settings.samples_per_link; },
      [](Solved& s) { ++s.settings.max_links; },
      [](Solved& s) { ++s.settings.max_passes; },
      [](Solved& s) { ++s.settings.hits_per_patch; },
      [](Solved& s) { s.seed = 2; },
      [](Solved& s) { s.is_reflecting = false; },
      [](Solved& s) { s.shining.environment = false; },
      [](Solved& s) { s.shining.materials = {1, 0}; },
      [](Solved& s) { s.shining.materials = {0, 1}; },
      [](Solved& s) { s.shining.lights = {1, 0}; },
      [](Solved& s) { s.shining = {{1}, {0}, true}; },
      [](Solved& s) { s.shining = {{1, 0}, {}, true}, s.shining.environment = false; },
  };
  std::set<std::string> keys;
  for (const auto& change : changes) keys.insert(key_after(change));
  EXPECT_EQ(keys.size(), changes.size());
}

}  // namespace
}  // namespace radfarm
