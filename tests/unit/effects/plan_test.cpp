#include "effects/plan.h"

#include <algorithm>
#include <cmath>
#include <set>

#include <gmock/gmock.h>

#include "effects/specialise.h"
#include "support/small_scenes.h"

namespace radfarm {
namespace {

/// A lamp of 17 cd/m^2 in a room where every diffuse ray meets a wall of 0.7; the pilot saw 10 cd/m^2.
Measurements lit_room() {
  Measurements m;
  m.emissive_triangles = 2;
  m.emitted_flux = 100;
  m.max_radiance = 17;
  m.max_reflectance = 0.7F;
  m.pilot.rays = m.pilot.hits = m.pilot.walks = 1000;
  m.pilot.bounces = m.pilot.met = 3000;
  m.pilot.direct_radiance = 10;
  m.pilot.met_radiance = 4;
  return m;
}

EffectsPlan plan_of(const Measurements& m, std::string_view forced = "", Transport transport = Transport::kGather) {
  Result<EffectsPlan> plan = plan_effects(m, transport, forced);
  EXPECT_TRUE(plan) << plan.error().message;
  return std::move(*plan);
}

EffectDecision decision(const EffectsPlan& plan, const std::string& id) {
  const auto found = std::find_if(plan.effects.begin(), plan.effects.end(), [&](const auto& e) { return e.id == id; });
  EXPECT_NE(found, plan.effects.end()) << id;
  return found == plan.effects.end() ? EffectDecision() : *found;
}

std::string refusal(std::string_view forced, const Measurements& m = lit_room()) {
  const Result<EffectsPlan> plan = plan_effects(m, Transport::kGather, forced);
  if (plan) return "no error";
  EXPECT_EQ(plan.error().code, Code::kInvalidArgument);
  return plan.error().message;
}

constexpr const char* kMax = "max over pixels";
constexpr const char* kMean = "mean over pixels";
const double kUnbounded = std::numeric_limits<double>::infinity();

/// One decision: what is measured, and what the plan's row must say.
struct Row {
  const char* id;
  void (*measured)(Measurements& m);
  bool active;
  double value;
  double bound;
  const char* kind;
  const char* scope;
};

const std::vector<Row> kRows = {
    {"area_lights", [](Measurements&) {}, true, 2, 0, "exact", kMax},
    {"area_lights", [](Measurements& m) { m.emissive_triangles = 0; }, false, 0, 0, "exact", kMax},
    {"punctual_lights", [](Measurements& m) { m.punctual_lights = 3; }, true, 3, 0, "exact", kMax},
    {"punctual_lights", [](Measurements&) {}, false, 0, 0, "exact", kMax},
    {"ies", [](Measurements& m) { m.ies_contrast = 0.5F; }, true, 0.5, 0, "heuristic", kMean},
    {"ies", [](Measurements& m) { m.ies_contrast = 0x1p-11F; }, false, 0x1p-11, 0x1p-11 * 10, "heuristic", kMean},
    {"ies", [](Measurements&) {}, false, 0, 0, "exact", kMean},
    {"environment", [](Measurements& m) { m.has_environment = true, m.pilot.escaped = 10; }, true, 0.01, 0, "95 %",
     kMean},
    {"environment", [](Measurements& m) { m.has_environment = true; }, false, 0, 17 * 0.003, "95 %", kMean},
    {"environment", [](Measurements& m) { m.pilot.escaped = 10; }, false, 0, 0, "exact", kMean},
    {"emission_textures", [](Measurements& m) { m.emission_textures = 2, m.emission_contrast = 1; }, true, 2, 0,
     "exact", kMax},
    {"emission_textures", [](Measurements& m) { m.emission_textures = 2; }, false, 0, 0, "exact", kMax},
    {"gloss", [](Measurements& m) { m.max_specular = 0.25F; }, true, 0.25, 0, "exact", kMax},
    {"gloss", [](Measurements&) {}, false, 0, 0, "exact", kMax},
    {"clearcoat", [](Measurements& m) { m.coats = 1; }, true, 1, 0, "exact", kMax},
    {"clearcoat", [](Measurements&) {}, false, 0, 0, "exact", kMax},
    {"sheen", [](Measurements& m) { m.sheens = 1; }, true, 1, 0, "exact", kMax},
    {"sheen", [](Measurements&) {}, false, 0, 0, "exact", kMax},
    {"anisotropy", [](Measurements& m) { m.anisotropic = 1; }, true, 1, 0, "exact", kMax},
    {"anisotropy", [](Measurements&) {}, false, 0, 0, "exact", kMax},
    {"transmission", [](Measurements& m) { m.volumes = 1; }, true, 1, 0, "exact", kMax},
    {"transmission", [](Measurements&) {}, false, 0, 0, "exact", kMax},
    {"panes", [](Measurements& m) { m.panes = 1, m.rough_transmitters = 1; }, true, 2, 0, "exact", kMax},
    {"panes", [](Measurements&) {}, false, 0, 0, "exact", kMax},
    {"alpha_cutouts", [](Measurements& m) { m.least_coverage = 0.5F; }, true, 0.5, 0, "rigorous", kMax},
    {"alpha_cutouts", [](Measurements& m) { m.least_coverage = 1 - 0x1p-10F; }, false, 0x1p-10, 0x1p-10 * 17,
     "rigorous", kMax},
    {"alpha_cutouts", [](Measurements&) {}, false, 0, 0, "exact", kMax},
    {"alpha_cutouts", [](Measurements& m) { m.punctual_lights = 1; }, false, 0, 0, "exact", kMax},
    {"reflectance_textures", [](Measurements& m) { m.texture_deviation = 0.5F; }, true, 0.5, 0, "heuristic", kMean},
    {"reflectance_textures", [](Measurements& m) { m.texture_deviation = 0x1p-10F, m.max_reflectance = 0.5F; }, false,
     0x1p-10, 0x1p-10 * 10 / 0.5, "heuristic", kMean},
    {"reflectance_textures", [](Measurements&) {}, false, 0, 0, "exact", kMean},
    {"normal_maps", [](Measurements& m) { m.normal_map_angle = 30; }, true, 30, 0, "heuristic", kMean},
    {"normal_maps", [](Measurements& m) { m.normal_map_angle = 0.5F; }, false, 0.5, 10 * 0.00872653550, "heuristic",
     kMean},
    {"normal_maps", [](Measurements&) {}, false, 0, 0, "exact", kMean},
    {"interreflection", [](Measurements& m) { m.max_reflectance = 0.75F; }, true, 3, 0, "heuristic", kMean},
    {"interreflection", [](Measurements& m) { m.max_reflectance = 0.75F, m.pilot.met = 0; }, false, 0.00075 / 0.99925,
     0.00075 / 0.99925 * 10, "95 %", kMean},
    {"interreflection", [](Measurements& m) { m.max_reflectance = 0x1p-10F; }, false, 1.0 / 1023, 10.0 / 1023,
     "heuristic", kMean},
    {"interreflection", [](Measurements& m) { m.max_reflectance = 0; }, false, 0, 0, "exact", kMean},
    {"interreflection", [](Measurements& m) { m.emitted_flux = 0; }, false, 0, 0, "exact", kMean},
    {"interreflection", [](Measurements& m) { m.max_reflectance = 1; }, true, kUnbounded, 0, "heuristic", kMean},
    {"caustics", [](Measurements& m) { m.specular.sharp = {0.25, 0.375}; }, true, 0.25, 0, "heuristic", kMean},
    {"caustics", [](Measurements& m) { m.specular.sharp = {0x1p-8, 0x1p-7}; }, false, 0x1p-8, 10 * 0x1p-7, "heuristic", kMean},
    {"caustics", [](Measurements& m) { m.specular.sharp = {0, 0x1p-10}; }, false, 0, 10 * 0x1p-10, "heuristic", kMean},
    {"caustics", [](Measurements&) {}, false, 0, 0, "exact", kMean},
    {"glossy_interreflection", [](Measurements& m) { m.specular.rough = {0.25, 0.375}; }, true, 0.25, 0, "heuristic", kMean},
    {"glossy_interreflection", [](Measurements& m) { m.specular.rough = {0x1p-5, 0x1p-4}; }, false, 0x1p-5, 10 * 0x1p-4, "heuristic",
     kMean},
    {"glossy_interreflection", [](Measurements&) {}, false, 0, 0, "exact", kMean},
    {"bounces", [](Measurements&) {}, true, 0.7 / 0.3, 0, "exact", kMax},
    {"depth_of_field", [](Measurements& m) { m.pilot.max_blur = 2; }, true, 2, 0, "heuristic", kMax},
    {"depth_of_field", [](Measurements& m) { m.pilot.max_blur = 0.25F; }, false, 0.25, 10, "heuristic", kMax},
    {"depth_of_field", [](Measurements&) {}, false, 0, 0, "exact", kMax},
    {"colour", [](Measurements& m) { m.color_deviation = 0.25F, m.flux_color_deviation = 0.5F; }, true, 0.5, 0, "exact",
     kMax},
    {"channels", [](Measurements& m) { m.dark_channels = 2; }, true, 1, 0, "exact", kMax},
    {"motion_blur", [](Measurements&) {}, false, 0, 0, "exact", kMax},
    {"participating_media", [](Measurements&) {}, false, 0, 0, "exact", kMax},
    {"subsurface", [](Measurements& m) { m.scattering = 1; }, false, 1, 17, "rigorous", kMax},
    {"dispersion", [](Measurements& m) { m.dispersive = 2; }, false, 2, 17, "rigorous", kMax},
    {"iridescence", [](Measurements& m) { m.iridescent = 1; }, false, 1, 17, "rigorous", kMax},
    {"iridescence", [](Measurements&) {}, false, 0, 0, "exact", kMax},
    {"subsurface", [](Measurements&) {}, false, 0, 0, "exact", kMax},
    {"dispersion", [](Measurements&) {}, false, 0, 0, "exact", kMax},
    {"masking", [](Measurements&) {}, false, 1, 0, "exact", kMean},
    {"masking", [](Measurements& m) { m.detail_elevation = 2; }, false, 2, 0, "exact", kMean},
    {"adaptive_sampling", [](Measurements&) {}, false, 0, 0, "exact", kMax},
};

TEST(PlanEffects, DecidesEachEffectByItsValue) {
  for (std::size_t i = 0; i < kRows.size(); ++i) {
    const Row& row = kRows[i];
    Measurements m = lit_room();
    row.measured(m);
    const EffectDecision found = decision(plan_of(m), row.id);
    const std::string place = "row " + std::to_string(i) + ", " + row.id;
    EXPECT_EQ(found.active, row.active) << place;
    EXPECT_EQ(found.bound_scope, row.scope) << place;
    EXPECT_FALSE(found.test.empty()) << place;
    // Kinds of active effects mean nothing: their bound is 0.
    if (!row.active) {
      EXPECT_EQ(found.bound_kind, row.kind) << place;
    }
    // Measurements are floats.
    const auto is_near = [](double a, double b) { return a == b || std::fabs(a - b) <= 1e-6 * std::fabs(b); };
    EXPECT_TRUE(is_near(found.value, row.value)) << place << ": value " << found.value;
    EXPECT_TRUE(is_near(found.bound, row.bound)) << place << ": bound " << found.bound;
  }
}

TEST(PlanEffects, HasNoRowThatTheTableOfTheTestLeavesOut) {
  std::set<std::string> tested;
  for (const Row& row : kRows) tested.insert(row.id);
  for (const EffectDecision& e : plan_of(lit_room()).effects) EXPECT_TRUE(tested.contains(e.id)) << e.id;
}

TEST(PlanEffects, ThePathTracerCarriesWhatTheGatherLeavesOut) {
  Measurements m = lit_room();
  m.specular = {{0x1p-10, 0x1p-9}, {0x1p-5, 0x1p-4}};
  const EffectsPlan path = plan_of(m, "", Transport::kPathTrace);
  for (const char* id : {"caustics", "glossy_interreflection"}) {
    EXPECT_TRUE(path.is_active(id)) << id;
    EXPECT_EQ(decision(path, id).bound, 0) << id;
    EXPECT_FALSE(plan_of(lit_room(), "", Transport::kPathTrace).is_active(id)) << id;
    EXPECT_FALSE(plan_of(m).is_active(id)) << id;
  }
  EXPECT_FALSE(plan_effects(m, Transport::kPathTrace, "-caustics").has_value()) << "paths carry it";
  EXPECT_TRUE(plan_of(lit_room(), "+caustics", Transport::kPathTrace).is_active("caustics")) << "nothing is asked for";
}

TEST(PlanEffects, WhatIsFoldedCanBeCarriedAndIsNoOtherScene) {
  Measurements m = lit_room();
  m.specular = {{0.25, 0.375}, {0x1p-5, 0x1p-4}};
  EXPECT_EQ(plan_of(m).off() & kFoldable, bit_of(Effect::kGlossyInterreflection));
  EXPECT_EQ(plan_of(m).exactly_off(), plan_of(m).off()) << "the path tracer knows no switch for it";
  EXPECT_EQ(plan_of(m, "+glossy_interreflection").off() & kFoldable, 0U);
  const EffectsPlan off = plan_of(m, "-caustics");
  EXPECT_EQ(off.off() & kFoldable, kFoldable);
  EXPECT_EQ(decision(off, "caustics").bound, 2.5);
  EXPECT_FALSE(changes_scene(off.off() & kFoldable));
}

TEST(PlanEffects, MaskingIsOfThePapersGatherAndWhereThereIsDetail) {
  Measurements m = lit_room();
  EXPECT_FALSE(plan_of(m, "", Transport::kPaperGather).is_active("masking"));
  m.detail_elevation = 2;
  EXPECT_TRUE(plan_of(m, "", Transport::kPaperGather).is_active("masking"));
  EXPECT_FALSE(plan_of(m).is_active("masking"));
  EXPECT_TRUE(plan_of(m, "+masking").is_active("masking"));
  const EffectsPlan forced = plan_of(m, "-masking", Transport::kPaperGather);
  EXPECT_FALSE(forced.is_active("masking"));
  EXPECT_EQ(forced.total_mean_bound(), 0) << "leaving it out only raises accuracy";
  EXPECT_EQ(forced.off(), plan_of(lit_room()).off());
}

TEST(PlanEffects, NamesEveryEffectOnceWithItsTest) {
  Measurements point = lit_room();
  point.punctual_lights = 1;
  for (const Measurements& m : {lit_room(), point}) {
    const EffectsPlan plan = plan_of(m);
    std::set<std::string> ids;
    for (const EffectDecision& e : plan.effects) {
      EXPECT_TRUE(ids.insert(e.id).second) << e.id;
      EXPECT_FALSE(e.test.empty()) << e.id;
      EXPECT_GE(e.bound, 0) << e.id << " (not a number counts as wrong)";
    }
    for (std::uint32_t i = 0; i < static_cast<std::uint32_t>(Effect::kCount); ++i) {
      EXPECT_TRUE(ids.contains(std::string(id_of(Effect{i})))) << id_of(Effect{i});
    }
  }
}

TEST(PlanEffects, BoundsAddUpByScope) {
  Measurements m = lit_room();
  EXPECT_EQ(plan_of(m).total_mean_bound(), 0);
  EXPECT_EQ(plan_of(m).total_max_bound(), 0);
  m.least_coverage = 1 - 0x1p-10F;  // max: 17 / 1024
  m.pilot.max_blur = 0.25F;         // max: 10
  m.ies_contrast = 0x1p-11F;        // mean: 10 / 2048
  m.texture_deviation = 0x1p-10F;   // mean: 10 / 1024 / 0.7
  const EffectsPlan plan = plan_of(m);
  EXPECT_NEAR(plan.total_max_bound(), 17.0 / 1024 + 10, 1e-6);
  EXPECT_NEAR(plan.total_mean_bound(), 10.0 / 2048 + 10.0 / 1024 / 0.7, 1e-6);
  // What is on has no bound.
  m.least_coverage = 0.5F;
  EXPECT_NEAR(plan_of(m).total_max_bound(), 10, 1e-6);
}

TEST(PlanEffects, OffAreThoseThatTheSceneHasAndExactlyOffThoseOfThemThatCostNothing) {
  EXPECT_EQ(plan_of(lit_room()).off(), 0U);
  Measurements m = lit_room();
  m.least_coverage = 1 - 0x1p-10F;
  EXPECT_EQ(plan_of(m).off(), bit_of(Effect::kAlphaCutouts));
  EXPECT_EQ(plan_of(m).exactly_off(), 0U);
  m.emitted_flux = 0;
  EXPECT_EQ(plan_of(m).off(), bit_of(Effect::kAlphaCutouts) | bit_of(Effect::kInterreflection));
  EXPECT_EQ(plan_of(m).exactly_off(), bit_of(Effect::kInterreflection));
}

TEST(PlanEffects, TheSkyOfAClosedSceneIsOff) {
  // Its value is 0, no walk has left; the audit keeps it, since a hole may have been missed.
  Measurements m = lit_room();
  m.has_environment = true;
  EXPECT_EQ(plan_of(m).off(), bit_of(Effect::kEnvironment));
  EXPECT_EQ(plan_of(m).exactly_off(), 0U);
  EXPECT_EQ(plan_of(m, "+environment").off(), 0U);
}

TEST(PlanEffects, EveryEffectWithASwitchCanBeForcedOffAndOn) {
  Measurements m = lit_room();
  m.punctual_lights = m.coats = m.sheens = m.anisotropic = m.volumes = m.panes = m.reflectance_textures =
      m.emission_textures = m.normal_maps = m.ies_lights = 1;
  m.ies_contrast = m.emission_contrast = m.max_specular = m.texture_deviation = m.normal_map_angle = m.pilot.max_blur =
      2;
  m.least_coverage = 0;
  m.has_environment = true;
  m.pilot.escaped = 500;
  m.specular = {{0.25, 0.375}, {0.25, 0.375}};
  EXPECT_EQ(plan_of(m).off(), 0U);
  // Masking, the last, is in no set: it has a test of its own.
  for (std::uint32_t i = 0; i < static_cast<std::uint32_t>(Effect::kMasking); ++i) {
    const std::string id(id_of(Effect{i}));
    const EffectsPlan off = plan_of(m, "-" + id);
    EXPECT_EQ(off.off(), bit_of(Effect{i})) << id;
    // The audit shows what was left out; what is folded is no other scene to it.
    EXPECT_EQ(off.exactly_off(), bit_of(Effect{i}) & kFoldable) << id;
    EXPECT_GT(decision(off, id).bound, 0) << id;
    EXPECT_NE(decision(off, id).bound_kind, "exact") << id;
    EXPECT_THAT(decision(off, id).note, testing::HasSubstr("forced off"));
    EXPECT_EQ(plan_of(m, "-" + id + ",+" + id).off(), 0U) << id;
    EXPECT_EQ(plan_of(m, "+" + id).off(), 0U) << id;
  }
}

TEST(PlanEffects, InterreflectionForcedOffHasABoundAlsoWhereThePilotSawNoDirectLight) {
  Measurements m = lit_room();
  m.pilot.direct_radiance = 0;
  EXPECT_NEAR(decision(plan_of(m, "-interreflection"), "interreflection").bound, 4 * 0.7 / 0.3, 1e-4);
  m.pilot.met_radiance = 0;
  EXPECT_NEAR(decision(plan_of(m, "-interreflection"), "interreflection").bound, 17 * 0.7 / 0.3, 1e-4);
  EXPECT_EQ(plan_of(m, "-interreflection").exactly_off(), 0U);
}

TEST(PlanEffects, WhatTheSceneDoesNotHaveIsForcedOffForNothing) {
  const EffectsPlan plan = plan_of(lit_room(), "-environment,-motion_blur");
  EXPECT_EQ(plan.off(), 0U);
  EXPECT_EQ(decision(plan, "environment").bound, 0);
}

TEST(PlanEffects, RefusesWhatItDoesNotKnowOrCannotDo) {
  Measurements gilded = lit_room();
  gilded.metals = 1;
  EXPECT_THAT(refusal("+sparkle"), testing::AllOf(testing::HasSubstr("'sparkle'"), testing::HasSubstr("area_lights")));
  EXPECT_THAT(refusal("interreflection"), testing::HasSubstr("+ or -"));
  EXPECT_THAT(refusal("+subsurface", gilded), testing::HasSubstr("cannot simulate 'subsurface'"));
  EXPECT_THAT(refusal("+motion_blur"), testing::HasSubstr("cannot simulate 'motion_blur'"));
  EXPECT_THAT(refusal("-bounces"), testing::HasSubstr("'bounces' cannot be switched off"));
  EXPECT_THAT(refusal("-interreflection,"), "no error");
}

TEST(PlanEffects, DecidesOurScenesAsTheyAreMade) {
  const auto measured = [](const char* name) {
    const World world(test::own_scene(name));
    return measure(world, {world.scene.cameras.at(0), 64, 48}, 1);
  };
  const Measurements closed = measured("furnace"), open = measured("point_light");
  EXPECT_EQ(closed.emissive_triangles, 12U);
  EXPECT_EQ(closed.max_radiance, 1);
  EXPECT_EQ(closed.pilot.escaped, 0U);
  EXPECT_GT(closed.pilot.walks, 0U);
  EXPECT_GT(open.pilot.escaped, 0U);
  EXPECT_TRUE(plan_of(open).is_active("punctual_lights"));
  EXPECT_FALSE(plan_of(open).is_active("area_lights"));
}

}  // namespace
}  // namespace radfarm
