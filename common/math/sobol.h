#pragma once

#include <cstdint>

#include "base/random.h"
#include "math/vec.h"

namespace radfarm {

/// Points of the Sobol (0,2)-sequence under Owen scrambling, a pure function of index and key: the first 2^m points of a
/// key, and every later aligned block of 2^m, have one point in each dyadic box of area 2^-m. Different keys (one per
/// pixel, vertex, dimension pair) give independent scramblings of shuffled sequences, so pairs of dimensions are padded by
/// combine(key, dimension). Every point alone is uniform over the keys: any prefix's mean is unbiased.
/// [Burley 2020, Practical Hash-based Owen Scrambling; Laine and Karras 2011; Ahmed 2024 for the matrix product]
namespace sobol_detail {

constexpr std::uint32_t reverse_bits(std::uint32_t v) {
  v = __builtin_bswap32(v);
  v = ((v & 0x0f0f0f0fU) << 4) | ((v >> 4) & 0x0f0f0f0fU);
  v = ((v & 0x33333333U) << 2) | ((v >> 2) & 0x33333333U);
  return ((v & 0x55555555U) << 1) | ((v >> 1) & 0x55555555U);
}

/// A permutation in which each bit's flip depends only on the bits below it: an Owen permutation of reversed bits. A
/// uniform low half of `seed` makes the image of any one value exactly uniform. Constants of pbrt-v4's FastOwenScrambler.
constexpr std::uint32_t laine_karras(std::uint32_t v, std::uint64_t seed) {
  v ^= v * 0x3d20adeaU;
  v += static_cast<std::uint32_t>(seed);
  v *= static_cast<std::uint32_t>(seed >> 32) | 1U;
  v ^= v * 0x05526c56U;
  v ^= v * 0x53a22864U;
  return v;
}

/// The second Sobol matrix (Pascal's triangle mod 2) times the index, bits reversed: bit j is the parity of the bits k of
/// `index` whose binary digits contain those of j.
constexpr std::uint32_t second_dimension_reversed(std::uint32_t index) {
  index ^= index >> 16;
  index ^= (index >> 8) & 0x00ff00ffU;
  index ^= (index >> 4) & 0x0f0f0f0fU;
  index ^= (index >> 2) & 0x33333333U;
  return index ^ ((index >> 1) & 0x55555555U);
}

constexpr float to_unit_float32(std::uint32_t bits) { return static_cast<float>(bits >> 8) * 0x1p-24f; }

constexpr std::uint32_t shuffled_index(std::uint32_t index, std::uint64_t key) {
  return reverse_bits(laine_karras(reverse_bits(index), mix64(key ^ 0x9e3779b97f4a7c15ULL)));
}

/// `reversed` is a coordinate's bits, lowest first; scrambles it and returns it in [0, 1).
constexpr float scrambled(std::uint32_t reversed, std::uint64_t seed) {
  return to_unit_float32(reverse_bits(laine_karras(reversed, seed)));
}

}  // namespace sobol_detail

/// Sample `index` of the one-dimensional sequence of `key`, in [0, 1): the first coordinate of sobol_owen_2d.
constexpr float sobol_owen_1d(std::uint32_t index, std::uint64_t key) {
  // The first coordinate is the index with its bits reversed, so the reversed coordinate is the index itself.
  return sobol_detail::scrambled(sobol_detail::shuffled_index(index, key), mix64(key ^ 0xd1b54a32d192ed03ULL));
}

/// Sample `index` of the two-dimensional sequence of `key`, in [0, 1)^2.
inline Vec2 sobol_owen_2d(std::uint32_t index, std::uint64_t key) {
  const std::uint32_t shuffled = sobol_detail::shuffled_index(index, key);
  return {sobol_detail::scrambled(shuffled, mix64(key ^ 0xd1b54a32d192ed03ULL)),
          sobol_detail::scrambled(sobol_detail::second_dimension_reversed(shuffled), mix64(key ^ 0x8cb92ba72f3d8dd7ULL))};
}

}  // namespace radfarm
