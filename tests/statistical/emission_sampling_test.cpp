#include "scene/emission_sampling.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <vector>

#include <gtest/gtest.h>

#include "base/random.h"
#include "math/statistics.h"
#include "support/small_scenes.h"
#include "support/statistics.h"

namespace radfarm {
namespace {

constexpr double kPiD = std::numbers::pi;
constexpr int kDraws = 400'000;
constexpr std::size_t kTests = 21;  // chi-square tests and z-tests of this file
const double kLevel = test::sidak_level(1e-6, kTests);

EmittedRay draw(const World& world, RandomSequence& random) {
  const double choice = random.uniform_double();
  const float a = random.uniform(), b = random.uniform(), c = random.uniform();
  return sample_emission(world, choice, {a, b}, {c, random.uniform()});
}

/// Counts of points that should be uniform over [0, 1)^n, `steps` cells along each coordinate.
struct Cells {
  std::vector<std::size_t> steps;
  std::vector<double> counts;

  explicit Cells(const std::vector<std::size_t>& along) : steps(along) {
    std::size_t cells = 1;
    for (const std::size_t s : steps) cells *= s;
    counts.resize(cells);
  }
  void add(const std::vector<double>& at) {
    std::size_t cell = 0;
    for (std::size_t i = 0; i < steps.size(); ++i) {
      EXPECT_GE(at[i], -1e-5);  // roundings of floats
      EXPECT_LE(at[i], 1 + 1e-5);
      const auto k = static_cast<std::size_t>(std::max(0.0, at[i]) * static_cast<double>(steps[i]));
      cell = cell * steps[i] + std::min(k, steps[i] - 1);
    }
    ++counts[cell];
  }
  double p_value() const {
    double total = 0;
    for (const double c : counts) total += c;
    const std::vector<double> expected(counts.size(), total / static_cast<double>(counts.size()));
    return test::chi_square(counts, expected).p_value;
  }
};

double turn(double y, double x) {
  const double part = std::atan2(y, x) / (2 * kPiD);
  return part - std::floor(part);
}

/// Two vectors across an axis, found another way than Frame's.
struct Axes {
  Vec3d x, y, z;
  explicit Axes(const Vec3d& axis) : z(axis) {
    const Vec3d other = std::fabs(z.x) < 0.9 ? Vec3d(1, 0, 0) : Vec3d(0, 1, 0);
    x = normalize(cross(other, z));
    y = cross(z, x);
  }
  double cosine(const Vec3& way) const { return dot(to_double(way), z); }
  double turn_of(const Vec3& way) const { return turn(dot(to_double(way), y), dot(to_double(way), x)); }
};

/// Uniform over the unit square when a point is uniform over the triangle; its distance from the plane must be small.
std::vector<double> uniform_place(const TriangleVertices& v, const Vec3& position) {
  const Vec3d a = to_double(v[0]), e1 = to_double(v[1]) - a, e2 = to_double(v[2]) - a, d = to_double(position) - a;
  const Vec3d normal = cross(e1, e2);
  const double b = dot(cross(d, e2), normal) / dot(normal, normal), c = dot(cross(e1, d), normal) / dot(normal, normal);
  EXPECT_LT(std::fabs(dot(d, normalize(normal))), 1e-3);  // leave() lifts it by ulps
  return {(b + c) * (b + c), b / std::max(b + c, 1e-300)};
}

/// One oblique triangle that emits 3 cd/m^2, on one side or both, mirrored or not.
Scene one_triangle(bool both_sides, bool is_mirrored) {
  test::SceneMaker maker;
  const std::uint32_t light = maker.material(Spectrum(), Spectrum(3.0F));
  maker.polygon(light, {{0.3F, -0.2F, 0.1F}, {1.4F, 0.3F, 0.6F}, {-0.2F, 0.5F, 1.7F}});
  Scene scene = maker.take();
  scene.materials[light].emits_from_both_sides = both_sides;
  if (is_mirrored) scene.instances[0].to_world[0][0] = -1;
  return scene;
}

struct Case {
  const char* name;
  bool both_sides, is_mirrored;
};
class ATriangle : public testing::TestWithParam<Case> {};
INSTANTIATE_TEST_SUITE_P(SampleEmission, ATriangle,
                         testing::Values(Case{"OneSided", false, false}, Case{"TwoSided", true, false},
                                         Case{"Mirrored", false, true}, Case{"MirroredTwoSided", true, true}),
                         [](const auto& test) { return test.param.name; });

TEST_P(ATriangle, EmitsEvenlyByAreaAndByTheCosine) {
  const auto [name, both_sides, is_mirrored] = GetParam();
  const World world(one_triangle(both_sides, is_mirrored));
  const EmissiveTriangle& t = world.emitters.triangles.at(0);
  const Axes front(to_double(t.normal)), back(-to_double(t.normal));
  // Place, direction and side together: what is drawn must be independent as well.
  Cells cells({6, 6, 6, 6, both_sides ? 2U : 1U});
  RandomSequence random(combine(1, both_sides, is_mirrored));
  for (int i = 0; i < kDraws; ++i) {
    const EmittedRay emitted = draw(world, random);
    const bool is_front = front.cosine(emitted.ray.direction) > 0;
    ASSERT_TRUE(is_front || both_sides);
    ASSERT_NEAR(static_cast<double>(length(emitted.ray.direction)), 1, 1e-5);
    const Axes& axes = is_front ? front : back;
    // Off the surface on the side that emits.
    EXPECT_GT(dot(to_double(emitted.ray.origin - t.vertices[0]), axes.z), 0);
    std::vector<double> at = uniform_place(t.vertices, emitted.ray.origin);
    const double cosine = axes.cosine(emitted.ray.direction);
    at.insert(at.end(), {1 - cosine * cosine, axes.turn_of(emitted.ray.direction), is_front ? 0.25 : 0.75});
    cells.add(at);
    EXPECT_NEAR(static_cast<double>(luminance(emitted.power)), world.emitters.total_flux, 1e-5 * world.emitters.total_flux);
  }
  EXPECT_GT(cells.p_value(), kLevel);
}

PunctualLight lamp(PunctualLight::Kind kind) {
  PunctualLight light;
  light.kind = kind;
  light.position = {0.25F, 0.5F, -0.75F};
  light.direction = normalize(Vec3(-1, 2, 0.5F));
  light.intensity = Spectrum(5, 3, 2);
  light.cos_inner = 0.9F, light.cos_outer = 0.6F;
  return light;
}

/// A dark floor and lamps.
Scene lit_by(const std::vector<PunctualLight>& lights) {
  test::SceneMaker maker;
  maker.polygon(maker.material(Spectrum(0.5F)), {{-1, 0, -1}, {-1, 0, 1}, {1, 0, 1}, {1, 0, -1}});
  Scene scene = maker.take();
  scene.lights = lights;
  return scene;
}

TEST(SampleEmission, APointShinesEvenlyOverTheSphere) {
  const PunctualLight light = lamp(PunctualLight::Kind::kPoint);
  const World world(lit_by({light}));
  Cells cells({20, 40});
  RandomSequence random(2);
  for (int i = 0; i < kDraws; ++i) {
    const EmittedRay emitted = draw(world, random);
    const Vec3 way = emitted.ray.direction;
    ASSERT_EQ(emitted.ray.origin, light.position);
    cells.add({(static_cast<double>(way.z) + 1) / 2, turn(static_cast<double>(way.y), static_cast<double>(way.x))});
  }
  EXPECT_GT(cells.p_value(), kLevel);
}

TEST(SampleEmission, ASpotIsSampledEvenlyInItsOuterCone) {
  const PunctualLight light = lamp(PunctualLight::Kind::kSpot);
  const World world(lit_by({light}));
  const Axes axes(to_double(light.direction));
  Cells cells({20, 40});
  RandomSequence random(3);
  for (int i = 0; i < kDraws; ++i) {
    const EmittedRay emitted = draw(world, random);
    ASSERT_EQ(emitted.ray.origin, light.position);
    const double outer = 1 - static_cast<double>(light.cos_outer);
    cells.add({(1 - axes.cosine(emitted.ray.direction)) / outer, axes.turn_of(emitted.ray.direction)});
  }
  EXPECT_GT(cells.p_value(), kLevel);
}

TEST(SampleEmission, ADirectionalLightFillsTheDiskOfTheScene) {
  const PunctualLight light = lamp(PunctualLight::Kind::kDirectional);
  const World world(lit_by({light}));
  const Axes axes(to_double(light.direction));
  const double radius = static_cast<double>(world.radius);
  Cells cells({20, 40});
  RandomSequence random(4);
  for (int i = 0; i < kDraws; ++i) {
    const EmittedRay emitted = draw(world, random);
    ASSERT_EQ(emitted.ray.direction, light.direction);
    const Vec3d origin = to_double(emitted.ray.origin);
    const double along = dot(origin, axes.z);
    ASSERT_LT(along, -radius * (1 - 1e-5));  // before all of the scene
    const Vec3d across = origin - axes.z * along;
    cells.add({dot(across, across) / (radius * radius), turn(dot(across, axes.y), dot(across, axes.x))});
  }
  EXPECT_GT(cells.p_value(), kLevel);
}

/// A quarter of a table, bright aside: all of its cells differ.
Photometry aside() { return {"", {0, 20, 50, 110}, {0, 30, 90}, {900, 800, 100, 0, 900, 300, 0, 40, 900, 50, 0, 0}}; }

Scene lit_by_table() {
  PunctualLight light = lamp(PunctualLight::Kind::kPoint);
  light.photometry = 0;
  light.right = normalize(cross(light.direction, Vec3(0, 0, 1)));
  Scene scene = lit_by({light});
  scene.photometries.push_back(aside());
  return scene;
}

TEST(SampleEmission, AnIesLightShinesAsItsTable) {
  const World world(lit_by_table());
  const PunctualLight& light = world.emitters.punctual.at(0);
  const Vec3d down = to_double(light.direction), right = to_double(light.right), side = cross(right, down);
  constexpr int kRows = 15, kColumns = 36, kSub = 10;
  std::vector<double> truth(kRows * kColumns);
  for (int i = 0; i < kRows * kSub; ++i) {
    for (int j = 0; j < kColumns * kSub; ++j) {
      const double gamma = 180.0 * (i + 0.5) / (kRows * kSub), c = 360.0 * (j + 0.5) / (kColumns * kSub);
      const auto cell = static_cast<std::size_t>(i / kSub * kColumns + j / kSub);
      truth[cell] += candela_at(aside(), gamma, c) * std::sin(gamma * kPiD / 180);
    }
  }
  // Rays are not drawn by the table's law exactly, but the power that they bring to a cell must have it.
  std::vector<RunningStatistics> power(kRows * kColumns);
  RandomSequence random(21);
  for (int i = 0; i < kDraws; ++i) {
    const EmittedRay emitted = draw(world, random);
    ASSERT_EQ(emitted.ray.origin, light.position);
    ASSERT_GT(luminance(emitted.power), 0);
    const Vec3d way = to_double(emitted.ray.direction);
    const double gamma = std::acos(std::clamp(dot(way, down), -1.0, 1.0)) / kPiD;
    const int row = std::min(kRows - 1, static_cast<int>(gamma * kRows));
    const int column = std::min(kColumns - 1, static_cast<int>(turn(dot(way, side), dot(way, right)) * kColumns));
    power[static_cast<std::size_t>(row * kColumns + column)].add(static_cast<double>(luminance(emitted.power)));
  }
  double total = 0, sum = 0;
  for (const double t : truth) total += t;
  int used = 0;
  for (std::size_t k = 0; k < truth.size(); ++k) {
    const double p = static_cast<double>(power[k].count()) / kDraws, mean = p * power[k].mean();
    const double expected = world.emitters.total_flux * truth[k] / total;
    if (power[k].count() < 100) continue;
    const double variance = p * (power[k].variance() + power[k].mean() * power[k].mean()) - mean * mean;
    // The quadrature of the truth is good to 2 in 1000 of a cell.
    const double sigma = std::sqrt(variance / kDraws + 4e-6 * expected * expected);
    sum += (mean - expected) * (mean - expected) / (sigma * sigma);
    ++used;
  }
  ASSERT_GT(used, 200);
  EXPECT_GT(test::regularized_gamma_q(used / 2.0, sum / 2), kLevel) << sum << " with " << used;
}

/// A triangle whose texture is a ramp along u: between two texels' centres, so exactly linear.
Scene textured_triangle() {
  Scene scene = one_triangle(false, false);
  Texture ramp;
  ramp.width = 2, ramp.height = 1;
  ramp.is_srgb = false;
  ramp.texels = {{0, 0, 0, 255}, {255, 204, 102, 255}};
  scene.textures.push_back(ramp);
  scene.materials[0].emission_texture.texture = 0;
  scene.meshes[0].uv[0] = {{0.25F, 0.5F}, {0.75F, 0.5F}, {0.25F, 0.5F}};
  return scene;
}

/// Emitters of every kind, of very different powers.
Scene every_kind() {
  Scene scene = textured_triangle();
  for (const auto kind : {PunctualLight::Kind::kPoint, PunctualLight::Kind::kSpot, PunctualLight::Kind::kDirectional}) {
    scene.lights.push_back(lamp(kind));
  }
  test::SceneMaker maker;
  maker.polygon(maker.material(Spectrum(), Spectrum(0.1F, 40, 1)), {{2, 0, 0}, {2, 0, 1}, {2, 1, 1}, {2, 1, 0}});
  Scene more = maker.take();
  scene.materials.push_back(more.materials[0]);
  scene.materials.back().emits_from_both_sides = true;
  more.meshes[0].material = 1;
  scene.meshes.push_back(more.meshes[0]);
  more.instances[0].mesh = 1;
  scene.instances.push_back(more.instances[0]);
  return scene;
}

void expect_flux(const Scene& scene, double truth, std::uint64_t seed) {
  const World world(scene);
  // total_flux comes from floats.
  EXPECT_NEAR(world.emitters.total_flux, truth, 1e-5 * truth);
  RunningStatistics power;
  RandomSequence random(seed);
  for (int i = 0; i < kDraws; ++i) power.add(static_cast<double>(luminance(draw(world, random).power)));
  // A single light of even power has no noise but rounding.
  if (power.standard_error() < 1e-7 * truth) {
    EXPECT_NEAR(power.mean(), truth, 1e-5 * truth);
    return;
  }
  EXPECT_GT(test::z_test(power.mean(), power.standard_error(), truth), kLevel)
      << power.mean() << " +- " << power.standard_error() << ", should be " << truth;
}

const double kIntensity = luminance(SpectrumD(5, 3, 2));

double triangle_area() {
  const Scene scene = one_triangle(false, false);
  const Surfaces surfaces(scene);
  const TriangleVertices v = surfaces.triangle(0, 0);
  return length(cross(to_double(v[1] - v[0]), to_double(v[2] - v[0]))) / 2;
}

double textured_flux() {
  // A ramp from 0 at two vertices to 1 at the third has its mean at 1/3.
  return kPiD * triangle_area() * 3 * luminance(SpectrumD(1, 0.8, 0.4)) / 3;
}
constexpr double kOuter = 1 - 0.6, kInner = 1 - 0.9;
double spot_flux() { return 2 * kPiD * kIntensity * (kInner + (kOuter - kInner) / 3); }

TEST(SampleEmission, BringsTheFluxOfEachKind) {
  expect_flux(one_triangle(false, false), kPiD * triangle_area() * 3, 5);
  expect_flux(one_triangle(true, false), 2 * kPiD * triangle_area() * 3, 6);
  expect_flux(textured_triangle(), textured_flux(), 7);
  expect_flux(lit_by({lamp(PunctualLight::Kind::kPoint)}), 4 * kPiD * kIntensity, 8);
  expect_flux(lit_by({lamp(PunctualLight::Kind::kSpot)}), spot_flux(), 9);
  expect_flux(lit_by_table(), kIntensity * zonal_lumens(aside()), 14);
  // The floor reaches sqrt(2) from the origin.
  expect_flux(lit_by({lamp(PunctualLight::Kind::kDirectional)}), 2 * kPiD * kIntensity, 10);
}

TEST(SampleEmission, BringsTheFluxOfAllKindsTogether) {
  const Scene scene = every_kind();
  const World world(scene);
  const double radius = static_cast<double>(world.radius);
  const double panel = 2 * kPiD * luminance(SpectrumD(Spectrum(0.1F, 40, 1)));
  expect_flux(scene, textured_flux() + panel + kIntensity * kPiD * (4 + radius * radius) + spot_flux(), 11);
}

TEST(SampleEmission, ChoosesEmittersAsNextEventsDo) {
  const World world(every_kind());
  const DiscreteDistribution& choice = world.emitters.choice;
  std::vector<double> observed(4), expected(4);  // triangles, point and spot, directional; the last for what is none
  for (std::size_t i = 0; i < choice.size(); ++i) {
    const std::size_t triangles = world.emitters.triangles.size();
    expected[i < triangles ? 0 : i < triangles + 2 ? 1 : 2] += kDraws * choice.probability(i);
  }
  const PunctualLight light = lamp(PunctualLight::Kind::kPoint);
  RandomSequence random(12);
  for (int i = 0; i < kDraws; ++i) {
    const EmittedRay emitted = draw(world, random);
    const bool is_lamp = emitted.ray.origin == light.position, is_sun = emitted.ray.direction == light.direction;
    ++observed[is_lamp ? 1 : is_sun ? 2 : 0];
  }
  observed.pop_back(), expected.pop_back();
  EXPECT_GT(test::chi_square(observed, expected).p_value, kLevel);
}

TEST(SampleEmission, AWrongLawIsFound) {
  // Directions even over the sphere, held to the law of the cosine.
  const World world(lit_by({lamp(PunctualLight::Kind::kPoint)}));
  Cells cells({10, 10});
  RandomSequence random(13);
  for (int i = 0; i < kDraws; ++i) {
    const Vec3 way = draw(world, random).ray.direction;
    const double cosine = static_cast<double>(way.z);
    cells.add({1 - cosine * cosine, turn(static_cast<double>(way.y), static_cast<double>(way.x))});
  }
  EXPECT_LT(cells.p_value(), 1e-9);
}

}  // namespace
}  // namespace radfarm
