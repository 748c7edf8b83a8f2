// Matter that loses nothing, under a sky that is 1 everywhere, cannot be seen: every pixel is 1.
#include <cmath>
#include <numbers>
#include <string>

#include <gtest/gtest.h>

#include "statistical/rendered_view.h"
#include "support/small_scenes.h"

namespace radfarm {
namespace {

constexpr int kSide = 12;
constexpr std::uint32_t kSamples = 512;
// One false alarm in a million runs of this file: two-sided 1e-6 over its 1440 pixels, as standard errors.
constexpr double kErrors = 6.2;
// The lobes' albedos are tables: 3 digits (docs/pipeline.md, matter.2 and matter.4).
constexpr double kTables = 5e-3;

struct Substance {
  const char* name;
  bool is_table;  // not exact by construction
  void (*make)(Material& m);
};

void metal(Material& m, float roughness) {
  m.metallic = m.specular = 1;
  m.roughness = roughness;
}

const Substance kSubstances[] = {
    {"Lambertian", false, [](Material&) {}},
    {"SmoothDielectric", true, [](Material& m) { m.specular = 1, m.roughness = 0; }},
    {"RoughDielectric", true, [](Material& m) { m.specular = 1, m.roughness = 0.4F; }},
    {"Mirror", false, [](Material& m) { metal(m, 0); }},
    {"Metal10", true, [](Material& m) { metal(m, 0.1F); }},
    {"Metal30", true, [](Material& m) { metal(m, 0.3F); }},
    {"Metal60", true, [](Material& m) { metal(m, 0.6F); }},
    {"Metal100", true, [](Material& m) { metal(m, 1); }},
    {"Glass", false, [](Material& m) { m.specular = m.transmission = 1, m.roughness = 0, m.has_volume = true; }},
    {"Pane", false, [](Material& m) { m.specular = m.transmission = 1, m.roughness = 0; }},
};

/// A ball of flat facets of radius 1: what it lacks to a sphere loses no light, as smooth normals would.
Scene ball(const Substance& substance) {
  constexpr int kRows = 12, kColumns = 24;
  test::SceneMaker maker;
  const std::uint32_t material = maker.material(Spectrum(1.0F));
  const auto at = [](int row, int column) {
    const float theta = kPi * static_cast<float>(row) / kRows;
    const float phi = 2 * kPi * static_cast<float>(column % kColumns) / kColumns;
    const float sine = row == 0 || row == kRows ? 0 : std::sin(theta);
    return Vec3(sine * std::cos(phi), std::cos(theta), sine * std::sin(phi));
  };
  for (int row = 0; row < kRows; ++row) {
    for (int column = 0; column < kColumns; ++column) {
      const Vec3 a = at(row, column), b = at(row, column + 1), c = at(row + 1, column + 1), d = at(row + 1, column);
      if (row > 0) maker.polygon(material, {a, b, c});
      if (row + 1 < kRows) maker.polygon(material, {a, c, d});
    }
  }
  Scene scene = maker.take();
  substance.make(scene.materials[material]);
  scene.environment = {1, 1, {Spectrum(1.0F)}, {}};
  return scene;
}

void PrintTo(const Substance& of, std::ostream* out) { *out << of.name; }

class WhiteFurnace : public testing::TestWithParam<Substance> {};
INSTANTIATE_TEST_SUITE_P(Of, WhiteFurnace, testing::ValuesIn(kSubstances), [](const auto& p) { return p.param.name; });

TEST_P(WhiteFurnace, EveryPixelIsTheSky) {
  const World world(ball(GetParam()));
  Camera camera = *place_camera({0, 0.7F, 3}, {0, 0, 0}, {0, 1, 0}, 0.7F);
  const Film film{camera, kSide, kSide, 3};
  Counters counters;
  const std::vector<PixelSums> pixels = render_tile(
      film, {0, 0, kSide, kSide}, {kSamples, kSamples, 0},
      [&](const Ray& ray, const PixelSampler& sampler, Counters& c, FirstSurface*) { return trace_path(world, ray, sampler, c); },
      counters).light;
  double reflected = 0, mean = 0, variance = 0;
  for (std::size_t i = 0; i < pixels.size(); ++i) {
    const PixelSums& p = pixels[i];
    const double n = p.samples;
    const double light = luminance(p.reflected()) / n, value = light + luminance(p.emission) / n;
    const double error = std::sqrt(std::max(0.0, p.squared_luminance / n - light * light) / (n - 1));
    EXPECT_EQ(p.dropped, 0U);
    EXPECT_NEAR(value, 1, (GetParam().is_table ? kTables : 1e-4) + kErrors * error) << i;
    reflected += light / static_cast<double>(pixels.size());
    mean += value / static_cast<double>(pixels.size());
    variance += error * error / static_cast<double>(pixels.size() * pixels.size());
  }
  RecordProperty("mean", std::to_string(mean));
  RecordProperty("noise", std::to_string(std::sqrt(variance)));
  EXPECT_NEAR(mean, 1, (GetParam().is_table ? kTables : 1e-4) + kErrors * std::sqrt(variance));
  EXPECT_GT(reflected, 0.02) << "the ball is there";
}

}  // namespace
}  // namespace radfarm
