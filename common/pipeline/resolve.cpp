#include "pipeline/resolve.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <type_traits>

#include "image/visibility_threshold.h"
#include "paths/photon_path.h"
#include "pipeline/pipeline.h"
#include "scene/camera.h"

namespace radfarm {
namespace {

// The paper samples all critical senders of a point where ours draws from them: some 150 rays a pixel [1, fig. 6].
constexpr float kPaperSamples = 12;
constexpr std::uint64_t kPhotonBatches = 16;  // tasks: each returns sums of the whole image
constexpr float kCrossings = 200;              // of a disc, of 4 million paths
// A gather's noise is that of all its light: where paths carry less than this share of it, fewer do, but never less than ...
constexpr double kAllPhotonsFrom = 0.1;
constexpr double kLeastPhotons = 1.0 / 16;     // ... this share of them
constexpr int kDefaultWidth = 640;
constexpr double kDefaultAspect = 16.0 / 9.0;

/// One row a quality; error falls only when every column grows together.
struct QualityRow {
  std::uint32_t path_samples;
  std::uint32_t gather_samples;
  std::uint32_t audit_pixels;
  std::uint32_t audit_samples;
  float max_link_error;
  float gather_link_error;  // of the gather built here: what rays meet it lights anew, but for light reflected twice
  std::uint32_t direct_samples;
  std::uint32_t hits_per_patch;
  std::uint32_t grid_columns;
  std::uint32_t max_senders;
  std::uint32_t vertex_samples;
  float samples_per_gather;
  std::uint32_t reflected_rays;
  std::uint32_t next_events;
  float full_lines;  // samples_per_gather where all that reflects is a sender
  float threshold_scale;
  float noise_share;  // of the mean radiance seen
  std::uint64_t photons;
};

constexpr QualityRow kQuality[] = {
    {16, 4, 512, 32, 1e-4F, 1e-4F, 1, 2, 16, 200, 600, 2, 2, 0, 8, .5F, .04F, 1'000'000},
    {64, 16, 1024, 64, 2e-5F, 1e-4F, 2, 4, 24, 400, 1200, 2, 2, 1, 12, .25F, .015F, 4'000'000},
    {256, 32, 2048, 128, 1e-5F, 2e-5F, 4, 8, 32, 800, 2400, 2, 2, 1, 16, .125F, .004F, 16'000'000},
    {1024, 64, 4096, 256, 5e-6F, 5e-6F, 8, 16, 48, 1600, 4800, 2, 2, 1, 24, .05F, .0006F, 64'000'000},
};

// Times its first samples, of one pixel.
constexpr std::uint32_t kMostSamples = 64;

// For a target of error e: the level whose light is likely to be good enough, ln(kErrorOfPreview / e) / ln(kErrorPerLevel); of
// photon paths, whose error falls with the cube root of their number, by rows of their own.
constexpr double kErrorOfPreview = .1, kErrorPerLevel = 3;
constexpr double kPathsErrorOfPreview = .14, kPathsErrorPerLevel = 1.6;
// Noise that pixels may keep, as a share of the mean, over e^2: half of what pixels that share light need, so that what is hard
// costs no more rounds than it must and what is easy is met at once.
constexpr double kNoiseOfTarget = 12;
constexpr std::uint32_t kFirstSamples = 16;  // of a pixel for a target, at most: noise decides all others

template <typename T>
T between(T a, T b, double t) {
  const double x = static_cast<double>(a), y = static_cast<double>(b);
  const double value = x > 0 && y > 0 ? x * std::pow(y / x, t) : x + t * (y - x);
  if constexpr (std::is_integral_v<T>) return static_cast<T>(std::llround(value));
  return static_cast<T>(value);
}

/// Between two qualities all counts and thresholds are, on a logarithmic scale. At a quality exactly its own.
QualityRow row_at(float level) {
  const double whole = std::clamp(std::floor(static_cast<double>(level)), 0.0, 3.0), t = std::clamp(level - whole, 0.0, 1.0);
  const QualityRow& a = kQuality[static_cast<std::size_t>(whole)];
  if (t == 0 || whole == 3) return a;
  const QualityRow& b = kQuality[static_cast<std::size_t>(whole) + 1];
  const auto mix = [&](auto QualityRow::*column) { return between(a.*column, b.*column, t); };
  return {mix(&QualityRow::path_samples), mix(&QualityRow::gather_samples), mix(&QualityRow::audit_pixels),
          mix(&QualityRow::audit_samples), mix(&QualityRow::max_link_error), mix(&QualityRow::gather_link_error),
          mix(&QualityRow::direct_samples), mix(&QualityRow::hits_per_patch), mix(&QualityRow::grid_columns),
          mix(&QualityRow::max_senders), mix(&QualityRow::vertex_samples), mix(&QualityRow::samples_per_gather),
          mix(&QualityRow::reflected_rays), mix(&QualityRow::next_events), mix(&QualityRow::full_lines),
          mix(&QualityRow::threshold_scale), mix(&QualityRow::noise_share), mix(&QualityRow::photons)};
}

float level_of(const RenderRequest& request, const Effort& effort) {
  const bool is_paths = request.integrator == RenderRequest::Integrator::kPaths || request.integrator == RenderRequest::Integrator::kPhotonMap;
  if (effort.level) return *effort.level;
  if (request.error) {
    const double preview = is_paths ? kPathsErrorOfPreview : kErrorOfPreview;
    const double level = std::log(preview / *request.error) / std::log(is_paths ? kPathsErrorPerLevel : kErrorPerLevel);
    return static_cast<float>(std::clamp(level, 0.0, static_cast<double>(kMostLevel)));
  }
  return static_cast<float>(request.quality);
}

void resolve_size(const RenderRequest& request, const Camera& camera, Settings& settings) {
  const double aspect = camera.aspect > 0 ? static_cast<double>(camera.aspect) : kDefaultAspect;
  const auto scaled = [](double pixels) { return std::clamp(static_cast<int>(std::lround(pixels)), 1, 16384); };
  settings.width = request.width.value_or(request.height ? scaled(*request.height * aspect) : kDefaultWidth);
  settings.height = request.height.value_or(scaled(settings.width / aspect));
}

}  // namespace

namespace {

Settings::Integrator integrator_of(const RenderRequest& request) {
  switch (request.integrator) {
    case RenderRequest::Integrator::kPathTrace: return Settings::Integrator::kPathTrace;
    case RenderRequest::Integrator::kPaths: return Settings::Integrator::kPaths;
    case RenderRequest::Integrator::kPhotonMap: return Settings::Integrator::kPhotonMap;
    case RenderRequest::Integrator::kRadiosity: return Settings::Integrator::kRadiosity;
    default: return Settings::Integrator::kGather;
  }
}

/// The gather as built here: neither the paper's, nor its baseline that evaluates every link at every pixel.
bool is_default_gather(const RenderRequest& request) {
  const bool is_gather = request.integrator == RenderRequest::Integrator::kAuto || request.integrator == RenderRequest::Integrator::kGather;
  return is_gather && request.gather == Gather::kDefault;
}

/// What the request says of film and lens goes before what the file says.
ChosenCamera with_lens(Camera camera, bool is_framed, const RenderRequest& request) {
  if (request.lens_diameter) camera.lens_diameter = *request.lens_diameter;
  if (request.focus_distance) camera.focus_distance = *request.focus_distance;
  return {std::move(camera), is_framed};
}

Result<Camera> placed_camera(const RenderRequest::PlacedCamera& placed, const Vec3d& origin) {
  RADFARM_TRY(Camera camera, place_camera(to_float(placed.eye - origin), to_float(placed.look_at - origin),
                                          to_float(placed.up_vector),
                                          static_cast<float>(placed.vertical_fov_degrees * std::numbers::pi / 180)));
  camera.focus_distance = static_cast<float>(length(placed.look_at - placed.eye));
  if (placed.orthographic_height) {
    camera.kind = Camera::Kind::kOrthographic;
    camera.half_height = static_cast<float>(*placed.orthographic_height / 2);
  }
  return camera;
}

}  // namespace

Result<ChosenCamera> choose_camera(const Scene& scene, const RenderRequest& request) {
  if (const auto* placed = std::get_if<RenderRequest::PlacedCamera>(&request.camera)) {
    RADFARM_TRY(Camera camera, placed_camera(*placed, scene.origin));
    return with_lens(std::move(camera), false, request);
  }
  const auto& named = std::get<RenderRequest::NamedCamera>(request.camera);
  if (named.name_or_index.empty() && scene.cameras.empty()) return with_lens(frame_scene(scene), true, request);
  RADFARM_TRY(Camera camera, find_camera(scene, named.name_or_index.empty() ? "0" : named.name_or_index));
  return with_lens(std::move(camera), false, request);
}

float grey_threshold(float scale, float mean_radiance) {
  const double grey = 0.18 * kDisplayWhite;
  return static_cast<float>(static_cast<double>(scale) * visible_difference(grey) / grey * static_cast<double>(mean_radiance));
}

float noise_share(const RenderRequest& request, const Settings& settings) {
  if (request.samples) return 0;
  const double error = static_cast<double>(settings.target_error);
  return error > 0 ? static_cast<float>(kNoiseOfTarget * error * error) : row_at(settings.level).noise_share;
}

Target target_of(const RenderRequest& request) { return {request.error.value_or(0), request.time.value_or(0)}; }

float mean_radiance(const RadiositySolution& solution) {
  if (solution.hierarchy.nodes.empty()) return 0;
  const Node& root = solution.hierarchy.nodes[0];
  // Where nothing was solved, what the emitters' light would give once reflected stands in.
  const bool is_solved = !is_black(solution.reflected_power[0]);
  const Spectrum power = is_solved ? solution.reflected_power[0] : root.emitted_power * root.reflectance;
  return static_cast<float>(luminance(SpectrumD(power)) / (std::numbers::pi * static_cast<double>(root.area)));
}

/// (paths.6): from quality to quality noise and bias fall together, a disc's area as n^(-1/3).
void resolve_photons(const RenderRequest& request, OriginSet origins, double share, Settings& settings) {
  const double beyond = std::exp2(2 * std::max(0.0, static_cast<double>(settings.level) - 3));
  const double all = static_cast<double>(row_at(settings.level).photons) * beyond;
  settings.photons = request.photons ? *request.photons : static_cast<std::uint64_t>(share * all);
  settings.photon_batches = static_cast<std::uint32_t>(std::min<std::uint64_t>(settings.photons, kPhotonBatches));
  settings.photon_origins = origins;
  settings.photon_radius = request.radius.value_or(0);
  settings.photon_crossings = kCrossings * std::pow(static_cast<float>(settings.photons) / 4e6F, 2.0F / 3);
}

Settings resolve_settings(const RenderRequest& request, const Camera& camera, const Effort& effort) {
  Settings settings;
  settings.level = level_of(request, effort);
  settings.target_error = static_cast<float>(request.error.value_or(0));
  const QualityRow quality = row_at(settings.level);
  const bool is_path = effort.by_paths || request.integrator == RenderRequest::Integrator::kPathTrace;
  settings.integrator = is_path ? Settings::Integrator::kPathTrace : integrator_of(request);
  resolve_size(request, camera, settings);
  settings.tile = request.tile;
  settings.seed = request.seed;
  settings.camera_samples = request.samples ? static_cast<std::uint32_t>(*request.samples)
                                            : (is_path ? quality.path_samples : quality.gather_samples);
  if (request.error && !request.samples) settings.camera_samples = std::min(settings.camera_samples, kFirstSamples);
  const bool is_default = !is_path && is_default_gather(request);
  const bool may_differ = is_default && !request.samples;
  settings.max_camera_samples = may_differ ? kMostSamples * settings.camera_samples : settings.camera_samples;
  settings.shares_light = is_default && request.sharing && settings.camera_samples > 1 ? 1 : 0;
  const bool has_audit = request.audit && !request.mesh;
  settings.audit_pixels = has_audit ? quality.audit_pixels : 0;
  settings.audit_samples = has_audit ? quality.audit_samples : 0;
  settings.draws_mesh = request.mesh ? 1 : 0;
  settings.radiosity.max_link_error = request.link_error.value_or(is_default ? quality.gather_link_error : quality.max_link_error);
  settings.radiosity.direct_samples = quality.direct_samples;
  settings.radiosity.hits_per_patch = quality.hits_per_patch;
  settings.radiosity.oracle.criterion = request.oracle;
  settings.senders.columns = quality.grid_columns;
  settings.senders.rows = std::max(2U, static_cast<std::uint32_t>(std::lround(
                                           quality.grid_columns * static_cast<double>(settings.height) / settings.width)));
  settings.senders.slices = quality.grid_columns;
  settings.senders.max_senders = quality.max_senders;
  settings.senders.vertex_samples = quality.vertex_samples;
  settings.senders.samples_per_gather = quality.samples_per_gather;
  settings.senders.reflected_rays = quality.reflected_rays;
  settings.senders.next_events = quality.next_events;
  settings.senders.sky_lines = static_cast<std::uint32_t>(quality.samples_per_gather);
  settings.senders.gather = request.gather;
  settings.senders.paper_samples = kPaperSamples * quality.full_lines;
  const bool is_full = request.integrator == RenderRequest::Integrator::kFullGather;
  if (is_full) {
    settings.senders.samples_per_gather = quality.full_lines;
    settings.senders.reflected_rays = static_cast<std::uint32_t>(quality.full_lines / 4);
    settings.senders.next_events = 0;  // links, to the end
  }
  settings.senders.threshold_scale = is_full || request.threshold ? 0 : quality.threshold_scale;
  settings.senders.threshold = is_full ? 0 : request.threshold.value_or(0);
  if (settings.is_by_photons()) resolve_photons(request, kAllOrigins, 1, settings);
  return settings;
}

void resolve_specular_light(const RenderRequest& request, const EffectsPlan& plan, Settings& settings) {
  if (settings.integrator != Settings::Integrator::kGather) return;
  double light = 0;  // of all that diffuse surfaces reflect
  bool is_carried = false;
  for (const EffectDecision& effect : plan.effects) {
    if (!effect.active || (effect.id != "caustics" && effect.id != "glossy_interreflection")) continue;
    is_carried = true;
    light += effect.value;
  }
  if (!is_carried) return;
  resolve_photons(request, static_cast<OriginSet>(Origin::kSpecular), std::clamp(light / kAllPhotonsFrom, kLeastPhotons, 1.0), settings);
}

}  // namespace radfarm
