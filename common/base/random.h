#pragma once

#include <bit>
#include <cstdint>

namespace radfarm {

/// Counter-based random numbers: a number is a pure function of what it samples (seed, pixel, vertex, dimension), so any
/// thread or worker that needs it computes the same bits. The mixer is MurmurHash3's 64-bit finaliser (bijective).
constexpr std::uint64_t mix64(std::uint64_t x) {
  x ^= x >> 33;
  x *= 0xff51afd7ed558ccdULL;
  x ^= x >> 33;
  x *= 0xc4ceb9fe1a85ec53ULL;
  x ^= x >> 33;
  return x;
}

/// Folds one more coordinate into a key. Chains: combine(combine(seed, pixel), dimension).
constexpr std::uint64_t combine(std::uint64_t key, std::uint64_t value) {
  return mix64(key * 0x9e3779b97f4a7c15ULL + std::rotl(mix64(value + 0x632be59bd9b4e019ULL), 23));
}

template <typename... Rest>
constexpr std::uint64_t combine(std::uint64_t key, std::uint64_t value, Rest... rest) {
  return combine(combine(key, value), rest...);
}

/// 24 random bits as a float in [0, 1).
constexpr float to_unit_float(std::uint64_t bits) { return static_cast<float>(bits >> 40) * 0x1p-24f; }
/// 53 random bits as a double in [0, 1).
constexpr double to_unit_double(std::uint64_t bits) { return static_cast<double>(bits >> 11) * 0x1p-53; }

/// A sequence of random numbers under one key, for code that draws an unknown number of them in a fixed order.
class RandomSequence {
 public:
  explicit constexpr RandomSequence(std::uint64_t key) : key_(key) {}
  constexpr std::uint64_t bits() { return combine(key_, counter_++); }
  constexpr float uniform() { return to_unit_float(bits()); }
  constexpr double uniform_double() { return to_unit_double(bits()); }

 private:
  std::uint64_t key_;
  std::uint64_t counter_ = 0;
};

}  // namespace radfarm
