#pragma once

#include <cstdint>
#include <functional>
#include <limits>

#include "scene/world.h"

namespace radfarm {

/// What a segment of a light path leaves: the class of the light that it brings (DESIGN 3). Bits of a set.
enum class Origin : std::uint32_t { kEmitter = 1, kDiffuse = 2, kSpecular = 4 };
using OriginSet = std::uint32_t;
inline constexpr OriginSet kAllOrigins = 7;
constexpr bool contains(OriginSet set, Origin origin) { return (set & static_cast<OriginSet>(origin)) != 0; }

/// A straight piece of a light path: from an emitter or a surface to the next surface, or out of the scene. A pane ends
/// it; what passes goes on as a segment of the same origin that begins at the pane.
struct Segment {
  Ray ray;                                             // unit direction; its origin is where it left `origin`
  float begin = 0;                                     // distance from which it carries `power`, m
  float end = std::numeric_limits<float>::infinity();  // of the surface that it meets
  Spectrum power;  // lm, as if there were no other path: the mean over paths is the scene's light
  Origin origin = Origin::kEmitter;  // kDiffuse too where a surface's gloss is folded into diffuse
  bool leaves_specular = false;      // by a specular lobe, folded or not
  Vec3 plane{0, 0, 0};       // unit normal of the surface that it left, on the side of the ray; zero: points, sky
  std::uint32_t bounce = 0;  // surfaces met before; panes count
  // The surface that it meets, where it meets one:
  std::uint32_t instance = kNone;
  std::uint32_t triangle = kNone;
  Vec3 end_normal{0, 0, 0};  // unit, geometric, against the ray
};

/// Light that paths lose, luminance in lm; the rest is absorbed by what Segment::power shows.
struct PathLosses {
  double absorbed = 0;
  double escaped = 0;
};

/// Who is shown the segments of a path, in the order of its bounces.
using SeeSegment = std::function<void(const Segment&)>;

/// Follows light path `index` from its emitter until it is absorbed or leaves the scene.     docs/pipeline.md (paths.1)
///
/// The emitter is chosen as sample_emission() does; at a surface, one of its parts (diffuse, specular, straight through
/// a pane) goes on, chosen by what they send on, and survives with the share of luminance that is sent on: so the
/// luminance of `power` is the same along the path where albedos are exact, and a channel is at most 1 / y_k of it.
/// Random numbers are Sobol points keyed by (key, bounce, use) and indexed by the path, so any worker makes any path
/// again. 64 bits of index. Requires: emitters.size() > 0. Cost: about 1 us a segment.
PathLosses follow_path(const World& world, std::uint64_t key, std::uint64_t index, const SeeSegment& see);

/// Light paths that share one scrambled sequence; batches of one seed are independent of each other.
struct PathBatch {
  std::uint64_t seed = 1;
  std::uint64_t batch = 0;
  std::uint64_t paths = 0;
};

/// Follows the paths of a batch one after the other, and calls `end_path` after each. On the caller's thread.
PathLosses follow_batch(const World& world, const PathBatch& batch, const SeeSegment& see,
                        const std::function<void()>& end_path);

}  // namespace radfarm
