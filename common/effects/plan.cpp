#include "effects/plan.h"

#include <algorithm>
#include <limits>

namespace radfarm {
namespace {

constexpr const char* kMax = "max over pixels";

EffectDecision decide(std::string id, std::string test, double value, double bound, const char* kind,
                      std::string note = "") {
  const bool active = value > 0;
  return {std::move(id), active, std::move(test), value, active ? 0 : bound, kind, kMax, std::move(note)};
}

/// An effect that this version cannot simulate; `value` counts what in the scene would call for it.
EffectDecision skip(std::string id, std::string test, double value, double bound, std::string note) {
  return {std::move(id), false, std::move(test), value, value > 0 ? bound : 0, value > 0 ? "rigorous" : "exact", kMax,
          std::move(note)};
}

bool can_simulate(std::string_view id) {
  return id == "area_lights" || id == "punctual_lights" || id == "interreflection" || id == "alpha_cutouts" ||
         id == "reflectance_textures" || id == "emission_textures";
}

Status force(EffectsPlan& plan, std::string_view item) {
  const bool on = item.starts_with('+');
  if (!on && !item.starts_with('-')) {
    return fail(Code::kInvalidArgument, "--effects: '" + std::string(item) + "' must start with + or -");
  }
  const std::string_view id = item.substr(1);
  const auto found = std::find_if(plan.effects.begin(), plan.effects.end(), [&](const auto& e) { return e.id == id; });
  if (found == plan.effects.end()) {
    std::string known;
    for (const EffectDecision& e : plan.effects) known += (known.empty() ? "" : ", ") + e.id;
    return fail(Code::kInvalidArgument, "--effects: no effect '" + std::string(id) + "'; there are " + known);
  }
  if (on && !can_simulate(id)) {
    return fail(Code::kInvalidArgument, "--effects: radfarm cannot simulate '" + std::string(id) + "' yet");
  }
  if (!on && id != "interreflection") {
    return fail(Code::kInvalidArgument, "--effects: only interreflection can be switched off so far");
  }
  found->active = on;
  found->note = "forced by --effects";
  return {};
}

}  // namespace

bool EffectsPlan::is_active(std::string_view id) const {
  return std::any_of(effects.begin(), effects.end(), [&](const auto& e) { return e.id == id && e.active; });
}

Result<EffectsPlan> plan_effects(const Measurements& m, std::string_view forced) {
  const double unbounded = std::numeric_limits<double>::infinity();
  const double max_radiance = m.punctual_lights > 0 ? unbounded : m.max_radiance;
  const bool is_lit = m.emitted_flux > 0;
  EffectsPlan plan;
  plan.effects = {
      decide("area_lights", "triangles that emit > 0", static_cast<double>(m.emissive_triangles), 0, "exact"),
      decide("punctual_lights", "point, spot and directional lights > 0", static_cast<double>(m.punctual_lights), 0,
             "exact"),
      decide("interreflection", "largest reflectance, when light is emitted, > 0", is_lit ? m.max_reflectance : 0.0, 0,
             "exact"),
      decide("alpha_cutouts", "meshes with coverage below 1 > 0", static_cast<double>(m.cutout_meshes), 0, "exact",
             "no filter callback is bound to opaque meshes"),
      decide("reflectance_textures", "materials with a colour texture > 0", static_cast<double>(m.reflectance_textures),
             0, "exact", "full texture at the visible surface, patch mean in interreflection"),
      decide("emission_textures", "emitting materials with a texture > 0", static_cast<double>(m.emission_textures), 0,
             "exact"),
      skip("glossy_reflection", "materials that are not Lambertian > 0", static_cast<double>(m.glossy_materials),
           max_radiance, "folded into diffuse reflectance (accuracy.model is diffuse-only)"),
      skip("transmission", "materials that transmit > 0", 0, 0, "a transmissive material counts as glossy_reflection"),
      skip("caustics", "lit specular surfaces > 0", static_cast<double>(m.glossy_materials), max_radiance,
           "no specular surface is simulated"),
      skip("environment", "environment map or sky given", 0, 0, "none given: what escapes is lost"),
      skip("depth_of_field", "lens diameter > 0", 0, 0, "pinhole camera"),
      skip("motion_blur", "shutter > 0", 0, 0, "animation, skins and morphs at t = 0"),
      skip("participating_media", "media declared > 0", 0, 0, "vacuum"),
  };
  while (!forced.empty()) {
    const std::size_t comma = forced.find(',');
    RADFARM_TRY_STATUS(force(plan, forced.substr(0, comma)));
    forced = comma == std::string_view::npos ? "" : forced.substr(comma + 1);
  }
  return plan;
}

}  // namespace radfarm
