#pragma once

#include <cstdint>

#include "radiosity/hierarchy.h"
#include "radiosity/oracles.h"

namespace radfarm {

inline constexpr std::uint32_t kEmittedPart = 1;
inline constexpr std::uint32_t kReflectedPart = 2;

/// How light of one sender reaches one receiver: form factor and visibility apart, emitted and reflected light apart.
///
/// A patch receiver gets the irradiance E = reflected * P from the power P (lm) that the sender reflects; a cluster receiver gets
/// the same formula at normal incidence, and its patches their cosine to `direction`; a cluster's link to itself gives all its
/// patches the mean irradiance. The emitted part only steers refinement: direct light is in sample_direct(). (radiosity.3)
struct Link {
  bool has_direction(const Node& receiver_node) const { return receiver_node.is_cluster() && receiver != sender; }

  std::uint32_t receiver = 0;
  std::uint32_t sender = 0;         // a node, or source_sender(source)
  Vec3 direction{0, 0, 0};          // unit, from receiver to sender
  float emitted = 0;                // 1/m^2; of a source: lux (luminance)
  float reflected = 0;              // 1/m^2
  float emitted_error = 0;          // the part of `emitted` that may be misplaced, by the oracle
  float reflected_error = 0;
  float visibility = 1;             // mean over the samples
  float occluder_distance = 0;      // from the receiver to the closest occluder met, m; 0: none met
  std::uint32_t evaluated = 0;      // parts of the sender's light it was evaluated for: kEmittedPart | kReflectedPart
};

/// Senders that are no surfaces count down from the top: the punctual lights, then the sky's map, then its sun.
constexpr std::uint32_t source_sender(std::uint32_t source) { return kNone - 1 - source; }
constexpr bool is_source(std::uint32_t sender) { return sender >= 0x80000000U; }
constexpr std::uint32_t source_index(std::uint32_t sender) { return kNone - 1 - sender; }
inline std::uint32_t source_count(const World& world) {
  return static_cast<std::uint32_t>(world.emitters.punctual.size()) + (world.environment.is_empty() ? 0 : 2);
}

/// Whether it is certain that no light passes from one node to the other: they look away from each other.
bool cannot_see(const Hierarchy& hierarchy, std::uint32_t a, std::uint32_t b);

/// Evaluates a link with `samples` random lines between the elements for each of `parts` (kEmittedPart, kReflectedPart).
/// Unoccluded factors of patch senders are exact (Lambert's polygon formula), of clusters sampled. Keyed by (seed, receiver,
/// sender): the same bits whoever computes it. `oracle` fills the errors. About 0.5 us a line.
/// Requires: sender < hierarchy.nodes.size() (sources: evaluate_source).
Link evaluate_link(const World& world, const Hierarchy& hierarchy, std::uint32_t receiver, std::uint32_t sender,
                   std::uint32_t parts, std::uint32_t samples, std::uint64_t seed, const LinkOracle& oracle = {});

/// The same for a source: `emitted` is the mean irradiance (luminance, at normal incidence for clusters) in lux that arrives. Each
/// of the `samples` points of a receiver looks at the sky in the same directions, so that what differs is what hides it.
Link evaluate_source(const World& world, const Hierarchy& hierarchy, std::uint32_t receiver, std::uint32_t source,
                     std::uint32_t samples, std::uint64_t seed, const LinkOracle& oracle = {});

}  // namespace radfarm
