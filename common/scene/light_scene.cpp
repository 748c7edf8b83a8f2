#include "scene/light_scene.h"

#include <algorithm>

#include "base/file.h"
#include "scene/environment_file.h"
#include "scene/ies.h"
#include "scene/limits.h"
#include "scene/sky.h"

namespace radfarm {
namespace {

constexpr std::string_view kSky = "sky:";

std::string names_of(const std::vector<PunctualLight>& lights) {
  if (lights.empty()) return "the scene has no point or spot light (KHR_lights_punctual)";
  std::string names;
  for (const PunctualLight& light : lights) names += (names.empty() ? "there are: '" : ", '") + light.name + "'";
  return names.size() > 300 ? names.substr(0, 300) + "..." : names;
}

Status add_photometry(const std::string& name, const std::filesystem::path& file, Scene& scene) {
  const auto is_meant = [&](const PunctualLight& l) {
    return l.name == name && l.kind != PunctualLight::Kind::kDirectional;
  };
  if (std::none_of(scene.lights.begin(), scene.lights.end(), is_meant)) {
    return fail(Code::kInvalidArgument, "--ies: no point or spot light is called '" + name + "'; " + names_of(scene.lights));
  }
  RADFARM_TRY(const std::string text, read_file(file, limits::kIesFileBytes));
  Result<Photometry> photometry = read_ies(text);
  if (!photometry) return annotate(photometry.error(), "--ies " + file.string());
  photometry->name = file.filename().string();
  for (PunctualLight& light : scene.lights) {
    if (!is_meant(light)) continue;
    light.photometry = static_cast<std::uint32_t>(scene.photometries.size());
    const float before = luminance(light.intensity);
    light.intensity = before > 0 ? light.intensity / before : Spectrum(1.0F);
  }
  scene.photometries.push_back(std::move(*photometry));
  return {};
}

}  // namespace

Status light_scene(const AddedLight& added, const std::filesystem::path& folder, Scene& scene) {
  if (added.env.starts_with(kSky)) {
    auto sky = make_sky(std::string_view(added.env).substr(kSky.size()));
    if (!sky) return annotate(sky.error(), "--env");
    scene.environment = std::move(*sky);
  } else if (!added.env.empty()) {
    auto map = read_environment(folder / added.env);
    if (!map) return annotate(map.error(), "--env");
    scene.environment = std::move(*map);
  }
  for (const auto& [name, file] : added.ies) RADFARM_TRY_STATUS(add_photometry(name, folder / file, scene));
  return {};
}

}  // namespace radfarm
