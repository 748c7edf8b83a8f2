#include "senders/sender_tree.h"

#include <algorithm>

#include "base/flat_file.h"
#include "base/random.h"
#include "math/sampling.h"
#include "math/sobol.h"

namespace radfarm {
namespace {

constexpr std::uint32_t kVersion = 5;

// A patch that emitters give so many times the usual radiosity is a sender: rays would seldom meet it, and bring much when they do. One that
// other surfaces give as much is doubted: light that is caught in a gap, and smeared over the patch's open part.
constexpr double kBright = 8;

/// What the nodes of a solution send by lines.
struct Sent {
  const Hierarchy& hierarchy;
  const std::vector<Spectrum>& reflected;  // lm, one a node

  float of(std::uint32_t node) const { return luminance(hierarchy.nodes[node].emitted_power) + luminance(reflected[node]); }
};

/// A tree that grows.
struct Arrays {
  std::vector<SenderNode> nodes;
  std::vector<SenderPatch> patches;
  std::vector<Reflector> reflectors;
};

double radiosity(const Node& node, const Spectrum& power) {
  return static_cast<double>(luminance(power)) / static_cast<double>(node.area);
}

/// What a patch reflects of light straight from emitters, as far as the solution tells it apart.
const Spectrum& lit_power(const RadiositySolution& solution, std::size_t node) {
  return solution.reflected_direct.empty() ? solution.reflected_power[node] : solution.reflected_direct[node];
}

/// The mean radiosity of patches that are not far brighter than it, lm/m^2.
double usual_radiosity(const RadiositySolution& solution) {
  const std::vector<Node>& nodes = solution.hierarchy.nodes;
  double mean = std::numeric_limits<double>::infinity(), before = 0;
  while (mean != before) {
    double power = 0, area = 0;
    for (std::size_t i = 0; i < nodes.size(); ++i) {
      if (!is_undivided(nodes[i]) || radiosity(nodes[i], solution.reflected_power[i]) > kBright * mean) continue;
      power += static_cast<double>(luminance(solution.reflected_power[i]));
      area += static_cast<double>(nodes[i].area);
    }
    before = mean;
    mean = area > 0 ? power / area : 0;  // falls from round to round, for a finite number of them
  }
  return mean;
}

/// What the nodes reflect by lines, lm.
std::vector<Spectrum> reflected_by_lines(const RadiositySolution& solution, SenderChoice choice, double usual) {
  std::vector<Spectrum> power = solution.reflected_power;
  if (choice == SenderChoice::kAll) return power;
  const std::vector<Node>& nodes = solution.hierarchy.nodes;
  for (std::size_t i = 0; i < nodes.size(); ++i) {
    if (!is_undivided(nodes[i]) || radiosity(nodes[i], lit_power(solution, i)) < kBright * usual) power[i] = {};
  }
  pull_up(solution.hierarchy, power);
  return power;
}

/// All that reflects. Where all are senders, what is near comes by rays, but for emitters, whose lines go to near ones as well.
std::vector<Reflector> make_reflectors(const RadiositySolution& solution, const std::vector<Spectrum>& by_lines,
                                       const std::vector<std::uint32_t>& sender_of, SenderChoice choice, double usual) {
  std::vector<Reflector> reflectors;
  const bool has_all = choice == SenderChoice::kAll;
  for (std::size_t i = 0; i < solution.hierarchy.nodes.size(); ++i) {
    const Node& node = solution.hierarchy.nodes[i];
    if (!is_undivided(node)) continue;
    const Spectrum& power = solution.reflected_power[i];
    const Patch& patch = solution.hierarchy.patches[node.patch];
    if (is_black(power) && !(has_all && !is_black(patch.emission))) continue;
    const bool lines_bring_it = has_all ? !is_black(patch.emission) : !is_black(by_lines[i]);
    const Spectrum of_direct = solution.reflected_direct.empty() ? Spectrum() : solution.reflected_direct[i];
    const float to_radiance = kInversePi / node.area;
    reflectors.push_back({patch.vertices, power * to_radiance, of_direct * to_radiance, patch.instance, patch.triangle, patch.is_front,
                          lines_bring_it ? 1U : 0U, sender_of[i], luminance(patch.reflectance),
                          radiosity(node, power - lit_power(solution, i)) > kBright * usual ? 1U : 0U});
  }
  return reflectors;
}

/// Which sender each of the solution's patches is, or a part of; kNone elsewhere. `source` is the node behind each sender.
std::vector<std::uint32_t> senders_of_patches(const Hierarchy& hierarchy, const std::vector<std::uint32_t>& source) {
  std::vector<std::uint32_t> sender_of(hierarchy.nodes.size(), kNone);
  for (std::uint32_t i = 0; i < source.size(); ++i) sender_of[source[i]] = i;
  // Children come after their parent.
  for (std::size_t i = 0; i < hierarchy.nodes.size(); ++i) {
    const Node& node = hierarchy.nodes[i];
    if (node.is_cluster()) continue;
    for (std::uint32_t c = 0; c < node.child_count; ++c) {
      if (sender_of[node.first_child + c] == kNone) sender_of[node.first_child + c] = sender_of[i];
    }
  }
  return sender_of;
}

SenderNode make_node(const RadiositySolution& solution, const Sent& sent, std::uint32_t id, bool is_leaf, Arrays& tree) {
  const Node& node = solution.hierarchy.nodes[id];
  SenderNode sender;
  sender.bounds = node.bounds;
  sender.cone_axis = node.cone_axis;
  sender.cone_cosine = node.cone_cosine;
  sender.area = node.area;
  sender.emitted_power = node.emitted_power;
  sender.reflected_power = sent.reflected[id];
  sender.power = luminance(sender.emitted_power) + luminance(sender.reflected_power);
  if (is_leaf) {
    const Patch& patch = solution.hierarchy.patches[node.patch];
    sender.patch = static_cast<std::uint32_t>(tree.patches.size());
    tree.patches.push_back({patch.vertices, patch.normal, node.area, patch.offset, patch.instance, patch.triangle,
                            patch.is_front, is_black(patch.emission) ? 0U : 1U, patch.is_textured_emitter});
  }
  return sender;
}

/// The children that send something; a cluster with only one such child stands for it. A patch that only emits does so
/// evenly and stays whole: its form factor is exact at any size. What a patch in parts reflects differs from part to part.
std::vector<std::uint32_t> sending_children(const Sent& sent, std::uint32_t id) {
  std::vector<std::uint32_t> children;
  const Node& node = sent.hierarchy.nodes[id];
  if (!node.is_cluster() && is_black(sent.reflected[id])) return children;
  for (std::uint32_t i = 0; i < node.child_count; ++i) {
    if (sent.of(node.first_child + i) > 0) children.push_back(node.first_child + i);
  }
  return children;
}

bool is_sound(const SenderTree& tree) {
  for (std::size_t i = 0; i < tree.nodes.size(); ++i) {
    const SenderNode& node = tree.nodes[i];
    const bool has_children = node.child_count > 0;
    if (has_children && (node.first_child <= i || node.child_count > 4 || node.child_count > tree.nodes.size() ||
                         node.first_child > tree.nodes.size() - node.child_count)) {
      return false;
    }
    if (node.patch == kNone ? !has_children : node.patch >= tree.patches.size()) return false;
  }
  if (tree.choice != SenderChoice::kBright && tree.choice != SenderChoice::kAll) return false;
  return std::ranges::all_of(tree.reflectors, [&](const Reflector& r) { return r.sender == kNone || r.sender < tree.nodes.size(); });
}

}  // namespace

SenderTree own_sender_tree(std::vector<SenderNode> nodes, std::vector<SenderPatch> patches,
                           std::vector<Reflector> reflectors, SenderChoice choice) {
  const auto arrays = std::make_shared<const Arrays>(Arrays{std::move(nodes), std::move(patches), std::move(reflectors)});
  return {arrays->nodes, arrays->patches, arrays->reflectors, choice, arrays};
}

SenderTree make_sender_tree(const RadiositySolution& solution, SenderChoice choice) {
  if (solution.hierarchy.nodes.empty()) return {};
  const double usual = usual_radiosity(solution);
  const std::vector<Spectrum> by_lines = reflected_by_lines(solution, choice, usual);
  const Sent sent{solution.hierarchy, by_lines};
  Arrays tree;
  std::vector<std::uint32_t> source;  // the solution's node behind each sender
  if (sent.of(0) > 0) source.push_back(0);
  tree.nodes.resize(source.size());
  for (std::size_t i = 0; i < source.size(); ++i) {
    std::uint32_t id = source[i];
    std::vector<std::uint32_t> children = sending_children(sent, id);
    while (solution.hierarchy.nodes[id].is_cluster() && children.size() == 1) {
      id = children[0];
      children = sending_children(sent, id);
    }
    source[i] = id;
    SenderNode node = make_node(solution, sent, id, children.empty(), tree);
    if (!children.empty()) {
      node.first_child = static_cast<std::uint32_t>(tree.nodes.size());
      node.child_count = static_cast<std::uint32_t>(children.size());
    }
    tree.nodes[i] = node;
    source.insert(source.end(), children.begin(), children.end());
    tree.nodes.resize(source.size());
  }
  for (std::size_t i = tree.nodes.size(); i-- > 0;) {
    SenderNode& node = tree.nodes[i];
    node.max_radiosity = node.child_count == 0 ? node.power / node.area : 0;
    for (std::uint32_t c = 0; c < node.child_count; ++c) {
      node.max_radiosity = std::max(node.max_radiosity, tree.nodes[node.first_child + c].max_radiosity);
    }
  }
  tree.reflectors = make_reflectors(solution, by_lines, senders_of_patches(solution.hierarchy, source), choice, usual);
  return own_sender_tree(std::move(tree.nodes), std::move(tree.patches), std::move(tree.reflectors), choice);
}

std::vector<std::byte> encode(const SenderTree& tree) {
  FlatFileWriter file("solution", kVersion);
  file.add("nodes", tree.nodes);
  file.add("patches", tree.patches);
  file.add("reflectors", tree.reflectors);
  file.add_value("choice", tree.choice);
  return file.finish();
}

Result<SenderTree> decode_sender_tree(std::span<const std::byte> bytes) {
  RADFARM_TRY(const FlatFileReader file, FlatFileReader::open(bytes, "solution", kVersion));
  SenderTree tree;
  RADFARM_TRY(tree.nodes, file.get<SenderNode>("nodes"));
  RADFARM_TRY(tree.patches, file.get<SenderPatch>("patches"));
  RADFARM_TRY(tree.reflectors, file.get<Reflector>("reflectors"));
  RADFARM_TRY(tree.choice, file.get_value<SenderChoice>("choice"));
  if (!is_sound(tree)) return fail(Code::kDataLoss, "solution: an index lies outside");
  return tree;
}

SenderSample sample_sender(const SenderTree& tree, std::uint32_t id, float choice, const Vec2& u) {
  // Down the tree by power; what is left of the random number chooses at the next level.
  while (tree.nodes[id].patch == kNone) {
    const SenderNode& node = tree.nodes[id];
    std::uint32_t chosen = node.first_child;
    float left = choice * node.power;
    while (chosen + 1 < node.first_child + node.child_count && left >= tree.nodes[chosen].power) {
      left -= tree.nodes[chosen++].power;
    }
    const float power = tree.nodes[chosen].power;
    choice = power > 0 ? std::clamp(left / power, 0.0F, 0x1.fffffep-1F) : 0;
    id = chosen;
  }
  const SenderPatch& patch = tree.patches[tree.nodes[id].patch];
  const Vec3 b = sample_uniform_triangle(u);
  return {patch.vertices[0] * b.x + patch.vertices[1] * b.y + patch.vertices[2] * b.z, patch.normal, patch.offset,
          tree.nodes[id].patch, b.y, b.z};
}

SenderSample fixed_sample(const SenderTree& tree, std::uint32_t node, std::uint32_t i) {
  constexpr std::uint64_t kFixedKey = 0x6669786564;  // "fixed"
  const std::uint64_t key = combine(kFixedKey, node);
  return sample_sender(tree, node, sobol_owen_1d(i, combine(key, 1)), sobol_owen_2d(i, combine(key, 2)));
}

}  // namespace radfarm
