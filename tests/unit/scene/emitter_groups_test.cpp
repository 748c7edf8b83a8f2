#include "scene/emitter_groups.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "support/small_scenes.h"

namespace radfarm {
namespace {

using testing::ElementsAre;

/// A square that emits, of a material of this name.
void add_lamp(test::SceneMaker& maker, float x) {
  const std::uint32_t material = maker.material(Spectrum(0.5F), Spectrum(10.0F));
  maker.polygon(material, {{x, 1, 0}, {x, 1, 1}, {x + 1, 1, 1}, {x + 1, 1, 0}});
}

Scene lamps_called(const std::vector<std::string>& names) {
  test::SceneMaker maker;
  for (std::size_t i = 0; i < names.size(); ++i) add_lamp(maker, 2 * static_cast<float>(i));
  Scene scene = maker.take();
  for (std::size_t i = 0; i < names.size(); ++i) scene.materials[i].name = names[i];
  return scene;
}

void add_light(Scene& scene, const std::string& name, float candela = 1) {
  PunctualLight light;
  light.name = name;
  light.position = {0, 3, 0};
  light.intensity = Spectrum(candela);
  scene.lights.push_back(light);
}

std::vector<std::string> names_of(Scene scene) {
  std::vector<std::string> names;
  const World world(std::move(scene));
  for (const EmitterGroup& group : emitter_groups(world)) names.push_back(group.name);
  return names;
}

TEST(EmitterGroups, AreMaterialsThenLightsThenTheSky) {
  Scene scene = lamps_called({"ceiling", "desk"});
  add_light(scene, "spot");
  scene.environment = {1, 1, {Spectrum(1.0F)}, {}};
  EXPECT_THAT(names_of(std::move(scene)), ElementsAre("ceiling", "desk", "spot", "environment"));
}

TEST(EmitterGroups, OfOneNameAreOne) {
  Scene scene = lamps_called({"lamp", "other", "lamp"});
  add_light(scene, "spot"), add_light(scene, "point"), add_light(scene, "spot");
  const World world(std::move(scene));
  const std::vector<EmitterGroup> groups = emitter_groups(world);
  ASSERT_EQ(groups.size(), 4U);
  EXPECT_EQ(groups[0].shining, (Shining{{1, 0, 1}, {0, 0, 0}, false}));
  EXPECT_EQ(groups[2].shining, (Shining{{0, 0, 0}, {1, 0, 1}, false}));
  EXPECT_EQ(groups[2].name, "spot");
}

TEST(EmitterGroups, HaveNamesThatAreSafeAndUnique) {
  EXPECT_THAT(names_of(lamps_called({"a.b", "a b", "a_b", "../x/y", "tab\there", "Lämpchen", "a-B_9"})),
              ElementsAre("a_b", "a_b_2", "a_b_3", "___x_y", "tab_here", "Lämpchen", "a-B_9"));
  EXPECT_THAT(names_of(lamps_called({"\xff\xfe", "a\xc2\x85z", std::string(100, 'n'), std::string(63, 'n') + "ä"})),
              ElementsAre("__", "a__z", std::string(64, 'n'), std::string(63, 'n')));
  Scene scene = lamps_called({"", "lamp", "environment", "", "material_1"});
  add_light(scene, ""), add_light(scene, "lamp");
  scene.environment = {1, 1, {Spectrum(1.0F)}, {}};
  EXPECT_THAT(names_of(std::move(scene)), ElementsAre("material_1", "lamp", "environment_2", "material_2", "material_1_2",
                                                      "light_1", "lamp_2", "environment"));
}

TEST(EmitterGroups, LeaveOutWhatGivesNoLight) {
  Scene scene = lamps_called({"on", "off"});
  scene.materials[1].emission = {};
  add_light(scene, "dark", 0);
  EXPECT_THAT(names_of(std::move(scene)), ElementsAre("on"));
  EXPECT_THAT(names_of(Scene()), ElementsAre());
}

TEST(EmitterGroups, ShareAllLightAndNoEmitter) {
  Scene scene = lamps_called({"a", "b", "a"});
  scene.materials[1].emission = Spectrum(3.0F);
  add_light(scene, "c", 7);
  scene.environment = {1, 1, {Spectrum(1.0F)}, {}};
  const World all(std::move(scene));
  double flux = 0;
  std::size_t emitters = 0;
  for (const EmitterGroup& group : emitter_groups(all)) {
    const World lit(all, group.shining);
    EXPECT_NEAR(lit.emitters.total_flux, group.flux, 1e-9 * group.flux);
    EXPECT_EQ(&lit.caster, &all.caster) << "rays are traced in one structure";
    flux += group.flux;
    emitters += lit.emitters.size();
  }
  EXPECT_NEAR(flux, all.emitters.total_flux, 1e-9 * flux);
  EXPECT_EQ(emitters, all.emitters.size());
}

TEST(World, WhereSomeShineSeesTheOthersDark) {
  const World all(lamps_called({"a", "b"}));
  const World lit(all, {{0, 1}, {}, false});
  const SurfacePoint a = all.surfaces.at({0, 0, 0.3F, 0.3F, 0}), b = all.surfaces.at({1, 0, 0.3F, 0.3F, 0});
  EXPECT_EQ(lit.emission(a), Spectrum());
  EXPECT_EQ(lit.emission(b), all.emission(b));
  EXPECT_EQ(all.emission(a), Spectrum(10.0F));
  EXPECT_EQ(lit.emitters.find(0, 0), kNone);
  EXPECT_NE(lit.emitters.find(1, 0), kNone);
}

}  // namespace
}  // namespace radfarm
