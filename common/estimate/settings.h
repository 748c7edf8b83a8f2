#pragma once

#include <cstdint>

#include "estimate/aov.h"
#include "radiosity/settings.h"
#include "senders/settings.h"

namespace radfarm {

/// Everything that decides an image's bits besides scene and camera: what --quality and the flags resolve to. Recorded in
/// the report and in the image's header, so that a render can be replayed exactly. Stored as it is; no padding.
struct Settings {
  enum class Integrator : std::uint32_t { kGather = 0, kPathTrace = 1, kRadiosity = 2, kPaths = 3, kPhotonMap = 4 };
  Integrator integrator = Integrator::kGather;
  std::int32_t width = 0;
  std::int32_t height = 0;
  std::int32_t tile = 32;                // pixels a side; decides the cutting, never the image
  std::uint64_t seed = 1;
  std::uint64_t photons = 0;             // light paths, in `photon_batches`; 0: none
  AovSet aovs = 0;                       // written besides the light; never change it
  std::uint32_t camera_samples = 16;     // a pixel, at first
  std::uint32_t max_camera_samples = 16; // a pixel; at least camera_samples
  float noise = 0;                       // cd/m^2: a pixel whose samples scatter by s gets s / noise; 0: all get camera_samples
  std::uint32_t audit_pixels = 0;        // 0: no audit
  std::uint32_t audit_samples = 0;       // paths of each of the two estimates of an audited pixel
  std::uint32_t effects_off = 0;         // EffectSet: the image is rendered without these ...
  std::uint32_t exactly_off = 0;         // ... of which these change no image: the audit leaves them out too
  std::uint16_t draws_mesh = 0;          // 1: lines over the edges of the elements (radiosity)
  std::uint16_t shares_light = 0;        // 1: like pixels share direct and indirect light (sharing/share_light.h)
  std::uint32_t photon_batches = 0;
  std::uint32_t photon_origins = 0;      // OriginSet: the light that they bring
  float photon_radius = 0;               // m, of all discs; 0: each as wide as brings it `photon_crossings` (photons, of a map)
  float photon_crossings = 0;
  float level = 1;                       // of all that --quality chooses: 0 preview, 1 standard, 2 high, 3 reference, or between
  float target_error = 0;                // relative, that they were chosen for; 0: none
  RadiositySettings radiosity;
  SenderSettings senders;

  /// Whether photon tasks bring the light of diffuse surfaces.
  static constexpr bool is_by_photons(Integrator i) { return i == Integrator::kPaths || i == Integrator::kPhotonMap; }
  bool is_by_photons() const { return is_by_photons(integrator); }
};
static_assert(sizeof(Settings) == 92 + sizeof(RadiositySettings) + sizeof(SenderSettings), "Settings has padding");

}  // namespace radfarm
