// The effects plan on trial, on the demonstration scenes: what it leaves out changes the image by no more than it says,
// and what it keeps is seen.
#include <algorithm>
#include <cmath>
#include <string>
#include <vector>

#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include "effects/specialise.h"
#include "estimate/task_result.h"
#include "statistical/rendered_request.h"

namespace radfarm {
namespace {

using nlohmann::json;

constexpr int kSamples = 64;
constexpr int kBlock = 6;  // pixels a side: bounds of pixels bound their means, which have little noise
// One false alarm in a million runs of this file, as standard errors: two-sided, 1e-6 over 49 means of 100 comparisons.
constexpr double kErrors = 6.4;

/// A demonstration scene: the effects that it shows, and its flags (tests/scenes/effects/README.md).
struct Demonstration {
  const char* scene;
  std::vector<std::string> shows = {};
  const char* env = "";
  bool has_ies = false;
  float lens = 0, focus = 0;
  int width = 48;  // pixels
  int height() const { return width * 3 / 4; }
};

const std::vector<Demonstration> kDemonstrations = {
    {"none", {"area_lights"}},
    {"convex_object", {"area_lights"}},
    {"grey_cornell", {"interreflection"}},
    {"colour_cornell", {"interreflection"}},
    {"one_channel", {"interreflection"}},
    {"interreflection", {"interreflection"}},
    {"low_interreflection"},
    {"point_light", {"punctual_lights"}},
    {"spot_light", {"punctual_lights"}},
    {"directional_light", {"punctual_lights"}},
    {"small_distant_light", {"area_lights"}},
    {"large_near_light", {"area_lights"}},
    {"textured_reflectance", {"reflectance_textures"}},
    {"textured_reflectance_constant"},
    {"textured_emission", {"emission_textures"}},
    {"textured_emission_constant"},
    {"alpha_mask", {"alpha_cutouts"}},
    {"alpha_mask_opaque"},
    {"normal_map", {"normal_maps"}},
    {"normal_map_flat"},
    {"glossy_floor", {"gloss"}},
    {"mirror", {"gloss"}},
    {"caustic", {"gloss"}},
    {"glass_sphere", {"transmission"}},
    {"window", {"panes", "environment"}, "sky:overcast,lux=50"},
    {"open_plane_sky", {"environment"}, "sky:overcast,lux=3"},
    {"closed_box_env", {"area_lights"}, "sky:overcast"},
    {"depth_of_field", {"depth_of_field"}, "", false, 0.08F, 3, 144},  // blurs by pixels, so it needs some
    {"vertex_colours"},
    {"clearcoat", {"clearcoat"}},
    {"sheen", {"sheen"}},
    {"ies_lamp", {"ies"}, "", true},
    {"all", {"area_lights", "environment", "interreflection", "panes"}, "sky:overcast,lux=50", true, 0.02F, 3.8F},
};

struct Pixels {
  int width = 0;
  std::vector<PixelSums> sums;  // row by row
  json effects;
};

/// The scene as `radfarm render --integrator path-trace` renders it.
Pixels render(const Demonstration& of, const std::string& effects, std::uint64_t seed) {
  RenderRequest request;
  request.integrator = RenderRequest::Integrator::kPathTrace;
  request.width = of.width, request.height = of.height();
  request.samples = kSamples;
  request.tile = kBlock;
  request.audit = false;
  request.seed = seed;
  request.effects = effects;
  request.env = of.env;
  if (of.has_ies) request.ies = {{"downlight", "downlight.ies"}};
  if (of.lens > 0) request.lens_diameter = of.lens, request.focus_distance = of.focus;
  const test::RanTasks ran = test::run_tasks(std::string("effects/") + of.scene, request);
  Pixels pixels;
  pixels.width = of.width;
  pixels.sums.resize(static_cast<std::size_t>(of.width * of.height()));
  for (const std::vector<std::byte>& bytes : ran.results) {
    const TileResult tile = *decode_tile_result(bytes);
    auto next = tile.pixels.begin();
    for (int y = tile.rect.y0; y < tile.rect.y1; ++y) {
      for (int x = tile.rect.x0; x < tile.rect.x1; ++x)
        pixels.sums[static_cast<std::size_t>(y * of.width + x)] = *next++;
    }
  }
  pixels.effects = (*finish(ran.files.view, ran.results, {})->report)["effects"];
  return pixels;
}

/// A mean of reflected luminance and its standard error.
struct Light {
  double value = 0;
  double variance = 0;
};

/// Means over blocks of pixels, and over all of them last.
std::vector<Light> lights_of(const Pixels& image) {
  const auto width = static_cast<std::size_t>(image.width), columns = width / kBlock;
  std::vector<Light> lights(image.sums.size() / (kBlock * kBlock) + 1);
  const auto add = [](Light& light, double value, double variance, double count) {
    light.value += value / count;
    light.variance += variance / (count * count);
  };
  for (std::size_t i = 0; i < image.sums.size(); ++i) {
    const PixelSums& p = image.sums[i];
    EXPECT_EQ(p.dropped, 0U);
    const double n = p.samples, mean = luminance(p.reflected()) / n;
    const double variance = std::max(0.0, p.squared_luminance / n - mean * mean) / (n - 1);
    const std::size_t block = i / width / kBlock * columns + i % width / kBlock;
    add(lights[block], mean, variance, kBlock * kBlock);
    add(lights.back(), mean, variance, static_cast<double>(image.sums.size()));
  }
  return lights;
}

double noise_of(const Light& a, const Light& b) { return kErrors * std::sqrt(a.variance + b.variance); }

bool is_same(const Pixels& a, const Pixels& b) { return a.sums == b.sums; }

/// Whether two images of independent samples differ somewhere by more than noise.
bool differs(const Pixels& a, const Pixels& b) {
  const std::vector<Light> x = lights_of(a), y = lights_of(b);
  for (std::size_t i = 0; i < x.size(); ++i) {
    if (std::fabs(x[i].value - y[i].value) > noise_of(x[i], y[i]) + 1e-9) return true;
  }
  return false;
}

json row_of(const Pixels& image, const std::string& id) {
  for (const json& row : image.effects) {
    if (row["id"] == id) return row;
  }
  ADD_FAILURE() << "no effect " << id;
  return {};
}

double bound_of(const json& row) {
  return row["bound"].is_number() ? row["bound"].get<double>() : std::numeric_limits<double>::infinity();
}

/// The change of the image is within the row's bound, of its mean or of each pixel.
void expect_within_bound(const json& row, const Pixels& without, const Pixels& with) {
  const std::vector<Light> x = lights_of(without), y = lights_of(with);
  const bool is_mean = row["bound_scope"] == "mean over pixels";
  for (std::size_t i = is_mean ? x.size() - 1 : 0; i < x.size(); ++i) {
    const double change = std::fabs(x[i].value - y[i].value);
    EXPECT_LE(change, bound_of(row) + noise_of(x[i], y[i]) + 1e-9)
        << row["id"] << ": " << x[i].value << " without, " << y[i].value << " with, bound " << row["bound"] << " ("
        << row["bound_kind"] << ")";
  }
}

void PrintTo(const Demonstration& of, std::ostream* out) { *out << of.scene; }

class EffectsPlanOf : public testing::TestWithParam<Demonstration> {};
INSTANTIATE_TEST_SUITE_P(Scene, EffectsPlanOf, testing::ValuesIn(kDemonstrations),
                         [](const auto& p) { return p.param.scene; });

TEST_P(EffectsPlanOf, LeavesOutNoMoreThanItSaysAndKeepsWhatIsSeen) {
  const Demonstration& scene = GetParam();
  const Pixels planned = render(scene, "", 1);
  std::string exact;
  for (const json& row : planned.effects) {
    const std::string id = row["id"];
    if (row["active"] || effect_of(id) == Effect::kCount) continue;
    if (bound_of(row) == 0 && row["bound_kind"] == "exact") {
      exact += (exact.empty() ? "+" : ",+") + id;
      continue;
    }
    const Pixels with = render(scene, "+" + id, 2);
    EXPECT_TRUE(row_of(with, id)["active"]) << id;
    expect_within_bound(row, planned, with);
  }
  // What is exact to leave out changes no bit.
  if (!exact.empty()) {
    EXPECT_TRUE(is_same(planned, render(scene, exact, 1))) << exact;
  }
  for (const std::string& id : scene.shows) {
    EXPECT_TRUE(row_of(planned, id)["active"]) << id;
    const Pixels without = render(scene, "-" + id, 2);
    EXPECT_FALSE(row_of(without, id)["active"]) << id;
    EXPECT_TRUE(differs(planned, without)) << id << ": nobody would see that it is off";
    expect_within_bound(row_of(without, id), without, planned);
  }
}

TEST(EffectsPlan, TwoSeedsOfOnePlanDifferByNoiseAlone) {
  const Demonstration scene{"colour_cornell"};
  const Pixels a = render(scene, "", 1), b = render(scene, "", 2);
  EXPECT_FALSE(is_same(a, b));
  EXPECT_FALSE(differs(a, b));
}

}  // namespace
}  // namespace radfarm
