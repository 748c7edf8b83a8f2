#include "effects/plan.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

namespace radfarm {
namespace {

constexpr const char* kMax = "max over pixels";
constexpr const char* kMean = "mean over pixels";
constexpr double kUnbounded = std::numeric_limits<double>::infinity();

// Light that adds less than this share to what is there is just invisible. [ALGORITHMS 4, T]
constexpr double kJustInvisible = 0.005;
constexpr double kLeastBlur = 0.5;         // pixels
constexpr double kLeastAngle = 1;          // degrees
constexpr double kLeastHole = 1.0 / 512;   // of coverage
constexpr double kLeastElevation = 1.05;
constexpr double kLeastDeviation = 1.0 / 512;
// What rough lobes send diffuse surfaces is spread too evenly instead, not lost.
constexpr double kMostFolded = 0.05;

/// An effect that is on where `value` exceeds `least`.
EffectDecision decide(std::string id, std::string test, double value, double least, double bound, const char* kind,
                      const char* scope, std::string note = "") {
  const bool active = value > least;
  return {std::move(id), active, std::move(test), value, active ? 0 : bound, bound == 0 ? "exact" : kind, scope,
          active ? "" : std::move(note)};
}

EffectDecision counted(std::string id, std::string test, std::size_t count, std::string note = "") {
  return decide(std::move(id), std::move(test), static_cast<double>(count), 0, 0, "exact", kMax, std::move(note));
}

/// An effect that is not simulated; `value` is what in the scene would call for it.
EffectDecision skip(std::string id, std::string test, double value, double bound, const char* kind, std::string note) {
  const double cost = value > 0 ? bound : 0;
  return {std::move(id), false, std::move(test), value, cost, cost > 0 ? kind : "exact", kMax, std::move(note)};
}

/// What has no cost to leave out and no switch: how the work is done, not what is simulated.
EffectDecision always(std::string id, std::string test, double value, std::string note) {
  return {std::move(id), true, std::move(test), value, 0, "exact", kMax, std::move(note)};
}

double max_radiance(const Measurements& m) { return m.punctual_lights > 0 ? kUnbounded : static_cast<double>(m.max_radiance); }

/// A share of a bound that may be unbounded: no share of it is nothing.
double times_share(double bound, double share) { return share > 0 ? bound * share : 0; }

/// What a surface on the way is likely to show, cd/m^2; where the pilot met no light at all, the brightest that there is.
double likely_radiance(const Measurements& m) {
  const double met = std::max(m.pilot.direct_radiance, m.pilot.met_radiance);
  return met > 0 ? met : max_radiance(m);
}

void add_light(const Measurements& m, std::vector<EffectDecision>& rows) {
  rows.push_back(counted("area_lights", "triangles that emit > 0", m.emissive_triangles));
  rows.push_back(counted("punctual_lights", "point, spot and directional lights > 0", m.punctual_lights));
  rows.push_back(decide("ies", "(I_max - I_mean) / I_mean of any IES light > 0.001", static_cast<double>(m.ies_contrast), 1e-3,
                        static_cast<double>(m.ies_contrast) * m.pilot.direct_radiance, "heuristic", kMean,
                        "the mean intensity in every direction"));
  const bool is_closed = m.pilot.walks > 0 && m.pilot.escaped == 0;
  const double escape = m.has_environment ? (is_closed ? 0 : static_cast<double>(m.pilot.escaped) / std::max(1U, m.pilot.walks)) : 0;
  rows.push_back(decide("environment", "map or sky given, and share of walks that leave the scene > 0", escape, 0,
                        m.has_environment ? m.pilot.escapes_at_most() * static_cast<double>(m.max_radiance) : 0, "95 %", kMean,
                        is_closed && m.has_environment ? "the scene is closed: its sky is left out" : "none given"));
  rows.push_back(counted("emission_textures", "emitting materials with a texture that is not even > 0",
                         m.emission_contrast > 0 ? m.emission_textures : 0));
}

void add_matter(const Measurements& m, std::vector<EffectDecision>& rows) {
  const double gloss = static_cast<double>(m.max_specular);
  rows.push_back(decide("gloss", "largest mean reflectance of a specular layer or metal > 0", gloss, 0, 0, "rigorous", kMax,
                        "Lambertian with the base colour"));
  rows.push_back(counted("clearcoat", "materials with a clear coat > 0", m.coats));
  rows.push_back(counted("sheen", "materials with sheen > 0", m.sheens));
  rows.push_back(counted("anisotropy", "materials with anisotropic gloss > 0", m.anisotropic));
  rows.push_back(counted("transmission", "materials that pass light into a volume > 0", m.volumes));
  rows.push_back(counted("panes", "materials that pass light through thin walls > 0", m.panes + m.rough_transmitters,
                         "no filter callback is bound"));
  rows.push_back(decide("alpha_cutouts", "1 - least coverage of any texel or vertex > 1/512", 1 - static_cast<double>(m.least_coverage),
                        kLeastHole, times_share(max_radiance(m), 1 - static_cast<double>(m.least_coverage)), "rigorous", kMax,
                        "no filter callback is bound"));
  rows.push_back(decide("reflectance_textures", "largest |rho - mean rho| of a texture > 1/512", static_cast<double>(m.texture_deviation),
                        kLeastDeviation, static_cast<double>(m.texture_deviation) * m.pilot.direct_radiance / std::max(0.01, static_cast<double>(m.max_reflectance)),
                        "heuristic", kMean, "the texture's mean colour"));
  rows.push_back(decide("normal_maps", "largest angle of a normal map's texel > 1 degree", static_cast<double>(m.normal_map_angle),
                        kLeastAngle, std::sin(static_cast<double>(m.normal_map_angle) * std::numbers::pi / 180) * m.pilot.direct_radiance,
                        "heuristic", kMean, "the interpolated normal"));
}

/// Light that diffuse surfaces have from specular ones, which photon paths carry, or radiosity as if those were diffuse.
void add_specular_light(const Measurements& m, Transport transport, std::vector<EffectDecision>& rows) {
  const auto row = [&](const char* id, const char* test, const SpecularShare& share, double least, const char* note) {
    EffectDecision decision = decide(id, test, share.share, least, times_share(likely_radiance(m), share.at_most), "heuristic", kMean, note);
    if (transport == Transport::kPathTrace && share.at_most > 0) decision = always(id, test, share.share, "by paths");
    rows.push_back(std::move(decision));
  };
  row("caustics", "share of the light that diffuse surfaces reflect which sharp specular lobes sent them > 0.005", m.specular.sharp,
      kJustInvisible, "as if those were diffuse; none passes solid glass");
  row("glossy_interreflection", "the same of rough lobes > 0.05", m.specular.rough, kMostFolded,
      "folded into diffuse; seen from the camera it is followed");
}

void add_transport(const Measurements& m, Transport transport, std::vector<EffectDecision>& rows) {
  const double passed_on = m.emitted_flux > 0 ? static_cast<double>(m.max_reflectance) * m.pilot.meets_at_most() : 0;
  const double gain = passed_on < 1 ? passed_on / (1 - passed_on) : kUnbounded;
  const double brightest = std::max(m.pilot.direct_radiance, m.pilot.met_radiance);
  rows.push_back(decide("interreflection", "rho phi / (1 - rho phi), phi: share of diffuse rays that meet what reflects, > 0.005",
                        gain, kJustInvisible, gain * brightest, m.pilot.met == 0 ? "95 %" : "heuristic", kMean, "direct light only; nothing is solved"));
  add_specular_light(m, transport, rows);
  rows.push_back(always("bounces", "interreflection is on", gain, "no bound on depth: what survives is decided by chance, unbiased"));
}

void add_camera(const Measurements& m, std::vector<EffectDecision>& rows) {
  rows.push_back(decide("depth_of_field", "largest circle of confusion > 0.5 pixel", static_cast<double>(m.pilot.max_blur), kLeastBlur,
                        m.pilot.max_blur > 0 ? m.pilot.direct_radiance : 0, "heuristic", kMax, "a pinhole: blur of at most half a pixel is left out"));
  rows.push_back(skip("motion_blur", "shutter > 0", 0, 0, "exact", "animation, skins and morphs at t = 0"));
}

void add_rest(const Measurements& m, std::vector<EffectDecision>& rows) {
  rows.push_back(always("colour", "largest deviation of a reflectance's or an emitter's channel from its luminance",
                        static_cast<double>(std::max(m.color_deviation, m.flux_color_deviation)),
                        "three channels are carried in any case: a vector unit holds them"));
  rows.push_back(always("channels", "channels in which light is emitted", static_cast<double>(3 - m.dark_channels),
                        "a channel without light stays exactly 0"));
  rows.push_back(skip("participating_media", "media declared > 0", 0, 0, "exact", "vacuum between surfaces; absorption inside volumes is part of transmission"));
  const auto lost = [&](const char* id, const char* test, std::size_t count, const char* note) {
    rows.push_back(skip(id, test, static_cast<double>(count), max_radiance(m), "rigorous", note));
  };
  lost("subsurface", "materials that scatter inside > 0", m.scattering, "diffuse reflection at the surface");
  lost("dispersion", "materials with dispersion > 0", m.dispersive, "one index of refraction for all colours");
  lost("iridescence", "materials with a thin film > 0", m.iridescent, "the layer without its film");
  rows.push_back(skip("adaptive_sampling", "samples that follow the pixel's variance", 0, 0, "exact", "the same number in every pixel"));
}

/// Masking only saves work: without it all is more accurate. In the default gather it saves none (docs/effects.md).
void add_masking(const Measurements& m, Transport transport, std::vector<EffectDecision>& rows) {
  EffectDecision row = decide("masking", "mean elevation of the visible threshold by detail > 1.05", m.detail_elevation,
                              kLeastElevation, 0, "exact", kMean, "no detail to mask: the plain threshold");
  if (transport != Transport::kPaperGather && row.active) {
    row.active = false;
    row.note = transport == Transport::kPathTrace ? "paths have no threshold"
                                                  : "the plain threshold: masking saves nothing with a fixed number of samples";
  }
  rows.push_back(std::move(row));
}

EffectDecision* find(EffectsPlan& plan, std::string_view id) {
  const auto found = std::find_if(plan.effects.begin(), plan.effects.end(), [&](const auto& e) { return e.id == id; });
  return found == plan.effects.end() ? nullptr : &*found;
}

/// What leaving out an effect costs that the scene calls for: nothing says how much, but for light that is not reflected.
void force_off(EffectDecision& row, const Measurements& m) {
  row.active = false;
  row.note = "forced off by --effects" + (row.note.empty() ? "" : ": " + row.note);
  if (row.value == 0 || effect_of(row.id) == Effect::kMasking) return;
  const double reflected = static_cast<double>(m.max_reflectance);
  const bool is_folded = (bit_of(effect_of(row.id)) & kFoldable) != 0;
  if (row.id == "interreflection" || is_folded) {
    row.bound = row.value * likely_radiance(m);
    row.bound_kind = "heuristic";
  } else {
    row.bound = std::max(reflected, 1.0) * max_radiance(m);
    row.bound_kind = "rigorous", row.bound_scope = kMax;
  }
}

/// Whether an effect can be forced off: of what paths carry nothing is folded.
bool can_be_off(std::string_view id, Transport transport) {
  const Effect effect = effect_of(id);
  return effect != Effect::kCount && !(transport == Transport::kPathTrace && (bit_of(effect) & kFoldable) != 0);
}

Status force(EffectsPlan& plan, const Measurements& m, Transport transport, std::string_view item) {
  const bool on = item.starts_with('+');
  if (!on && !item.starts_with('-')) {
    return fail(Code::kInvalidArgument, "--effects: '" + std::string(item) + "' must start with + or -");
  }
  const std::string_view id = item.substr(1);
  EffectDecision* row = find(plan, id);
  if (row == nullptr) {
    std::string known;
    for (const EffectDecision& e : plan.effects) known += (known.empty() ? "" : ", ") + e.id;
    return fail(Code::kInvalidArgument, "--effects: no effect '" + std::string(id) + "'; there are " + known);
  }
  if (on && !row->active && effect_of(id) == Effect::kCount) {
    return fail(Code::kInvalidArgument, "--effects: radfarm cannot simulate '" + std::string(id) + "': " + row->note);
  }
  if (!on && row->active && !can_be_off(id, transport)) {
    return fail(Code::kInvalidArgument, "--effects: '" + std::string(id) + "' cannot be switched off: " + row->note);
  }
  if (!on) {
    force_off(*row, m);
  } else if (!row->active) {
    row->active = true, row->bound = 0, row->note = "forced on by --effects";
  }
  return {};
}

double total(const EffectsPlan& plan, std::string_view scope) {
  double sum = 0;
  for (const EffectDecision& e : plan.effects) sum += !e.active && e.bound_scope == scope ? e.bound : 0;
  return sum;
}

}  // namespace

bool EffectsPlan::is_active(std::string_view id) const {
  return std::any_of(effects.begin(), effects.end(), [&](const auto& e) { return e.id == id && e.active; });
}

EffectSet EffectsPlan::off() const {
  EffectSet set = 0;
  for (const EffectDecision& e : effects) {
    const Effect effect = effect_of(e.id);
    if (effect == Effect::kMasking) continue;
    if (!e.active && effect != Effect::kCount && (e.value > 0 || e.bound > 0 || effect == Effect::kInterreflection)) set |= bit_of(effect);
  }
  return set;
}

EffectSet EffectsPlan::exactly_off() const {
  EffectSet set = off();
  for (const EffectDecision& e : effects) {
    // What is folded is so in radiosity alone: the path tracer knows no switch for it.
    if (e.bound > 0 && effect_of(e.id) != Effect::kCount) set &= ~bit_of(effect_of(e.id)) | kFoldable;
  }
  return set;
}

double EffectsPlan::total_mean_bound() const { return total(*this, kMean); }
double EffectsPlan::total_max_bound() const { return total(*this, kMax); }

Result<EffectsPlan> plan_effects(const Measurements& m, Transport transport, std::string_view forced) {
  EffectsPlan plan;
  add_light(m, plan.effects);
  add_transport(m, transport, plan.effects);
  add_matter(m, plan.effects);
  add_camera(m, plan.effects);
  add_rest(m, plan.effects);
  add_masking(m, transport, plan.effects);
  while (!forced.empty()) {
    const std::size_t comma = forced.find(',');
    RADFARM_TRY_STATUS(force(plan, m, transport, forced.substr(0, comma)));
    forced = comma == std::string_view::npos ? "" : forced.substr(comma + 1);
  }
  return plan;
}

}  // namespace radfarm
