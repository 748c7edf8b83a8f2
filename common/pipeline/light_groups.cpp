#include "pipeline/light_groups.h"

#include <string>

#include "base/flat_file.h"
#include "base/random.h"
#include "frame/aovs.h"
#include "scene/limits.h"

namespace radfarm {
namespace {

constexpr std::uint32_t kVersion = 1;
constexpr std::uint64_t kGroupKey = 0x6c69676874;  // "light"

}  // namespace

Result<std::vector<EmitterGroup>> requested_light_groups(const World& world, const RenderRequest& request) {
  if (!wants_light_groups(request)) return std::vector<EmitterGroup>();
  std::vector<EmitterGroup> groups = emitter_groups(world);
  if (groups.size() <= limits::kLightGroups) return groups;
  return fail(Code::kResourceExhausted,
              "--aov light: the scene has " + std::to_string(groups.size()) + " light groups, at most " +
                  std::to_string(limits::kLightGroups) +
                  " are rendered: give luminaires that are dimmed together one material, or one name of their lights");
}

Result<Shining> shining_of(const World& world, std::size_t number, std::string_view name) {
  std::vector<EmitterGroup> groups = emitter_groups(world);
  if (number < groups.size() && groups[number].name == name) return std::move(groups[number].shining);
  return fail(Code::kDataLoss, "view: the scene has no light group " + std::to_string(number) + " of its name");
}

std::uint64_t seed_of_light_group(std::uint64_t seed, std::size_t number) {
  return number == 0 ? seed : combine(seed, kGroupKey, number);
}

std::vector<std::byte> encode_solutions(std::span<const std::vector<std::byte>> solutions) {
  if (solutions.size() == 1) return solutions[0];
  FlatFileWriter file("groups", kVersion);
  for (std::size_t i = 0; i < solutions.size(); ++i) file.add(std::to_string(i), solutions[i]);
  return file.finish();
}

Result<std::vector<std::span<const std::byte>>> decode_solutions(std::span<const std::byte> bytes, std::size_t count) {
  if (count == 1) return std::vector{bytes};
  RADFARM_TRY(const FlatFileReader file, FlatFileReader::open(bytes, "groups", kVersion));
  std::vector<std::span<const std::byte>> solutions;
  for (std::size_t i = 0; i < count; ++i) {
    RADFARM_TRY(const std::span<const std::byte> one, file.get<std::byte>(std::to_string(i)));
    solutions.push_back(one);
  }
  return solutions;
}

}  // namespace radfarm
