#include "cli/request_flags.h"

#include <algorithm>
#include <array>
#include <charconv>
#include <cmath>
#include <string_view>
#include <utility>

#include "cli/unbuilt_flags.h"

namespace radfarm::cli {
namespace {

tl::unexpected<Error> wrong(const std::string& flag, const std::string& value, const std::string& right) {
  return fail(Code::kInvalidArgument, flag + ": '" + value + "' is wrong, " + right);
}

template <typename T>
std::optional<T> parse_number(std::string_view text) {
  T value{};
  const auto [stop, error] = std::from_chars(text.data(), text.data() + text.size(), value);
  if (error != std::errc{} || stop != text.data() + text.size()) return std::nullopt;
  return value;
}

Result<Vec3d> parse_vector(const std::string& flag, const std::string& text) {
  std::array<double, 3> numbers{};
  std::string_view rest = text;
  for (std::size_t i = 0; i < 3; ++i) {
    const std::size_t comma = i < 2 ? rest.find(',') : rest.size();
    const std::optional<double> number =
        comma == std::string_view::npos ? std::nullopt : parse_number<double>(rest.substr(0, comma));
    if (!number || !std::isfinite(*number)) return wrong(flag, text, "must be three numbers such as 1.5,0,-2");
    numbers[i] = *number;
    rest.remove_prefix(std::min(rest.size(), comma + 1));
  }
  return Vec3d(numbers[0], numbers[1], numbers[2]);
}

Status parse_size(const std::string& text, RenderRequest& request) {
  const std::size_t x = text.find('x');
  if (x != std::string::npos) {
    request.width = parse_number<int>(std::string_view(text).substr(0, x));
    request.height = parse_number<int>(std::string_view(text).substr(x + 1));
  }
  if (request.width && request.height) return {};
  return wrong("--size", text, "must be WIDTHxHEIGHT in pixels, such as 640x480");
}

Status parse_camera(const RequestFlags& flags, RenderRequest& request) {
  const bool placed = flags.eye || flags.look_at || flags.up_vector || flags.fov || flags.orthographic;
  if (flags.camera && placed) return fail(Code::kInvalidArgument, "--camera and --eye exclude each other");
  if (!placed) {
    request.camera = RenderRequest::NamedCamera{flags.camera.value_or("")};
    return {};
  }
  if (!flags.eye || !flags.look_at) return fail(Code::kInvalidArgument, "a placed camera needs --eye and --look-at");
  RenderRequest::PlacedCamera camera;
  RADFARM_TRY(camera.eye, parse_vector("--eye", *flags.eye));
  RADFARM_TRY(camera.look_at, parse_vector("--look-at", *flags.look_at));
  if (flags.up_vector) {
    RADFARM_TRY(camera.up_vector, parse_vector("--up-vector", *flags.up_vector));
  }
  if (flags.fov && flags.orthographic) return fail(Code::kInvalidArgument, "--fov and --orthographic exclude each other");
  camera.vertical_fov_degrees = flags.fov.value_or(camera.vertical_fov_degrees);
  camera.orthographic_height = flags.orthographic;
  request.camera = camera;
  return {};
}

Status parse_ies(const std::vector<std::string>& pairs, RenderRequest& request) {
  for (const std::string& pair : pairs) {
    const std::size_t equals = pair.find('=');
    if (equals == 0 || equals == std::string::npos || equals + 1 == pair.size()) {
      return wrong("--ies", pair, "must be NAME=FILE, the name of a light and its IES file");
    }
    if (!request.ies.emplace(pair.substr(0, equals), pair.substr(equals + 1)).second) {
      return wrong("--ies", pair, "the light has a file already");
    }
  }
  return {};
}

/// Seconds of "90", "60s", "2m", "1.5h".
Result<double> parse_duration(const std::string& text) {
  constexpr std::array<std::pair<char, double>, 3> kUnits = {{{'s', 1}, {'m', 60}, {'h', 3600}}};
  double unit = 1;
  std::string_view digits = text;
  for (const auto& [letter, seconds] : kUnits) {
    if (!digits.ends_with(letter)) continue;
    unit = seconds;
    digits.remove_suffix(1);
    break;
  }
  const std::optional<double> number = parse_number<double>(digits);
  if (number && *number > 0 && std::isfinite(*number)) return *number * unit;
  return wrong("--time", text, "must be a wall time such as 90, 60s, 2m or 1.5h");
}

Status parse_target(const RequestFlags& flags, RenderRequest& request) {
  if ((flags.quality ? 1 : 0) + (flags.error ? 1 : 0) + (flags.time ? 1 : 0) > 1) {
    return fail(Code::kInvalidArgument, "--quality, --error and --time exclude each other");
  }
  if (flags.quality) {
    const auto quality = quality_from_string(*flags.quality);
    if (!quality) return fail(Code::kInvalidArgument, "--" + quality.error().message);
    request.quality = *quality;
  }
  if (flags.error) {
    RADFARM_TRY(request.error, parse_error_target(*flags.error));
  }
  if (flags.time) {
    RADFARM_TRY(request.time, parse_duration(*flags.time));
  }
  return {};
}

}  // namespace

Result<double> parse_error_target(const std::string& text) {
  const bool is_percent = text.ends_with('%');
  const std::optional<double> number = parse_number<double>(std::string_view(text).substr(0, text.size() - (is_percent ? 1 : 0)));
  const double error = number ? (is_percent ? *number / 100 : *number) : 0;
  if (error >= kLeastTargetError && error <= 1) return error;
  return wrong("--error", text, "must be a relative error from .01% to 100%, such as 2% or .02");
}

void add_request_flags(CLI::App& app, RequestFlags& flags) {
  app.add_option("--camera", flags.camera, "NAME or INDEX of a camera in the scene; default: the first, else framed");
  app.add_option("--eye", flags.eye, "X,Y,Z: where a camera of your own stands, metres");
  app.add_option("--look-at", flags.look_at, "X,Y,Z: what it looks at");
  app.add_option("--up-vector", flags.up_vector, "X,Y,Z: which way is up in the image; default 0,1,0");
  app.add_option("--fov", flags.fov, "vertical field of view in degrees; default 45");
  app.add_option("--orthographic", flags.orthographic, "parallel view this many metres high, instead of --fov");
  app.add_option("--size", flags.size, "WIDTHxHEIGHT in pixels; default 640 wide at the camera's aspect");
  app.add_option("--up", flags.up, "Y or Z: which axis of an OBJ file points up");
  app.add_option("--integrator", flags.integrator, "auto, radiosity, gather, full-gather, paths (photon paths carry all light), photon-map (for comparison) or path-trace");
  app.add_option("--quality", flags.quality, "preview, standard, high or reference; default standard");
  app.add_option("--error", flags.error,
                 "instead of --quality, the relative error that the image is to be below, such as 2%; else exit code 5");
  app.add_option("--time", flags.time,
                 "instead of --quality, the wall time that it may take: 90, 60s, 2m or 1.5h; the image depends on the machine");
  app.add_option("--oracle", flags.oracle, "KS, KL, CS, HE or VAR: what judges the links of radiosity; docs/radiosity.md");
  app.add_option("--samples", flags.samples, "camera samples a pixel; default from --quality");
  app.add_option("--photons", flags.photons, "light paths: of --integrator paths and photon-map, and of a gather where the scene has caustics; default from --quality");
  app.add_option("--radius", flags.radius, "metres, of the discs that count them; default by how many cross");
  app.add_option("--link-error", flags.link_error,
                 "largest share of all light that one radiosity link may misplace; default from --quality");
  app.add_option("--threshold", flags.threshold, "largest accepted change of radiance, cd/m^2; default from --quality");
  app.add_option("--seed", flags.seed, "another seed, another independent image");
  app.add_option("--tile", flags.tile, "pixels a side of a task; never changes the image");
  app.add_flag("--no-audit", flags.no_audit, "do not measure the error");
  app.add_flag("--no-sharing", flags.no_sharing, "keep the noise: pixels that look at like surfaces do not share light");
  app.add_flag("--mesh", flags.mesh, "draw the edges of the elements; with --integrator radiosity, and without an audit");
  app.add_option("--aov", flags.aov,
                 "LIST of layers besides light, or all: albedo, normal, depth, irradiance, samples.camera, samples.visibility, "
                 "samples.formfactor, variance, classification, grid, masking; docs/formats.md. Beside these, light: a layer light.NAME of each "
                 "light group, at the cost of about a render a group")
      ->delimiter(',')
      ->allow_extra_args(false);
  app.add_option("--effects", flags.effects, "+id,-id: force effects on or off; see `radfarm explain`");
  app.add_option("--env", flags.env, "MAP.hdr, MAP.exr or sky:KEY=VALUE,...: light from all around; docs/sky.md");
  app.add_option("--ies", flags.ies, "NAME=FILE: a light of the scene shines as an IES file says; may be repeated");
  app.add_option("--lens-diameter", flags.lens_diameter, "metres; what is out of focus blurs; default 0, a pinhole");
  app.add_option("--focus-distance", flags.focus_distance, "metres from the lens to what is sharp; default --look-at");
  app.add_option("--gather", flags.gather, "default, or paper: grid final gather as paper 1 has it, for comparison");
  app.add_option("--criterion", flags.criterion, "uniform");
}

Result<RenderRequest> parse_request(const RequestFlags& flags) {
  RADFARM_TRY_STATUS(check_built("--integrator", flags.integrator));
  RADFARM_TRY_STATUS(check_built("--criterion", flags.criterion));
  RenderRequest request;
  const auto integrator = integrator_from_string(flags.integrator);
  if (!integrator) return fail(Code::kInvalidArgument, "--" + integrator.error().message);
  request.integrator = *integrator;
  const auto gather = gather_from_string(flags.gather);
  if (!gather) return fail(Code::kInvalidArgument, "--" + gather.error().message);
  request.gather = *gather;
  RADFARM_TRY_STATUS(parse_target(flags, request));
  const auto oracle = oracle_from_string(flags.oracle);
  if (!oracle) return fail(Code::kInvalidArgument, "--" + oracle.error().message);
  request.oracle = *oracle;
  if (flags.up != "Y" && flags.up != "Z") return wrong("--up", flags.up, "must be Y or Z");
  request.up = flags.up == "Z" ? RenderRequest::UpAxis::kZ : RenderRequest::UpAxis::kY;
  RADFARM_TRY_STATUS(parse_camera(flags, request));
  if (flags.size) RADFARM_TRY_STATUS(parse_size(*flags.size, request));
  request.seed = flags.seed;
  request.tile = flags.tile;
  request.samples = flags.samples;
  request.photons = flags.photons;
  request.radius = flags.radius;
  request.link_error = flags.link_error;
  request.threshold = flags.threshold;
  request.audit = !flags.no_audit;
  request.sharing = !flags.no_sharing;
  request.mesh = flags.mesh;
  request.aov = flags.aov;
  request.effects = flags.effects;
  request.env = flags.env;
  RADFARM_TRY_STATUS(parse_ies(flags.ies, request));
  request.lens_diameter = flags.lens_diameter;
  request.focus_distance = flags.focus_distance;
  RADFARM_TRY_STATUS(validate(request));
  return request;
}

namespace {

/// Calls `change` with every file name in the request.
template <typename Change>
void for_each_file(RenderRequest& request, const Change& change) {
  if (!request.env.empty() && !request.env.starts_with("sky:")) change(request.env);
  for (auto& [name, file] : request.ies) change(file);
}

}  // namespace

std::vector<Attachment> attach_files(RenderRequest& request) {
  std::vector<Attachment> attachments;
  for_each_file(request, [&](std::string& file) {
    const std::filesystem::path local = file;
    file = "attached-" + std::to_string(attachments.size()) + "-" + local.filename().string();
    attachments.push_back({local, file});
  });
  return attachments;
}

void locate_files(RenderRequest& request) {
  for_each_file(request, [](std::string& file) { file = std::filesystem::absolute(file).string(); });
}

}  // namespace radfarm::cli
