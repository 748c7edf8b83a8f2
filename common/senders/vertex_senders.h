#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "senders/cut.h"
#include "senders/likely.h"
#include "senders/receivers.h"

namespace radfarm {

/// All senders that a vertex interpolates may together change radiance by this many thresholds.
inline constexpr float kMaxTail = 5;

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
  float samples = 0;                       // of the paper's gather: so many sample points, a real number (paper.4)
};

/// How many senders a vertex has in each of paper 1's classes: what is sampled again at every visible point.
struct SenderClasses {
  std::uint32_t interpolated = 0;  // nothing
  std::uint32_t form_factor = 0;
  std::uint32_t visibility = 0;
  std::uint32_t both = 0;
  std::uint32_t total() const { return interpolated + form_factor + visibility + both; }
  friend bool operator==(const SenderClasses&, const SenderClasses&) = default;
};

/// What one grid vertex knows of all light: complete by itself. E_v(n) = sum of lobes + sum of critical senders.
/// The sky's light is always resampled, by `sky`.
struct VertexSenders {
  std::vector<Lobe> lobes;
  std::vector<CriticalSender> critical;
  std::vector<float> sky;  // per sky patch: share expected to be visible, never near 0; empty without environment
  SenderClasses classes;
};

struct PaperContext;

/// Everything that vertex_senders() depends on.
struct VertexContext {
  const World& world;
  const SenderTree& tree;
  const PerspectiveGrid& grid;
  const Receivers& receivers;
  std::span<const float> thresholds;  // T of (senders.4), one a vertex, cd/m^2
  const SenderSettings& settings;
  std::uint64_t seed = 0;
  const PaperContext* paper = nullptr;  // of the paper's gather alone
};

/// Where the points are that interpolate a vertex: within the cells around it.
ReceiverRegion region_around(const PerspectiveGrid& grid, std::uint32_t vertex);

/// (senders.1) Unoccluded irradiance that a sender may give in the region, luminance.
float unoccluded(const SenderNode& node, const ReceiverRegion& region);

/// Within what distance of a point reflecting surfaces are left to rays where all of them are senders: a grid cell's width.
/// Else 0: rays go as far as they can.
inline float near_distance(const SenderTree& tree, const PerspectiveGrid& grid, const Vec3& position) {
  return tree.choice == SenderChoice::kAll ? grid.cell_width(position) : 0;
}

/// Paper 1's four-way classification at one vertex: form factor and visibility of each sender are interpolated or resampled
/// by how much the largest change of radiance would be, eq. 2 and 3, against the threshold. Samples go to senders by their
/// unoccluded irradiance, eq. 1, at least 4 each (ALGORITHMS A4), from real receiver points (A12).
/// docs/pipeline.md (senders.2) to (senders.4). Pure: any worker computes the same bits. About 1 ms.
VertexSenders vertex_senders(const VertexContext& context, std::uint32_t vertex);

}  // namespace radfarm
