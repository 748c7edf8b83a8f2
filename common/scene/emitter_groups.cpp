#include "scene/emitter_groups.h"

#include <algorithm>
#include <map>
#include <set>
#include <string_view>

#include "base/utf8.h"

namespace radfarm {
namespace {

constexpr std::size_t kMaxName = 64;  // bytes: EXR allows 255 for a channel

bool is_plain(char c) {
  return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || (c >= '0' && c <= '9') || c == '-' || c == '_';
}

bool is_ascii(char c) { return static_cast<unsigned char>(c) < 0x80; }

/// Dots part layers and channels of EXR, slashes parts of paths. Beyond ASCII stay whole characters, but for control characters.
std::string safe_name(std::string_view name) {
  std::string safe;
  for (const char c : utf8_prefix(name, kMaxName)) safe += is_plain(c) || !is_ascii(c) ? c : '_';
  if (!is_utf8(safe) || has_control_characters(safe)) {
    std::replace_if(safe.begin(), safe.end(), [](char c) { return !is_ascii(c); }, '_');
  }
  return safe;
}

/// Makes group names unique.
class Names {
 public:
  std::string unique(const std::string& wanted) {
    std::string name = wanted;
    for (int n = 2; !taken_.insert(name).second; ++n) name = wanted + "_" + std::to_string(n);
    return name;
  }

 private:
  std::set<std::string> taken_;
};

/// Materials or lights: what each gives, and what it is called.
struct Kind {
  const char* what;
  std::vector<std::string> names;
  std::vector<double> flux;
  std::vector<std::uint8_t> Shining::*shining;
};

void add_groups(const Kind& kind, const Shining& none, Names& names, std::vector<EmitterGroup>& groups) {
  std::map<std::string, std::size_t> group_of;
  int unnamed = 0;
  for (std::size_t i = 0; i < kind.flux.size(); ++i) {
    if (!(kind.flux[i] > 0)) continue;
    const std::string& name = kind.names[i];
    const auto known = name.empty() ? group_of.end() : group_of.find(name);
    const std::size_t group = known != group_of.end() ? known->second : groups.size();
    if (group == groups.size()) {
      const std::string wanted = name.empty() ? kind.what + ("_" + std::to_string(++unnamed)) : safe_name(name);
      groups.push_back({names.unique(wanted), 0, none});
      if (!name.empty()) group_of[name] = group;
    }
    groups[group].flux += kind.flux[i];
    (groups[group].shining.*kind.shining)[i] = 1;
  }
}

Kind materials_of(const World& world) {
  Kind kind{"material", {}, std::vector<double>(world.scene.materials.size()), &Shining::materials};
  for (const Material& material : world.scene.materials) kind.names.push_back(material.name);
  for (std::size_t i = 0; i < world.emitters.triangles.size(); ++i) {
    const std::uint32_t mesh = world.scene.instances[world.emitters.triangles[i].instance].mesh;
    kind.flux[world.scene.meshes[mesh].material] += world.emitters.flux[i];
  }
  return kind;
}

Kind lights_of(const World& world) {
  Kind kind{"light", {}, std::vector<double>(world.scene.lights.size()), &Shining::lights};
  for (const PunctualLight& light : world.scene.lights) kind.names.push_back(light.name);
  for (std::size_t i = 0; i < world.emitters.punctual.size(); ++i) {
    kind.flux[world.emitters.light_of_punctual[i]] = world.emitters.flux[world.emitters.triangles.size() + i];
  }
  return kind;
}

}  // namespace

std::vector<EmitterGroup> emitter_groups(const World& world) {
  const Shining none{std::vector<std::uint8_t>(world.scene.materials.size()),
                     std::vector<std::uint8_t>(world.scene.lights.size()), false};
  std::vector<EmitterGroup> groups;
  Names names;
  // First, so that no material takes it.
  const std::string sky = world.emitters.has_environment ? names.unique("environment") : "";
  add_groups(materials_of(world), none, names, groups);
  add_groups(lights_of(world), none, names, groups);
  if (!world.emitters.has_environment) return groups;
  Shining by_sky = none;
  by_sky.environment = true;
  if (world.emitters.flux.back() > 0) groups.push_back({sky, world.emitters.flux.back(), by_sky});
  return groups;
}

}  // namespace radfarm
