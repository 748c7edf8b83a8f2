#pragma once

#include <cstdint>
#include <map>
#include <optional>
#include <string>
#include <variant>
#include <vector>

#include <nlohmann/json_fwd.hpp>

#include "base/status.h"
#include "math/vec.h"
#include "radiosity/oracles.h"
#include "senders/settings.h"

namespace radfarm {

/// What a person asked for, as given: the flags of `radfarm render` that shape the image. prepare() turns it into resolved
/// settings. Its JSON form crosses the network; docs/protocol.md lists the keys.
struct RenderRequest {
  enum class Integrator { kAuto, kRadiosity, kGather, kFullGather, kPathTrace, kPaths, kPhotonMap };
  enum class Quality { kPreview, kStandard, kHigh, kReference };
  enum class UpAxis { kY, kZ };

  struct NamedCamera {
    std::string name_or_index;  // a camera of the scene file; empty: the first, or framed when there is none
    friend bool operator==(const NamedCamera&, const NamedCamera&) = default;
  };
  struct PlacedCamera {
    Vec3d eye, look_at;  // metres, in the scene file's coordinates (after `up`)
    Vec3d up_vector{0, 1, 0};
    double vertical_fov_degrees = 45;
    std::optional<double> orthographic_height;  // metres that the image is high; then there is no field of view
    friend bool operator==(const PlacedCamera&, const PlacedCamera&) = default;
  };

  Integrator integrator = Integrator::kAuto;
  Gather gather = Gather::kDefault;       // the final gather as built here, or as paper 1 has it
  Quality quality = Quality::kStandard;   // as it is by default where there is a target
  std::variant<NamedCamera, PlacedCamera> camera;
  std::optional<int> width, height;       // pixels, 1 to 16384; by default 640 wide at the camera's aspect
  UpAxis up = UpAxis::kY;                 // OBJ only
  std::uint64_t seed = 1;
  int tile = 32;                          // pixels a side; never changes the image
  std::optional<int> samples;             // camera samples a pixel; by default from quality
  std::optional<float> link_error;        // largest share of all light that a link may misplace; by default from quality
  std::optional<float> threshold;         // largest accepted change of radiance, cd/m^2; by default from quality
  Oracle oracle = LinkOracle().criterion;  // what judges the links of the radiosity solve
  std::optional<std::uint64_t> photons;    // light paths of --integrator paths and photon-map; by default from quality
  std::optional<float> radius;            // metres, of their discs; by default by how many paths cross, or photons lie, there
  // Instead of a quality, that settings are chosen for:
  std::optional<double> error;            // relative error that the image is to be below: .02 is 2 %
  std::optional<double> time;             // seconds of wall time
  bool audit = true;
  bool sharing = true;                    // whether like pixels share light, where the integrator lets them (sharing/share_light.h)
  bool mesh = false;                      // radiosity only: draws the edges of the elements; such an image is not audited
  std::string env;                        // "sky:..." (docs/sky.md), or a map beside the scene file; empty: the dark
  std::map<std::string, std::string> ies;  // light or node name -> IES file beside the scene file
  std::optional<float> lens_diameter;     // metres; default: the camera's, which is 0
  std::optional<float> focus_distance;    // metres; default: the camera's, or the distance to --look-at
  std::vector<std::string> aov;           // layers besides light, by name, or "all" (frame/aovs.h)
  std::string effects;                    // "+id,-id": forces effects on or off

  friend bool operator==(const RenderRequest&, const RenderRequest&) = default;
};

/// The least relative error that may be asked for.
inline constexpr double kLeastTargetError = 1e-4;

/// INVALID_ARGUMENT when a value is out of range; the message names the flag and what would be right.
Status validate(const RenderRequest& request);

nlohmann::json to_json(const RenderRequest& request);
/// Unknown keys and wrong types are INVALID_ARGUMENT; missing keys take their defaults.
Result<RenderRequest> render_request_from_json(const nlohmann::json& json);

std::string to_string(RenderRequest::Integrator integrator);                      // "path-trace"
Result<RenderRequest::Integrator> integrator_from_string(std::string_view name);  // lists the names when wrong
std::string to_string(RenderRequest::Quality quality);
Result<RenderRequest::Quality> quality_from_string(std::string_view name);
std::string to_string(Gather gather);                                             // "paper"
Result<Gather> gather_from_string(std::string_view name);
std::string to_string(Oracle oracle);                                             // "KL"
Result<Oracle> oracle_from_string(std::string_view name);

}  // namespace radfarm
