#pragma once

#include <cstddef>
#include <cstdint>
#include <memory>
#include <span>
#include <vector>

#include "base/status.h"
#include "math/spectrum.h"
#include "math/vec.h"
#include "radiosity/solve.h"

namespace radfarm {

/// What of a radiosity solution sends light by lines to it, the senders: nodes and patches with power, emitted and reflected
/// apart; and what sends by rays that meet it, the reflectors. Independent of any camera; stored as one flat file of kind
/// "solution" that every view of the scene shares.                                      docs/pipeline.md (senders.0)
struct SenderNode {
  Box3 bounds;
  Vec3 cone_axis{0, 0, 1};
  float cone_cosine = -1;         // as Node::cone_cosine
  float area = 0;                 // m^2
  Spectrum emitted_power;         // lm
  Spectrum reflected_power;       // lm
  std::uint32_t first_child = kNone;
  std::uint32_t child_count = 0;
  std::uint32_t patch = kNone;    // kNone for clusters and for patches in parts, which have children
  float power = 0;                // luminance of both powers together, lm
  float max_radiosity = 0;        // luminance, lm/m^2: the largest of all patches below
};

struct SenderPatch {
  TriangleVertices vertices;
  Vec3 normal{0, 0, 1};
  float area = 0;   // m^2
  float offset = 0;
  std::uint32_t instance = 0;
  std::uint32_t triangle = 0;
  std::uint32_t is_front = 1;             // whether it is the triangle's front side
  std::uint32_t emits = 0;
  std::uint32_t is_textured_emitter = 0;
};

/// An undivided patch that reflects; where all are senders, one that only emits as well.
struct Reflector {
  TriangleVertices vertices;
  Spectrum radiance;         // reflected, the same in all directions, cd/m^2
  Spectrum of_direct;        // of it, light straight from emitters
  std::uint32_t instance = 0;
  std::uint32_t triangle = 0;
  std::uint32_t is_front = 1;
  std::uint32_t by_lines = 0;  // 1: points of the grid have its light by lines to it, however near
  std::uint32_t sender = kNone;  // the patch's node among the senders, if it is one
  float reflectance = 0;         // luminance of rho, mean over the patch
  std::uint32_t is_doubtful = 0; // 1: far more from other surfaces than is usual: who sees a part of it may not see that
};

/// What reflects by lines, too. Where that is everything, rays bring what is nearer than a grid cell is wide.
enum class SenderChoice : std::uint32_t { kBright = 0, kAll = 1 };

/// Read in place: from the bytes of a stored solution, which must then outlive it, or from arrays of its own.
struct SenderTree {
  std::span<const SenderNode> nodes;  // 0 is the root; empty when nothing sends
  std::span<const SenderPatch> patches;
  std::span<const Reflector> reflectors;
  SenderChoice choice = SenderChoice::kBright;
  std::shared_ptr<const void> arrays;  // keeps alive what these view, where the tree owns it
};

/// A tree that owns its arrays.
SenderTree own_sender_tree(std::vector<SenderNode> nodes, std::vector<SenderPatch> patches,
                           std::vector<Reflector> reflectors = {}, SenderChoice choice = SenderChoice::kBright);

/// Emitters are always senders. By kBright, of what reflects only patches are that emitters make far brighter than is
/// usual in the scene: cosine-distributed rays find all else with little noise and need to know nothing of visibility. O(nodes).
SenderTree make_sender_tree(const RadiositySolution& solution, SenderChoice choice = SenderChoice::kBright);

[[nodiscard]] std::vector<std::byte> encode(const SenderTree& tree);
/// A view of `bytes`, which must outlive it and what is copied from it: no process that maps the same file holds a copy. Hostile
/// bytes give DATA_LOSS: every index is checked, children come after their parent.
Result<SenderTree> decode_sender_tree(std::span<const std::byte> bytes);

/// A point of a sender, chosen by the luminance of what its patches send, uniform on the patch.
struct SenderSample {
  Vec3 position{0, 0, 0};
  Vec3 normal{0, 0, 1};
  float offset = 0;
  std::uint32_t patch = 0;
  float u = 0, v = 0;   // weights of the patch's vertices 1 and 2
  Vec3 leave() const { return position + normal * offset; }
};
SenderSample sample_sender(const SenderTree& tree, std::uint32_t node, float choice, const Vec2& u);

/// The i-th of a sender's own sequence of such points, the same wherever it is asked for: the paper's fixed sample positions.
SenderSample fixed_sample(const SenderTree& tree, std::uint32_t node, std::uint32_t i);

}  // namespace radfarm
