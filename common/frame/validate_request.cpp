#include <cmath>
#include <cstdint>
#include <string>
#include <utility>
#include <variant>

#include "frame/aovs.h"
#include "frame/request.h"

namespace radfarm {
namespace {

using Integrator = RenderRequest::Integrator;
using NamedCamera = RenderRequest::NamedCamera;
using PlacedCamera = RenderRequest::PlacedCamera;

constexpr int kMaxSide = 16384;
constexpr int kMaxTile = 1024;
constexpr int kMaxSamples = 1 << 20;
constexpr std::uint64_t kMaxPhotons = std::uint64_t{1} << 40;
constexpr std::size_t kMaxIes = 1000;
constexpr double kMostSeconds = 30 * 86400.0;
constexpr std::size_t kMaxText = 1024;  // bytes of a camera's name or an effects list

tl::unexpected<Error> invalid(std::string message) { return fail(Code::kInvalidArgument, std::move(message)); }

Status check_range(std::string_view flag, const std::optional<int>& value, int least, int most) {
  if (!value || (*value >= least && *value <= most)) return {};
  return invalid(std::string(flag) + " is " + std::to_string(*value) + ", must be from " + std::to_string(least) +
                 " to " + std::to_string(most));
}

bool finite(const Vec3d& v) { return std::isfinite(v.x) && std::isfinite(v.y) && std::isfinite(v.z); }

Status check_camera(const PlacedCamera& camera) {
  if (!finite(camera.eye) || !finite(camera.look_at))
    return invalid("--eye and --look-at: every number must be finite");
  if (!finite(camera.up_vector) || length(camera.up_vector) == 0) {
    return invalid("--up-vector: must be finite and not zero");
  }
  const Vec3d view = camera.look_at - camera.eye;
  if (length(view) == 0) return invalid("--look-at is the same point as --eye");
  if (length(cross(normalize(view), normalize(camera.up_vector))) < 1e-9) {
    return invalid("--up-vector is along the view from --eye to --look-at, must lie across it");
  }
  // Written so that NaN fails.
  if (!(camera.vertical_fov_degrees > 0 && camera.vertical_fov_degrees < 180)) {
    return invalid("--fov is " + std::to_string(camera.vertical_fov_degrees) + " degrees, must be between 0 and 180");
  }
  if (camera.orthographic_height && !(*camera.orthographic_height > 0 && std::isfinite(*camera.orthographic_height))) {
    return invalid("--orthographic is " + std::to_string(*camera.orthographic_height) +
                   " m, must be positive and finite");
  }
  return {};
}

Status check_camera(const NamedCamera& camera) {
  if (camera.name_or_index.size() <= kMaxText) return {};
  return invalid("--camera: name is longer than " + std::to_string(kMaxText) + " bytes");
}

/// "+id,-id,...", ids of lower-case letters, digits, '-' and '_'. Which ids exist is plan_effects' business.
Status check_effects(std::string_view effects) {
  if (effects.empty()) return {};
  const Error wrong{Code::kInvalidArgument, "--effects: '" + std::string(effects.substr(0, 80)) +
                                                "' must be ids with a sign, such as +textures,-masking"};
  if (effects.size() > kMaxText) return tl::unexpected(wrong);
  bool at_start = true;
  std::size_t id_length = 1;
  for (const char c : effects) {
    const bool letter = (c >= 'a' && c <= 'z') || (c >= '0' && c <= '9') || c == '_' || c == '-' || c == '.';
    if (at_start ? (c != '+' && c != '-') : (!letter && c != ',')) return tl::unexpected(wrong);
    if (c == ',' && id_length == 0) return tl::unexpected(wrong);
    id_length = at_start ? 0 : id_length + 1;
    at_start = !at_start && c == ',';
  }
  if (at_start || id_length == 0) return tl::unexpected(wrong);
  return {};
}

bool has_photons(const RenderRequest& request) {
  return request.integrator == Integrator::kPaths || request.integrator == Integrator::kPhotonMap;
}

Status check_photons(const RenderRequest& request) {
  const bool has_paths = request.integrator != Integrator::kPathTrace && request.integrator != Integrator::kRadiosity;
  if ((request.photons || request.radius) && !has_paths) {
    return invalid("--photons and --radius are of photon paths: they need --integrator auto, gather, full-gather, paths or photon-map");
  }
  if (request.photons && !(*request.photons >= 1 && *request.photons <= kMaxPhotons)) {
    return invalid("--photons is " + std::to_string(*request.photons) + ", must be between 1 and " +
                   std::to_string(kMaxPhotons));
  }
  if (request.radius && !(*request.radius > 0 && *request.radius <= 1e6F)) {
    return invalid("--radius is " + std::to_string(*request.radius) + " m, must be positive");
  }
  return {};
}

Status check_target(const RenderRequest& request) {
  if (request.error && request.time) return invalid("--error and --time exclude each other");
  if (request.error && !(*request.error >= kLeastTargetError && *request.error <= 1)) {
    return invalid("--error is " + std::to_string(100 * *request.error) + " %, must be from .01 % to 100 %");
  }
  if (request.time && !(*request.time >= 1 && *request.time <= kMostSeconds)) {
    return invalid("--time is " + std::to_string(*request.time) + " s, must be from 1 s to 30 days");
  }
  if (!request.error && !request.time) return {};
  const std::string flag = request.error ? "--error" : "--time";
  if (!request.audit) return invalid(flag + " needs the audit, not --no-audit");
  if (request.mesh) return invalid(flag + ": an image with --mesh is not audited");
  return {};
}

}  // namespace

Status validate(const RenderRequest& request) {
  RADFARM_TRY_STATUS(std::visit([](const auto& camera) { return check_camera(camera); }, request.camera));
  RADFARM_TRY_STATUS(check_range("--size: width", request.width, 1, kMaxSide));
  RADFARM_TRY_STATUS(check_range("--size: height", request.height, 1, kMaxSide));
  RADFARM_TRY_STATUS(check_range("--tile", request.tile, 1, kMaxTile));
  RADFARM_TRY_STATUS(check_range("--samples", request.samples, 1, kMaxSamples));
  if (request.link_error && !(*request.link_error > 0 && *request.link_error <= 1)) {
    return invalid("--link-error is " + std::to_string(*request.link_error) + ", must be a share in (0, 1]");
  }
  if (request.threshold && !(*request.threshold > 0 && std::isfinite(*request.threshold))) {
    return invalid("--threshold is " + std::to_string(*request.threshold) + ", must be positive and finite, in cd/m^2");
  }
  if (request.lens_diameter && !(*request.lens_diameter >= 0 && *request.lens_diameter <= 1e6F)) {
    return invalid("--lens-diameter is " + std::to_string(*request.lens_diameter) + " m, must not be negative");
  }
  if (request.focus_distance && !(*request.focus_distance > 0 && *request.focus_distance <= 1e18F)) {
    return invalid("--focus-distance is " + std::to_string(*request.focus_distance) +
                   " m, must be positive and finite");
  }
  RADFARM_TRY_STATUS(check_photons(request));
  RADFARM_TRY_STATUS(check_target(request));
  const bool is_gather = request.integrator != Integrator::kPathTrace && request.integrator != Integrator::kRadiosity &&
                         !has_photons(request);
  if (request.gather == Gather::kPaper && !is_gather) {
    return invalid("--gather paper is a way to gather: it needs --integrator auto, gather or full-gather");
  }
  if (request.mesh && request.integrator != Integrator::kRadiosity) {
    return invalid("--mesh draws the elements of the radiosity solution: it needs --integrator radiosity");
  }
  if (request.env.size() > kMaxText) return invalid("--env: is longer than " + std::to_string(kMaxText) + " bytes");
  if (request.ies.size() > kMaxIes) return invalid("--ies: more than " + std::to_string(kMaxIes) + " files");
  RADFARM_TRY([[maybe_unused]] const AovSet aovs, requested_aovs(request));
  return check_effects(request.effects);
}

}  // namespace radfarm
