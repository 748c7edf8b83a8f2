#pragma once

#include <cstdint>
#include <vector>

#include "base/progress.h"
#include "radiosity/solve.h"

namespace radfarm {

/// Light that arrives at a surface, lux: from emitters, and from what reflects, mirrors and glass too.
struct Irradiance {
  Spectrum direct;
  Spectrum indirect;
  Spectrum total() const { return direct + indirect; }
};

/// Rays a patch with which a solution is shown: its vertices, of about six patches each, then know their irradiance to a few
/// percent of noise in a lit room.
inline constexpr std::uint32_t kGatherRays = 64;

/// The irradiance of each undivided patch by one more gather over the solution (a local pass).     docs/pipeline.md (mesh.1)
///
/// The solve keeps what patches reflect, with the noise of the few light paths that met each; that says nothing of a patch
/// that reflects nothing. Here each patch looks at the others instead: `rays` cosine-distributed rays from points spread over
/// it bring the radiosity of the patches that they meet, whose errors average out, and emitters give direct light by
/// sample_direct(), `rays` / 16 rounds. One value a node, zero where a node has parts. Unbiased but for the solution's own error.
/// Cost: 1.5 us for each of `rays` and patch. Deterministic for any thread count. Requires: rays >= 16.
std::vector<Irradiance> gather_irradiance(const World& world, const RadiositySolution& solution, std::uint32_t rays,
                                          std::uint64_t seed, const Progress& progress = {});

}  // namespace radfarm
