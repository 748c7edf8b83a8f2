#pragma once

#include <optional>
#include <vector>

#include <nlohmann/json.hpp>

#include "effects/plan.h"
#include "frame/view.h"
#include "pipeline/pipeline.h"
#include "pipeline/solve_light.h"
#include "pipeline/stage_clock.h"
#include "scene/world.h"

namespace radfarm {

/// What is planned of a view, by whatever light.
struct PlannedView {
  const RenderRequest& request;
  const PrepareContext& context;
  const EffectsPlan& plan;
  const View& view;  // camera and settings as resolved
};

/// A view by the emitters that shine in one world.
struct PreparedLight {
  View view;                        // complete but for its facts
  std::vector<std::byte> solution;  // empty when the integrator needs none
  std::optional<EnergyLedger> energy;
  nlohmann::json counts = nlohmann::json::object();
  nlohmann::json said = nlohmann::json::object();  // for the report: `solution` and `perception`, those that there are
};

/// Radiosity of a world that is rendered, in this form.
Result<ObtainedLight> obtain_light(const World& world, const PlannedView& planned, LightForm form);

/// Solves and classifies what the integrator needs of the world's light. Stages "radiosity", "senders".
Result<PreparedLight> prepare_light(const World& world, const PlannedView& planned, StageClock& clock);

/// Adds up what light groups report: counts, and energy; its closure error is the mean by what they emit.
void add_facts(const PreparedLight& one, PreparedLight& sum);

}  // namespace radfarm
