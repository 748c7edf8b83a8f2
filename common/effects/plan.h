#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "base/status.h"
#include "effects/measure.h"

namespace radfarm {

/// Whether one effect is simulated, by which test, and what leaving it out can cost. docs/effects.md
struct EffectDecision {
  std::string id;
  bool active = false;
  std::string test;         // in words, true when the effect is needed
  double value = 0;         // what the test measured
  double bound = 0;         // largest error of skipping, cd/m^2
  std::string bound_kind;   // exact, rigorous, 95 % or heuristic
  std::string bound_scope;  // mean or max over pixels
  std::string note;         // what is done instead
};

struct EffectsPlan {
  std::vector<EffectDecision> effects;
  bool is_active(std::string_view id) const;
};

/// Decides every effect. `forced` is "+id,-id,..."; an unknown id, or switching on what radfarm cannot simulate yet, is
/// INVALID_ARGUMENT. Pure.
Result<EffectsPlan> plan_effects(const Measurements& measurements, std::string_view forced);

}  // namespace radfarm
