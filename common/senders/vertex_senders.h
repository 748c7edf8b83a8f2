#pragma once

#include <cstdint>
#include <vector>

#include "senders/cut.h"
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
  float visibility = 1;
  // What a point needs to judge how much the sender may give it, before anything is sampled:
  Vec3 center{0, 0, 0};
  float radius = 0;                        // of a sphere around the center that holds the sender, m
  Vec3 normal{0, 0, 0};                    // unit for patches; zero for clusters, which have no single one
  float power = 0;                         // luminance, lm
  float prior = 1;                         // share of `power` expected to be visible, never near 0
};

/// The irradiance (luminance, lux) that the sender is likely to give a point with this normal, unoccluded, times `prior`: what
/// gathering samples in proportion to. Within a small factor of the truth wherever the sender can be seen; 0 only where
/// it certainly gives nothing.
float likely_irradiance(const CriticalSender& sender, const Vec3& position, const Vec3& normal);

/// What one grid vertex knows of all light: complete by itself. E_v(n) = sum of lobes + sum of critical senders.
struct VertexSenders {
  std::vector<Lobe> lobes;
  std::vector<CriticalSender> critical;
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
