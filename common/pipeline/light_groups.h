#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <string_view>
#include <vector>

#include "base/status.h"
#include "frame/request.h"
#include "scene/emitter_groups.h"

namespace radfarm {

/// The groups of emitters that a request wants layers light.NAME of; none when it asks for none, or where nothing has power.
/// `world`: the one that is rendered, where all shine. RESOURCE_EXHAUSTED above limits::kLightGroups.
Result<std::vector<EmitterGroup>> requested_light_groups(const World& world, const RenderRequest& request);

/// What shines in the view of light group `number`. DATA_LOSS when the scene has no such group under this name.
Result<Shining> shining_of(const World& world, std::size_t number, std::string_view name);

/// The seed of the view of group `number`: the noise of groups is independent. The first keeps the request's.
std::uint64_t seed_of_light_group(std::uint64_t seed, std::size_t number);

/// The solutions of light groups as one file, of kind "groups"; of what a request without groups solves, the file as it is.
[[nodiscard]] std::vector<std::byte> encode_solutions(std::span<const std::vector<std::byte>> solutions);
/// As many of them, in place; hostile bytes give DATA_LOSS.
Result<std::vector<std::span<const std::byte>>> decode_solutions(std::span<const std::byte> bytes, std::size_t count);

}  // namespace radfarm
