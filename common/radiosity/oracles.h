#pragma once

#include <cstdint>
#include <span>

namespace radfarm {

/// What judges by a few random lines whether one number may stand for the kernel between two elements: kernel smoothness,
/// Kullback-Leibler, chi-square and Hellinger divergence, variance.    docs/pipeline.md (radiosity.4) [Rigau et al. 2003]
enum class Oracle : std::uint16_t { kKs, kKl, kCs, kHe, kVar };

/// kPower: the kernel that a constant one misplaces, 1/m^2, by formulas without cancellation. kLiteral: the paper's.
enum class OracleForm : std::uint16_t { kPower, kLiteral };

struct LinkOracle {
  Oracle criterion = Oracle::kKl;
  OracleForm form = OracleForm::kPower;
  friend bool operator==(const LinkOracle&, const LinkOracle&) = default;
};

// Divergences of samples F_k >= 0 from a constant, with r_k = F_k / mean F. Without dimension; every term is >= 0, so that none
// loses digits near a constant. 0 where all samples are equal, all are 0 or there are none. A sample that is negative or not
// finite counts as 0. O(N).

/// D = (1/N) sum [r ln r - (r - 1)], in [0, ln N].                       [eq. 16; ALGORITHMS 1.2.4]
double kl_divergence(std::span<const float> samples);
/// chi^2 = (1/N) sum (r - 1)^2, in [0, N - 1]: the squared coefficient of variation.          [eq. 17]
double chi_square_divergence(std::span<const float> samples);
/// h^2 = (1/2N) sum (sqrt r - 1)^2, in [0, 1 - 1/sqrt N].                                     [eq. 18]
double hellinger_divergence(std::span<const float> samples);

/// Kernel that a constant misplaces, in the samples' unit (1/m^2; of sources lux), for all oracles, so that times
/// rho A_receiver P_sender it is power and one threshold fits them:
///
///     KL  mean D      CS  mean chi^2 / 2      HE  4 mean h^2      VAR  mean chi = sigma      KS  max(mean - min, max - mean)
///
/// The first three agree to second order near a constant, where each is sigma^2 / (2 mean). KS and VAR are of first order: the
/// largest deviation and the rms one. The share of a link's light that goes astray, (1/2N) sum |r - 1|, is at most sqrt(D / 2),
/// chi / 2 and sqrt(2) h (Pinsker's inequality and its like).
double misplaced_kernel(Oracle oracle, std::span<const float> samples);

/// The paper's formulas as printed (eq. 3, 21 to 24) over rho A_receiver P_sender: of KL, CS and HE N times the kernel above
/// but for factors 1, 2 and 1/4; KS is irradiance (lux) and VAR squared kernel, so their thresholds have other units.
/// Requires: receiver_area > 0, m^2.
double literal_kernel(Oracle oracle, std::span<const float> samples, double receiver_area);

}  // namespace radfarm
