#include "frame/view.h"

#include <array>

#include "base/flat_file.h"

namespace radfarm {
namespace {

constexpr std::uint32_t kVersion = 8;

/// Camera without its name: a fixed layout.
struct StoredCamera {
  Camera::Kind kind;
  Vec3 position, right, up, forward;
  float vertical_fov, half_height, aspect, lens_diameter, focus_distance;
};

bool is_sane(const Settings& s) {
  const auto side = [](std::int32_t n) { return n >= 1 && n <= 16384; };
  return side(s.width) && side(s.height) && side(s.tile) && s.camera_samples >= 1 && s.aovs >> kAovCount == 0;
}

Result<LuminanceImage> get_elevation(const FlatFileReader& file) {
  using Size = std::array<std::int32_t, 2>;
  RADFARM_TRY(const Size size, file.get_value<Size>("elevation.size"));
  LuminanceImage image{size[0], size[1], {}};
  RADFARM_TRY(image.values, file.copy<float>("elevation"));
  const bool fits = size[0] >= 0 && size[1] >= 0 && size[0] <= 16384 && size[1] <= 16384 &&
                    image.values.size() == static_cast<std::size_t>(size[0]) * static_cast<std::size_t>(size[1]);
  if (!fits) return fail(Code::kDataLoss, "view: its elevation is not of its size");
  return image;
}

}  // namespace

std::vector<std::byte> encode(const View& view) {
  FlatFileWriter file("view", kVersion);
  const Camera& c = view.camera;
  file.add_value("camera", StoredCamera{c.kind, c.position, c.right, c.up, c.forward, c.vertical_fov, c.half_height,
                                        c.aspect, c.lens_diameter, c.focus_distance});
  file.add_value("settings", view.settings);
  file.add_text("facts", view.facts);
  file.add("grid", view.grid);
  file.add_value("elevation.size", std::array<std::int32_t, 2>{view.elevation.width, view.elevation.height});
  file.add("elevation", view.elevation.values);
  return file.finish();
}

Result<View> decode_view(std::span<const std::byte> bytes) {
  RADFARM_TRY(const FlatFileReader file, FlatFileReader::open(bytes, "view", kVersion));
  RADFARM_TRY(const StoredCamera stored, file.get_value<StoredCamera>("camera"));
  View view;
  view.camera = {"",         stored.kind,         stored.position,    stored.right, stored.up, stored.forward,
                 stored.vertical_fov, stored.half_height, stored.aspect, stored.lens_diameter, stored.focus_distance};
  RADFARM_TRY(view.settings, file.get_value<Settings>("settings"));
  RADFARM_TRY(view.facts, file.get_text("facts"));
  RADFARM_TRY(view.grid, file.copy<std::byte>("grid"));
  RADFARM_TRY(view.elevation, get_elevation(file));
  if (!is_sane(view.settings)) return fail(Code::kDataLoss, "view: its image size or its AOVs are out of range");
  return view;
}

}  // namespace radfarm
