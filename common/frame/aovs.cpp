#include "frame/aovs.h"

#include <algorithm>
#include <array>
#include <string_view>

namespace radfarm {
namespace {

using Integrator = RenderRequest::Integrator;

constexpr std::array<const char*, kAovCount> kNames = {
    "albedo",         "normal",             "depth",    "irradiance",     "samples.camera", "samples.visibility",
    "samples.formfactor", "variance", "classification", "grid", "masking"};

// DESIGN section 9 has this, too.
constexpr std::array<std::string_view, 1> kUnbuilt = {"density"};

std::string listed(AovSet set) {
  std::string all;
  for (const std::string& name : aov_names(set)) all += (all.empty() ? "" : ", ") + name;
  return all;
}

AovSet given_by(const RenderRequest& request) {
  if (request.gather == Gather::kPaper) return 0;  // its samples belong to several pixels
  AovSet set = set_of(Aov::kAlbedo) | set_of(Aov::kNormal) | set_of(Aov::kDepth) | set_of(Aov::kIrradiance) |
               set_of(Aov::kCameraSamples) | set_of(Aov::kVisibilitySamples);
  // One sample has no variance.
  if (request.samples != 1) set |= set_of(Aov::kVariance);
  const bool is_paths = request.integrator == Integrator::kPaths || request.integrator == Integrator::kPhotonMap;
  if (is_paths) set &= ~set_of(Aov::kIrradiance);  // known of discs, not of what one ray sees
  const bool has_grid = request.integrator != Integrator::kPathTrace && request.integrator != Integrator::kRadiosity && !is_paths;
  if (has_grid) set |= set_of(Aov::kFormFactorSamples) | set_of(Aov::kClassification) | set_of(Aov::kGrid) | set_of(Aov::kMasking);
  return set;
}

Result<AovSet> set_named(const std::string& name, const RenderRequest& request) {
  const AovSet given = given_by(request);
  if (name == "all") return given;
  if (name == kLightGroups) {
    if (request.mesh) return fail(Code::kInvalidArgument, "--aov light: --mesh draws over the light; leave one of them out");
    return AovSet{0};
  }
  if (std::find(kUnbuilt.begin(), kUnbuilt.end(), name) != kUnbuilt.end()) {
    return fail(Code::kUnimplemented, "--aov " + name + " is not built yet: use " + listed(given));
  }
  const auto found = std::find(kNames.begin(), kNames.end(), name);
  if (found == kNames.end()) {
    return fail(Code::kInvalidArgument,
                "--aov: '" + name.substr(0, 80) + "' is not one of all, " + listed((AovSet{1} << kAovCount) - 1) + ", " +
                    kLightGroups);
  }
  const auto aov = static_cast<Aov>(found - kNames.begin());
  if (contains(given, aov)) return set_of(aov);
  if (aov == Aov::kVariance) return fail(Code::kInvalidArgument, "--aov variance: needs --samples of 2 or more");
  return fail(Code::kInvalidArgument, "--aov " + name + ": --integrator " + to_string(request.integrator) +
                                          (request.gather == Gather::kPaper ? " --gather paper gives none"
                                                                           : " does not give it, it gives " + listed(given)));
}

}  // namespace

std::string to_string(Aov aov) { return kNames[static_cast<std::size_t>(aov)]; }

std::vector<std::string> aov_names(AovSet set) {
  std::vector<std::string> names;
  for (std::size_t k = 0; k < kAovCount; ++k) {
    if (contains(set, static_cast<Aov>(k))) names.emplace_back(kNames[k]);
  }
  return names;
}

Result<AovSet> requested_aovs(const RenderRequest& request) {
  AovSet set = 0;
  for (const std::string& name : request.aov) {
    RADFARM_TRY(const AovSet one, set_named(name, request));
    set |= one;
  }
  return set;
}

bool wants_light_groups(const RenderRequest& request) {
  return std::find(request.aov.begin(), request.aov.end(), kLightGroups) != request.aov.end();
}

}  // namespace radfarm
