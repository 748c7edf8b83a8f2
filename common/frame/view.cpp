#include "frame/view.h"

#include <algorithm>
#include <array>

#include "base/flat_file.h"
#include "scene/limits.h"

namespace radfarm {
namespace {

constexpr std::uint32_t kVersion = 11;
constexpr std::uint32_t kMaxPhotonBatches = 1 << 16;

/// Camera without its name: a fixed layout.
struct StoredCamera {
  Camera::Kind kind;
  Vec3 position, right, up, forward;
  float vertical_fov, half_height, aspect, lens_diameter, focus_distance;
};

bool is_sane(const Settings& s) {
  const auto side = [](std::int32_t n) { return n >= 1 && n <= 16384; };
  return side(s.width) && side(s.height) && side(s.tile) && s.camera_samples >= 1 && s.aovs >> kAovCount == 0 &&
         s.photon_batches <= kMaxPhotonBatches && (s.photon_batches == 0 || s.photons >= s.photon_batches) &&
         s.max_camera_samples >= s.camera_samples;
}

/// Light groups are added up pixel by pixel, and each is cut into the same tasks.
bool go_together(const View& a, const View& b) {
  const Settings &s = a.settings, &t = b.settings;
  return s.integrator == t.integrator && s.width == t.width && s.height == t.height && s.tile == t.tile && s.aovs == t.aovs &&
         s.shares_light == t.shares_light && s.effects_off == t.effects_off && s.photons == t.photons &&
         s.photon_batches == t.photon_batches;
}

Result<LuminanceImage> get_elevation(const FlatFileReader& file, const std::string& prefix) {
  using Size = std::array<std::int32_t, 2>;
  RADFARM_TRY(const Size size, file.get_value<Size>(prefix + "elevation.size"));
  LuminanceImage image{size[0], size[1], {}};
  RADFARM_TRY(image.values, file.copy<float>(prefix + "elevation"));
  const bool fits = size[0] >= 0 && size[1] >= 0 && size[0] <= 16384 && size[1] <= 16384 &&
                    image.values.size() == static_cast<std::size_t>(size[0]) * static_cast<std::size_t>(size[1]);
  if (!fits) return fail(Code::kDataLoss, "view: its elevation is not of its size");
  return image;
}

/// Of the arrays of view `number`.
std::string prefix_of(std::size_t number) { return std::to_string(number) + "."; }

void add(const View& view, const std::string& prefix, FlatFileWriter& file) {
  const Camera& c = view.camera;
  file.add_value(prefix + "camera", StoredCamera{c.kind, c.position, c.right, c.up, c.forward, c.vertical_fov, c.half_height,
                                                 c.aspect, c.lens_diameter, c.focus_distance});
  file.add_value(prefix + "settings", view.settings);
  file.add_text(prefix + "facts", view.facts);
  file.add(prefix + "grid", view.grid);
  file.add_value(prefix + "elevation.size", std::array<std::int32_t, 2>{view.elevation.width, view.elevation.height});
  file.add(prefix + "elevation", view.elevation.values);
  file.add_text(prefix + "light_group", view.light_group);
}

Result<View> get_view(const FlatFileReader& file, const std::string& prefix) {
  RADFARM_TRY(const StoredCamera stored, file.get_value<StoredCamera>(prefix + "camera"));
  View view;
  view.camera = {"",         stored.kind,         stored.position,    stored.right, stored.up, stored.forward,
                 stored.vertical_fov, stored.half_height, stored.aspect, stored.lens_diameter, stored.focus_distance};
  RADFARM_TRY(view.settings, file.get_value<Settings>(prefix + "settings"));
  RADFARM_TRY(view.facts, file.get_text(prefix + "facts"));
  RADFARM_TRY(view.grid, file.copy<std::byte>(prefix + "grid"));
  RADFARM_TRY(view.elevation, get_elevation(file, prefix));
  RADFARM_TRY(view.light_group, file.get_text(prefix + "light_group"));
  if (!is_sane(view.settings)) return fail(Code::kDataLoss, "view: its image size or its AOVs are out of range");
  return view;
}

}  // namespace

std::vector<std::byte> encode(std::span<const View> views) {
  FlatFileWriter file("view", kVersion);
  file.add_value("count", static_cast<std::uint32_t>(views.size()));
  for (std::size_t i = 0; i < views.size(); ++i) add(views[i], prefix_of(i), file);
  return file.finish();
}

Result<std::vector<View>> decode_views(std::span<const std::byte> bytes) {
  RADFARM_TRY(const FlatFileReader file, FlatFileReader::open(bytes, "view", kVersion));
  RADFARM_TRY(const std::uint32_t count, file.get_value<std::uint32_t>("count"));
  if (count < 1 || count > limits::kLightGroups) return fail(Code::kDataLoss, "view: it has no light, or too many");
  std::vector<View> views;
  for (std::uint32_t i = 0; i < count; ++i) {
    RADFARM_TRY(View view, get_view(file, prefix_of(i)));
    views.push_back(std::move(view));
  }
  const bool is_whole = std::all_of(views.begin(), views.end(), [&](const View& view) {
    return go_together(view, views[0]) && (count == 1 || !view.light_group.empty());
  });
  if (!is_whole) return fail(Code::kDataLoss, "view: its light groups do not go together");
  return views;
}

}  // namespace radfarm
