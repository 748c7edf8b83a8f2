#pragma once

#include <cstdint>
#include <vector>

#include "base/progress.h"
#include "radiosity/hierarchy.h"
#include "radiosity/settings.h"

namespace radfarm {

/// Cuts patches over which direct light varies, edges of shadows above all, until no part may misplace more than half of
/// what a link may, `max_link_error` times `flux`.                                        docs/pipeline.md (radiosity.9)
///
/// Links do not see that variation, for direct light goes over none. Where a wall stands on a patch its mean would carry light to
/// the wall's dark side. `direct` is sample_direct()'s; the parts are marked as not sampled. `reflected` grows too, by area.
/// At most kMaxDirectCuts cuts, of those that misplace most. Returns their number. 128 rays a patch that could misplace
/// that much. Deterministic for any thread count.
std::size_t cut_by_direct_light(const World& world, const RadiositySettings& settings, double flux, std::uint64_t seed,
                                Hierarchy& hierarchy, std::vector<Spectrum>& direct, std::vector<Spectrum>& reflected,
                                const Progress& progress = {});

inline constexpr std::size_t kMaxDirectCuts = 60'000;

}  // namespace radfarm
