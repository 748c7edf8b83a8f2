#pragma once

#include <cstdint>
#include <vector>

#include "base/progress.h"
#include "radiosity/refine.h"

namespace radfarm {

/// Where the light went, lm (luminance). emitted = absorbed + escaped + truncated, up to rounding.
struct EnergyLedger {
  double emitted = 0;        // by emitters; where no light paths went, also what specular surfaces send, where it lands
  double absorbed = 0;
  double escaped = 0;        // left the scene
  double truncated = 0;      // not yet reflected when the solve stopped
  double closure_error = 0;  // share of the light that stays which the links missed before normalisation; signed
};

/// Diffuse interreflection of a scene, independent of any camera.
struct RadiositySolution {
  Hierarchy hierarchy;
  std::vector<Spectrum> reflected_power;   // lm, one a node: rho E A summed over its patches
  std::vector<Spectrum> reflected_direct;  // of it, what patches reflect of light straight from emitters; empty: none
  std::vector<Spectrum> specular;          // E_spec, lux, one a node: coarse (specular_irradiance()); empty: none
  EnergyLedger energy;
  std::size_t links = 0;
  std::size_t passes = 0;
  std::size_t iterations = 0;
};

/// Hierarchical radiosity with clustering, put right by light paths.     docs/pipeline.md (radiosity.1) to (radiosity.7)
///
/// Solves B = pi L_e + rho (E + E_spec), E the irradiance gathered over links, E_spec what specular surfaces send whose gloss is
/// not folded into diffuse: refine with the light known so far,
/// gather and pull until
/// an iteration changes the reflected power by less than `residual`, and again with the new light until nothing is split.
/// Factors are scaled so that all light arrives but the share that probe rays see escape, and no patch sends more than it
/// has, so that the iteration converges whenever rho < 1; the raw error is in the ledger. (radiosity.6)
/// Cost: links x samples_per_link rays, then O(links + leaves x depth) an iteration. Deterministic for any thread count.
RadiositySolution solve_radiosity(const World& world, const RadiositySettings& settings, std::uint64_t seed,
                                  const Progress& progress = {});

}  // namespace radfarm
