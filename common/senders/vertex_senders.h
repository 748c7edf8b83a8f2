#pragma once

#include <cstdint>
#include <vector>

#include "senders/cut.h"
#include "senders/likely.h"
#include "senders/receivers.h"

namespace radfarm {

/// Light that is interpolated: irradiance at normal incidence from one direction. Senders of nearly one direction share one.
struct Lobe {
  Vec3 direction{0, 0, 1};  // unit, towards the senders
  Spectrum direct;          // lux
  Spectrum indirect;
};

/// A sender whose light is sampled again at every visible point.
struct CriticalSender {
  std::uint32_t node = 0;
  std::uint32_t resample_form_factor = 0;  // 1: sampled or computed at the point; 0: `direct` and `indirect` times a cosine
  std::uint32_t resample_visibility = 0;   // 1: by rays at the point; 0: `visibility`
  Vec3 direction{0, 0, 1};                 // unit, towards the sender
  Spectrum direct;                         // unoccluded irradiance at normal incidence, lux
  Spectrum indirect;
  Spectrum visibility{1.0F};               // by colour: panes
  SenderOutline outline;
  float prior = 1;                         // share of the sender expected to be visible, never near 0
};

/// What one grid vertex knows of all light: complete by itself. E_v(n) = sum of lobes + sum of critical senders.
/// The sky's light is always resampled, by `sky`.
struct VertexSenders {
  std::vector<Lobe> lobes;
  std::vector<CriticalSender> critical;
  std::vector<float> sky;  // per sky patch: share expected to be visible, never near 0; empty without environment
};

/// Everything that vertex_senders() depends on.
struct VertexContext {
  const World& world;
  const SenderTree& tree;
  const PerspectiveGrid& grid;
  const Receivers& receivers;
  const SenderSettings& settings;
  std::uint64_t seed = 0;
};

/// Paper 1's four-way classification at one vertex: form factor and visibility of each sender are interpolated or resampled
/// by how much the largest change of radiance would be, eq. 2 and 3, against the threshold. Samples go to senders by their
/// unoccluded irradiance, eq. 1, at least 4 each (ALGORITHMS A4), from real receiver points (A12).
/// docs/pipeline.md (senders.2) to (senders.4). Pure: any worker computes the same bits. About 1 ms.
VertexSenders vertex_senders(const VertexContext& context, std::uint32_t vertex);

}  // namespace radfarm
