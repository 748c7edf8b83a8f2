#include "senders/sender_tree.h"

#include <algorithm>

#include "base/flat_file.h"
#include "math/sampling.h"

namespace radfarm {
namespace {

constexpr std::uint32_t kVersion = 2;

float sent(const RadiositySolution& solution, std::uint32_t node) {
  return luminance(solution.hierarchy.nodes[node].emitted_power) + luminance(solution.reflected_power[node]);
}

/// A tree that grows.
struct Arrays {
  std::vector<SenderNode> nodes;
  std::vector<SenderPatch> patches;
};

SenderNode make_node(const RadiositySolution& solution, std::uint32_t id, bool is_leaf, Arrays& tree) {
  const Node& node = solution.hierarchy.nodes[id];
  SenderNode sender;
  sender.bounds = node.bounds;
  sender.cone_axis = node.cone_axis;
  sender.cone_cosine = node.cone_cosine;
  sender.area = node.area;
  sender.emitted_power = node.emitted_power;
  sender.reflected_power = solution.reflected_power[id];
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
std::vector<std::uint32_t> sending_children(const RadiositySolution& solution, std::uint32_t id) {
  std::vector<std::uint32_t> children;
  const Node& node = solution.hierarchy.nodes[id];
  if (!node.is_cluster() && is_black(solution.reflected_power[id])) return children;
  for (std::uint32_t i = 0; i < node.child_count; ++i) {
    if (sent(solution, node.first_child + i) > 0) children.push_back(node.first_child + i);
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
  return true;
}

}  // namespace

SenderTree own_sender_tree(std::vector<SenderNode> nodes, std::vector<SenderPatch> patches) {
  const auto arrays = std::make_shared<const Arrays>(Arrays{std::move(nodes), std::move(patches)});
  return {arrays->nodes, arrays->patches, arrays};
}

SenderTree make_sender_tree(const RadiositySolution& solution) {
  if (solution.hierarchy.nodes.empty() || !(sent(solution, 0) > 0)) return {};
  Arrays tree;
  std::vector<std::uint32_t> source = {0};  // the solution's node behind each sender
  tree.nodes.push_back({});
  for (std::size_t i = 0; i < source.size(); ++i) {
    std::uint32_t id = source[i];
    std::vector<std::uint32_t> children = sending_children(solution, id);
    while (solution.hierarchy.nodes[id].is_cluster() && children.size() == 1) {
      id = children[0];
      children = sending_children(solution, id);
    }
    SenderNode node = make_node(solution, id, children.empty(), tree);
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
  return own_sender_tree(std::move(tree.nodes), std::move(tree.patches));
}

std::vector<std::byte> encode(const SenderTree& tree) {
  FlatFileWriter file("solution", kVersion);
  file.add("nodes", tree.nodes);
  file.add("patches", tree.patches);
  return file.finish();
}

Result<SenderTree> decode_sender_tree(std::span<const std::byte> bytes) {
  RADFARM_TRY(const FlatFileReader file, FlatFileReader::open(bytes, "solution", kVersion));
  SenderTree tree;
  RADFARM_TRY(tree.nodes, file.get<SenderNode>("nodes"));
  RADFARM_TRY(tree.patches, file.get<SenderPatch>("patches"));
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

}  // namespace radfarm
