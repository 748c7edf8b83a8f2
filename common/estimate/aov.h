#pragma once

#include <cstddef>
#include <cstdint>

namespace radfarm {

/// What an image may tell besides light, on request: arbitrary output variables. Units and meaning: docs/formats.md.
enum class Aov : std::uint32_t {
  kAlbedo,
  kNormal,
  kDepth,
  kIrradiance,
  kCameraSamples,
  kVisibilitySamples,
  kFormFactorSamples,
  kVariance,
  kClassification,
  kGrid,
  kMasking,
};
inline constexpr std::size_t kAovCount = 11;

/// Bit k: the Aov of value k. Stored in the settings of a view.
using AovSet = std::uint32_t;

constexpr AovSet set_of(Aov aov) { return AovSet{1} << static_cast<std::uint32_t>(aov); }
constexpr bool contains(AovSet set, Aov aov) { return (set & set_of(aov)) != 0; }

}  // namespace radfarm
