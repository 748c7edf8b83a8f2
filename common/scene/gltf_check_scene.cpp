#include <algorithm>
#include <vector>

#include "scene/gltf_check.h"
#include "scene/gltf_instancing.h"
#include "scene/limits.h"

namespace radfarm {
namespace {

constexpr NumberRange kUnit{0, 1};
constexpr NumberRange kLight{0, limits::kLight};
constexpr NumberRange kPlace{-limits::kCoordinate, limits::kCoordinate};

void check_texture(JsonChecker& checker, const JsonPlace& root, const JsonPlace& parent, const std::string& key) {
  if (!checker.ok() || !parent.has(key)) return;
  const JsonPlace info = parent.at(key);
  if (!info.value->is_object()) return checker.fault(info.pointer, "must be an object");
  checker.require(info, "index");
  checker.index(info, "index", "texture", count_of(root, "textures"));
  checker.integer(info, "texCoord", 0, 0, 15);
  const JsonPlace transform = info.extension("KHR_texture_transform");
  checker.numbers(transform, "offset", 2, kPlace);
  checker.numbers(transform, "scale", 2, kPlace);
  checker.number(transform, "rotation", kPlace);
  checker.integer(transform, "texCoord", 0, 0, 15);
}

/// The extensions that add lobes to a material.
void check_layers(JsonChecker& checker, const JsonPlace& root, const JsonPlace& material) {
  const JsonPlace specular = material.extension("KHR_materials_specular");
  checker.number(specular, "specularFactor", kUnit);
  checker.numbers(specular, "specularColorFactor", 3, {0, 1e6});
  const JsonPlace transmission = material.extension("KHR_materials_transmission");
  checker.number(transmission, "transmissionFactor", kUnit);
  checker.number(material.extension("KHR_materials_ior"), "ior", {0, 1e6});
  const JsonPlace volume = material.extension("KHR_materials_volume");
  checker.number(volume, "thicknessFactor", {0, limits::kCoordinate});
  checker.numbers(volume, "attenuationColor", 3, kUnit);
  checker.number(volume, "attenuationDistance", {0, 1e300});
  const JsonPlace clearcoat = material.extension("KHR_materials_clearcoat");
  for (const char* key : {"clearcoatFactor", "clearcoatRoughnessFactor"}) checker.number(clearcoat, key, kUnit);
  const JsonPlace sheen = material.extension("KHR_materials_sheen");
  checker.numbers(sheen, "sheenColorFactor", 3, kUnit);
  checker.number(sheen, "sheenRoughnessFactor", kUnit);
  const JsonPlace anisotropy = material.extension("KHR_materials_anisotropy");
  checker.number(anisotropy, "anisotropyStrength", kUnit);
  checker.number(anisotropy, "anisotropyRotation", {-1e6, 1e6});
  for (const char* key : {"specularTexture", "specularColorTexture"}) check_texture(checker, root, specular, key);
  check_texture(checker, root, transmission, "transmissionTexture");
  check_texture(checker, root, clearcoat, "clearcoatTexture");
  check_texture(checker, root, clearcoat, "clearcoatRoughnessTexture");
  for (const char* key : {"sheenColorTexture", "sheenRoughnessTexture"}) check_texture(checker, root, sheen, key);
}

void check_material(JsonChecker& checker, const JsonPlace& root, const JsonPlace& material) {
  if (material.has("pbrMetallicRoughness")) {
    const JsonPlace pbr = material.at("pbrMetallicRoughness");
    checker.numbers(pbr, "baseColorFactor", 4, kUnit);
    checker.number(pbr, "metallicFactor", kUnit);
    checker.number(pbr, "roughnessFactor", kUnit);
    check_texture(checker, root, pbr, "baseColorTexture");
    check_texture(checker, root, pbr, "metallicRoughnessTexture");
  }
  check_texture(checker, root, material, "normalTexture");
  if (material.has("normalTexture")) checker.number(material.at("normalTexture"), "scale", {-1e6, 1e6});
  checker.numbers(material, "emissiveFactor", 3, kLight);
  check_texture(checker, root, material, "emissiveTexture");
  checker.number(material, "alphaCutoff", {0, 1e6});
  checker.string(material, "alphaMode");
  checker.string(material, "name");
  checker.number(material.extension("KHR_materials_emissive_strength"), "emissiveStrength", kLight);
  check_layers(checker, root, material);
  const JsonPlace glossiness = material.extension("KHR_materials_pbrSpecularGlossiness");
  checker.numbers(glossiness, "diffuseFactor", 4, kUnit);
  checker.numbers(glossiness, "specularFactor", 3, kUnit);
  checker.number(glossiness, "glossinessFactor", kUnit);
  check_texture(checker, root, glossiness, "diffuseTexture");
}

void check_textures(JsonChecker& checker, const JsonPlace& root) {
  checker.each_object(root, "samplers", [&](const JsonPlace& sampler) {
    for (const char* key : {"wrapS", "wrapT"}) {
      const std::size_t wrap = checker.integer(sampler, key, 10497, 0, 65535);
      if (wrap == 10497 || wrap == 33648 || wrap == 33071) continue;
      checker.fault(sampler.pointer + "/" + key, std::to_string(wrap) + " is not a wrap mode");
    }
  });
  checker.each_object(root, "textures", [&](const JsonPlace& texture) {
    checker.index(texture, "source", "image", count_of(root, "images"));
    checker.index(texture, "sampler", "sampler", count_of(root, "samplers"));
  });
  checker.each_object(root, "materials", [&](const JsonPlace& place) { check_material(checker, root, place); });
}

void check_camera(JsonChecker& checker, const JsonPlace& camera) {
  checker.require(camera, "type");
  checker.string(camera, "type");
  if (!checker.ok()) return;
  const auto type = camera.value->at("type").get<std::string>();
  checker.require(camera, type);
  if (!checker.ok()) return;
  const JsonPlace lens = camera.at(type);
  if (type == "perspective") {
    checker.require(lens, "yfov");
    checker.require(lens, "znear");
    checker.number(lens, "yfov", {1e-6, 3.1415});
    checker.number(lens, "aspectRatio", {1e-6, 1e6});
  } else if (type == "orthographic") {
    for (const char* key : {"xmag", "ymag"}) {
      checker.require(lens, key);
      checker.number(lens, key, kPlace);
      if (checker.ok() && lens.at(key).value->get<double>() == 0) checker.fault(lens.at(key).pointer, "must not be 0");
    }
    checker.require(lens, "zfar");
    checker.require(lens, "znear");
  } else {
    checker.fault(camera.pointer + "/type", "must be 'perspective' or 'orthographic'");
  }
}

void check_light(JsonChecker& checker, const JsonPlace& light) {
  checker.require(light, "type");
  checker.string(light, "type");
  checker.numbers(light, "color", 3, kLight);
  checker.number(light, "intensity", kLight);
  if (!checker.ok()) return;
  const auto type = light.value->at("type").get<std::string>();
  if (type == "point" || type == "directional") return;
  if (type != "spot") return checker.fault(light.pointer + "/type", "must be 'point', 'spot' or 'directional'");
  checker.require(light, "spot");
  if (!checker.ok()) return;
  const JsonPlace spot = light.at("spot");
  constexpr double kHalfPi = 1.5707964;
  checker.number(spot, "innerConeAngle", {0, kHalfPi});
  checker.number(spot, "outerConeAngle", {0, kHalfPi});
  if (!checker.ok()) return;
  const double inner = spot.has("innerConeAngle") ? spot.at("innerConeAngle").value->get<double>() : 0;
  const double outer = spot.has("outerConeAngle") ? spot.at("outerConeAngle").value->get<double>() : kHalfPi / 2;
  if (inner >= outer) checker.fault(spot.pointer, "innerConeAngle must be smaller than outerConeAngle");
}

void check_node(JsonChecker& checker, const JsonPlace& root, std::size_t lights, const JsonPlace& node) {
  checker.index(node, "mesh", "mesh", count_of(root, "meshes"));
  checker.index(node, "camera", "camera", count_of(root, "cameras"));
  checker.index(node, "skin", "skin", count_of(root, "skins"));
  checker.indices(node, "children", "node", count_of(root, "nodes"));
  checker.numbers(node, "matrix", 16, kPlace);
  checker.numbers(node, "translation", 3, kPlace);
  checker.numbers(node, "rotation", 4, kPlace);
  checker.numbers(node, "scale", 3, kPlace);
  check_gltf_instancing(checker, root, node);
  checker.index(node.extension("KHR_lights_punctual"), "light", "light", lights);
  checker.string(node, "name");
  if (!checker.ok() || !node.has("matrix")) return;
  const nlohmann::json& matrix = *node.at("matrix").value;
  if (matrix[3] != 0 || matrix[7] != 0 || matrix[11] != 0 || matrix[15] != 1) {
    checker.fault(node.pointer + "/matrix", "is not affine: elements 3, 7, 11, 15 must be 0, 0, 0, 1");
  }
}

/// Every node has at most one parent, and no chain of children is too deep or closes on itself.
void check_trees(JsonChecker& checker, const JsonPlace& root) {
  if (!checker.ok() || !root.has("nodes")) return;
  const JsonPlace nodes = root.at("nodes");
  const std::size_t count = nodes.value->size();
  constexpr std::size_t kNoParent = static_cast<std::size_t>(-1);
  std::vector<std::size_t> parent(count, kNoParent);
  for (std::size_t i = 0; i < count; ++i) {
    if (!nodes.at(i).has("children")) continue;
    const JsonPlace children = nodes.at(i).at("children");
    for (std::size_t k = 0; k < children.value->size(); ++k) {
      std::size_t& slot = parent[(*children.value)[k].get<std::size_t>()];
      if (slot != kNoParent) return checker.fault(children.at(k).pointer, "node has a second parent");
      slot = i;
    }
  }
  // Depths by walking up until a node of known depth; a walk longer than the limit is a cycle or too deep.
  std::vector<std::size_t> depth(count, 0);
  std::vector<std::size_t> chain;
  for (std::size_t i = 0; i < count; ++i) {
    chain.clear();
    std::size_t at = i;
    while (at != kNoParent && depth[at] == 0 && chain.size() <= count) {
      chain.push_back(at);
      at = parent[at];
    }
    if (chain.size() > count) return checker.fault(nodes.at(i).pointer, "node is its own ancestor");
    std::size_t above = at == kNoParent ? 0 : depth[at];
    for (auto it = chain.rbegin(); it != chain.rend(); ++it) depth[*it] = ++above;
    if (above > limits::kNodeDepth) {
      return checker.fault(nodes.at(i).pointer, "node lies deeper than " + std::to_string(limits::kNodeDepth),
                           Code::kResourceExhausted);
    }
  }
  checker.each_object(root, "scenes", [&](const JsonPlace& scene) {
    if (!scene.has("nodes")) return;
    const JsonPlace roots = scene.at("nodes");
    for (std::size_t k = 0; k < roots.value->size(); ++k) {
      if (parent[(*roots.value)[k].get<std::size_t>()] != kNoParent) {
        return checker.fault(roots.at(k).pointer, "node is a child of another, not a root");
      }
    }
  });
}

void check_motion(JsonChecker& checker, const JsonPlace& root) {
  checker.each_object(root, "skins", [&](const JsonPlace& skin) {
    checker.indices(skin, "joints", "node", count_of(root, "nodes"));
    checker.index(skin, "skeleton", "node", count_of(root, "nodes"));
    checker.index(skin, "inverseBindMatrices", "accessor", count_of(root, "accessors"));
  });
  checker.each_object(root, "animations", [&](const JsonPlace& animation) {
    checker.each_object(animation, "samplers", [&](const JsonPlace& sampler) {
      checker.require(sampler, "input");
      checker.require(sampler, "output");
      checker.index(sampler, "input", "accessor", count_of(root, "accessors"));
      checker.index(sampler, "output", "accessor", count_of(root, "accessors"));
    });
    checker.each_object(animation, "channels", [&](const JsonPlace& channel) {
      checker.require(channel, "sampler");
      checker.require(channel, "target");
      if (!checker.ok()) return;
      checker.index(channel, "sampler", "sampler", count_of(animation, "samplers"));
      checker.index(channel.at("target"), "node", "node", count_of(root, "nodes"));
    });
  });
}

}  // namespace

void check_gltf_scene(JsonChecker& checker, const JsonPlace& root) {
  check_textures(checker, root);
  checker.each_object(root, "cameras", [&](const JsonPlace& place) { check_camera(checker, place); });
  const JsonPlace punctual = root.extension("KHR_lights_punctual");
  checker.each_object(punctual, "lights", [&](const JsonPlace& place) { check_light(checker, place); });
  const std::size_t lights = count_of(punctual, "lights");
  checker.each_object(root, "nodes", [&](const JsonPlace& place) { check_node(checker, root, lights, place); });
  checker.each_object(root, "scenes", [&](const JsonPlace& scene) {
    checker.indices(scene, "nodes", "node", count_of(root, "nodes"));
  });
  if (count_of(root, "scenes") > 0 || root.has("scene")) {
    checker.index(root, "scene", "scene", count_of(root, "scenes"));
  }
  check_trees(checker, root);
  check_motion(checker, root);
}

}  // namespace radfarm
