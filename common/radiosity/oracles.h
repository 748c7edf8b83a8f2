#pragma once

#include <span>

namespace radfarm {

/// Kullback-Leibler divergence of the kernel samples of a link from a constant kernel: D = (1/N) sum [r ln r - (r - 1)],
/// r_k = F_k / mean F. [Rigau, Feixas and Sbert 2003, eq. 21; cancellation-free form of ALGORITHMS 1.2.4]
///
/// 0 when all samples are equal or all are 0; ln N when one sample holds everything. Every term is >= 0.
double kl_divergence(std::span<const float> samples);

}  // namespace radfarm
