#include "effects/plan.h"

#include <algorithm>
#include <cmath>
#include <set>

#include <gmock/gmock.h>

#include "support/small_scenes.h"

namespace radfarm {
namespace {

Measurements lit_room() {
  Measurements m;
  m.emissive_triangles = 2;
  m.emitted_flux = 100;
  m.max_radiance = 17;
  m.max_reflectance = 0.7F;
  return m;
}

EffectDecision decision(const EffectsPlan& plan, const std::string& id) {
  const auto found = std::find_if(plan.effects.begin(), plan.effects.end(), [&](const auto& e) { return e.id == id; });
  EXPECT_NE(found, plan.effects.end()) << id;
  return found == plan.effects.end() ? EffectDecision() : *found;
}

std::string refusal(std::string_view forced) {
  const Result<EffectsPlan> plan = plan_effects(lit_room(), forced);
  if (plan) return "no error";
  EXPECT_EQ(plan.error().code, Code::kInvalidArgument);
  return plan.error().message;
}

TEST(PlanEffects, SwitchesOnWhatTheSceneCallsFor) {
  const EffectsPlan plan = *plan_effects(lit_room(), "");
  EXPECT_TRUE(plan.is_active("area_lights"));
  EXPECT_TRUE(plan.is_active("interreflection"));
  for (const char* id : {"punctual_lights", "alpha_cutouts", "reflectance_textures", "emission_textures"}) {
    EXPECT_FALSE(plan.is_active(id)) << id;
    EXPECT_EQ(decision(plan, id).bound, 0) << id;
    EXPECT_EQ(decision(plan, id).bound_kind, "exact") << id;
  }
  EXPECT_FALSE(plan.is_active("no such effect"));
}

TEST(PlanEffects, EachCountSwitchesOnItsOwnEffect) {
  Measurements m = lit_room();
  m.punctual_lights = m.cutout_meshes = m.reflectance_textures = m.emission_textures = 1;
  const EffectsPlan plan = *plan_effects(m, "");
  for (const char* id : {"punctual_lights", "alpha_cutouts", "reflectance_textures", "emission_textures"}) {
    EXPECT_TRUE(plan.is_active(id)) << id;
    EXPECT_EQ(decision(plan, id).value, 1) << id;
  }
}

TEST(PlanEffects, BlackSurfacesOrNoLightNeedNoInterreflection) {
  Measurements black = lit_room(), dark = lit_room();
  black.max_reflectance = 0;
  dark.emitted_flux = 0;
  EXPECT_FALSE(plan_effects(black, "")->is_active("interreflection"));
  EXPECT_FALSE(plan_effects(dark, "")->is_active("interreflection"));
}

TEST(PlanEffects, SkippedGlossIsBoundedByTheBrightestEmitter) {
  Measurements m = lit_room();
  EXPECT_EQ(decision(*plan_effects(m, ""), "glossy_reflection").bound, 0);
  m.glossy_materials = 3;
  const EffectDecision glossy = decision(*plan_effects(m, ""), "glossy_reflection");
  EXPECT_FALSE(glossy.active);
  EXPECT_EQ(glossy.bound, 17);
  EXPECT_EQ(glossy.bound_kind, "rigorous");
  // A reflected point light is infinitely bright.
  m.punctual_lights = 1;
  EXPECT_TRUE(std::isinf(decision(*plan_effects(m, ""), "glossy_reflection").bound));
}

TEST(PlanEffects, NamesEveryEffectOnceWithItsTest) {
  const EffectsPlan plan = *plan_effects(lit_room(), "");
  std::set<std::string> ids;
  for (const EffectDecision& e : plan.effects) {
    EXPECT_TRUE(ids.insert(e.id).second) << e.id;
    EXPECT_FALSE(e.test.empty()) << e.id;
    EXPECT_GE(e.bound, 0) << e.id;
  }
}

TEST(PlanEffects, InterreflectionCanBeForcedOffAndOn) {
  EXPECT_FALSE(plan_effects(lit_room(), "-interreflection")->is_active("interreflection"));
  EXPECT_TRUE(plan_effects(lit_room(), "-interreflection,+interreflection")->is_active("interreflection"));
  EXPECT_TRUE(plan_effects(lit_room(), "+area_lights")->is_active("area_lights"));
  EXPECT_THAT(decision(*plan_effects(lit_room(), "-interreflection"), "interreflection").note, testing::HasSubstr("forced"));
}

TEST(PlanEffects, RefusesWhatItDoesNotKnowOrCannotDo) {
  EXPECT_THAT(refusal("+sparkle"), testing::AllOf(testing::HasSubstr("'sparkle'"), testing::HasSubstr("area_lights")));
  EXPECT_THAT(refusal("interreflection"), testing::HasSubstr("+ or -"));
  EXPECT_THAT(refusal("+caustics"), testing::HasSubstr("cannot simulate 'caustics'"));
  EXPECT_THAT(refusal("-area_lights"), testing::HasSubstr("only interreflection"));
  EXPECT_THAT(refusal("-interreflection,"), "no error");
}

TEST(PlanEffects, DecidesOurScenesAsTheyAreMade) {
  const World furnace(test::own_scene("furnace")), point(test::own_scene("point_light"));
  const Measurements closed = measure(furnace, 1), open = measure(point, 1);
  EXPECT_EQ(closed.emissive_triangles, 12U);
  EXPECT_EQ(closed.max_radiance, 1);
  EXPECT_EQ(closed.min_reflectance, 0.5F);
  EXPECT_EQ(closed.escaped, 0U);
  EXPECT_GT(closed.probes, 0U);
  EXPECT_GT(open.escaped, 0U);
  EXPECT_TRUE(plan_effects(open, "")->is_active("punctual_lights"));
  EXPECT_FALSE(plan_effects(open, "")->is_active("area_lights"));
}

}  // namespace
}  // namespace radfarm
