#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "base/status.h"
#include "effects/measure.h"
#include "effects/specialise.h"

namespace radfarm {

/// Whether one effect is simulated, by which test, and what leaving it out can cost. docs/effects.md
struct EffectDecision {
  std::string id;
  bool active = false;
  std::string test;         // in words, true when the effect is needed
  double value = 0;         // what the test measured
  double bound = 0;         // largest error of skipping, cd/m^2 of reflected light; 0 of active effects
  std::string bound_kind;   // exact, rigorous, 95 % or heuristic
  std::string bound_scope;  // mean or max over pixels
  std::string note;         // what is done instead
};

struct EffectsPlan {
  std::vector<EffectDecision> effects;

  bool is_active(std::string_view id) const;
  /// What is left out of what the scene has, and the part of that which changes no image: bound 0, exact.
  EffectSet off() const;
  EffectSet exactly_off() const;
  /// The bounds of all that is left out, added up: over the mean of pixels, and at the worst pixel.
  double total_mean_bound() const;
  double total_max_bound() const;
};

/// Which integrator the plan is for: the path tracer carries what the gather leaves out.
enum class Transport { kGather, kPaperGather, kPathTrace };

/// Decides every effect. `forced` is "+id,-id,..."; an unknown id, or switching on what radfarm cannot simulate, is
/// INVALID_ARGUMENT. Pure.
Result<EffectsPlan> plan_effects(const Measurements& measurements, Transport transport, std::string_view forced);

}  // namespace radfarm
