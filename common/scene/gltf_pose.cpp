#include <string>
#include <vector>

#include "scene/gltf_accessor.h"
#include "scene/gltf_nodes.h"

namespace radfarm {
namespace {

/// The node's property that an animation path moves, and how many numbers it has; nullptr for weights and pointers.
std::vector<double>* animated_property(tinygltf::Node& node, const std::string& path, std::size_t& size) {
  size = path == "rotation" ? 4 : 3;
  if (path == "translation") return &node.translation;
  if (path == "rotation") return &node.rotation;
  return path == "scale" ? &node.scale : nullptr;
}

}  // namespace

void pose_at_start(GltfModel& model, Scene& scene) {
  if (model.document.animations.empty()) return;
  const tinygltf::Animation animation = model.document.animations.front();
  add_note(scene, "The scene is animated; its nodes stand where its first animation has them at t = 0.");
  for (const tinygltf::AnimationChannel& channel : animation.channels) {
    if (channel.target_node < 0) continue;
    tinygltf::Node& node = model.document.nodes[static_cast<std::size_t>(channel.target_node)];
    const tinygltf::AnimationSampler& sampler = animation.samplers[static_cast<std::size_t>(channel.sampler)];
    std::size_t size = 0;
    std::vector<double>* property = animated_property(node, channel.target_path, size);
    const auto values = read_floats(model, sampler.output, size);
    // The first key holds until its time; a cubic key is (in-tangent, value, out-tangent).
    const std::size_t first = sampler.interpolation == "CUBICSPLINE" ? size : 0;
    if (property == nullptr || !values || values->size() < first + size || node.matrix.size() == 16) {
      add_note(scene, "Animation channels other than well-formed node transforms are ignored.");
      continue;
    }
    const auto begin = values->begin() + static_cast<std::ptrdiff_t>(first);
    property->assign(begin, begin + static_cast<std::ptrdiff_t>(size));
  }
}

}  // namespace radfarm
