// Light of skies, panes and photometries at a surface, against closed forms: path tracing and gather.
#include <array>
#include <cmath>
#include <numbers>

#include <gtest/gtest.h>

#include "math/statistics.h"
#include "matter/fresnel.h"
#include "scene/light_scene.h"
#include "scene/sky.h"
#include "statistical/rendered_view.h"
#include "support/small_scenes.h"
#include "support/statistics.h"

namespace radfarm {
namespace {

using test::Mean;
using test::SceneMaker;

constexpr double kPiD = std::numbers::pi;
constexpr double kReflectance = 0.6;
// One false alarm in a million runs of this file, as standard errors: two-sided 1e-6 over its 40 comparisons.
constexpr double kErrors = 5.6;
// The map of a sky is 0.7 degrees coarse; what that does to the light on a tilted plane is of second order.
constexpr double kCoarse = 1e-3;
// Interpolated visibility of the sky and of lamps: the budget of the gather.
constexpr double kBias = 0.02;

constexpr int kSide = 8;

/// A parallel view of 0.4 m around `at`, from 0.5 m in front of a surface with this normal.
Film film_at(const Vec3& at, const Vec3& normal) {
  const Vec3 up = std::fabs(normal.y) < 0.9F ? Vec3(0, 1, 0) : Vec3(0, 0, 1);
  Camera camera = *place_camera(at + normal * 0.5F, at, up, 0.5F);
  camera.kind = Camera::Kind::kOrthographic;
  camera.half_height = 0.2F;
  return {camera, kSide, kSide, 7};
}

void expect_light(const Mean& mean, double radiance, double bias, const char* what) {
  EXPECT_EQ(mean.dropped, 0U) << what;
  EXPECT_NEAR(mean.value, radiance, bias * radiance + kErrors * mean.error)
      << what << ": " << mean.value / radiance << " of it, noise " << mean.error / radiance;
}

/// Both integrators.
void expect_light_everywhere(const World& world, const Film& film, double radiance) {
  expect_light(test::path_traced(world, film, 512), radiance, kCoarse, "path trace");
  expect_light(test::gathered(world, film, 64), radiance, kBias, "gather");
}

Environment sky(const char* parameters) {
  Result<Environment> made = make_sky(parameters);
  EXPECT_TRUE(made) << made.error().message;
  return std::move(*made);
}

/// A plane of 2 m through the origin with this normal, under a sky.
World plane_under(const Environment& environment, const Vec3& normal) {
  SceneMaker maker;
  const Frame frame(normal);
  const Vec3 x = frame.tangent, y = frame.bitangent;
  maker.polygon(maker.material(Spectrum(static_cast<float>(kReflectance))), {-x - y, x - y, x + y, y - x});
  Scene scene = maker.take();
  scene.environment = environment;
  return World(std::move(scene));
}

TEST(OutsideLight, OfAnOvercastSkyOnTheGround) {
  // E = 7 pi / 9 Lz.
  const Environment environment = sky("overcast,lux=700,ground=0");
  const World world = plane_under(environment, {0, 1, 0});
  expect_light_everywhere(world, film_at({0, 0, 0}, {0, 1, 0}), kReflectance / kPiD * 700);
  const float zenith = world.environment.radiance({0, 1, 0}).g;
  EXPECT_NEAR(zenith, 700 * 9 / (7 * kPiD), 1e-3 * 300);
}

TEST(OutsideLight, OfAnOvercastSkyOnAWall) {
  const World world = plane_under(sky("overcast,lux=700,ground=0"), {0, 0, 1});
  expect_light_everywhere(world, film_at({0, 0, 0}, {0, 0, 1}), 0.396177 * kReflectance / kPiD * 700);
}

TEST(OutsideLight, OfAUniformSkyIsPiTimesItsRadiance) {
  const World world = plane_under(sky("uniform,luminance=50,ground=0"), {0, 1, 0});
  expect_light_everywhere(world, film_at({0, 0, 0}, {0, 1, 0}), kReflectance * 50);
}

TEST(OutsideLight, OfAUniformSkyOnATiltedPlaneFollowsItsViewOfIt) {
  // (1 + cos tilt) / 2 of pi L.
  const float tilt = 0.7F;
  const Vec3 normal(std::sin(tilt), std::cos(tilt), 0);
  const World world = plane_under(sky("uniform,luminance=50,ground=0"), normal);
  expect_light_everywhere(world, film_at({0, 0, 0}, normal), kReflectance * 50 * (1 + std::cos(0.7)) / 2);
}

TEST(OutsideLight, BesideAVeryLargeWallIsHalf) {
  SceneMaker maker;
  const std::uint32_t floor = maker.material(Spectrum(static_cast<float>(kReflectance))),
                      wall = maker.material(Spectrum());
  maker.polygon(floor, {{0, 0, -1}, {0, 0, 1}, {2, 0, 1}, {2, 0, -1}});
  maker.polygon(wall, {{0, 0, 1000}, {0, 0, -1000}, {0, 1000, -1000}, {0, 1000, 1000}});
  Scene scene = maker.take();
  scene.environment = sky("uniform,luminance=50,ground=0");
  const World world(std::move(scene));
  // At 1 m the wall is a half-space to 1e-6.
  expect_light_everywhere(world, film_at({1, 0, 0}, {0, 1, 0}), kReflectance * 50 / 2);
}

TEST(OutsideLight, OfTheSunOnAPlaneThatFacesIt) {
  Environment sun = sky("clear,elevation=40,azimuth=110,sun_lux=1000,sky_lux=500");
  sun.width = sun.height = 0;
  sun.radiance.clear();
  const World world = plane_under(sun, sun.sun.direction);
  expect_light_everywhere(world, film_at({0, 0, 0}, sun.sun.direction), kReflectance / kPiD * 1000);
}

/// A lamp 2 m above a floor of 8 m, and a pane between them at 1 m. The lamp is a small square or a point.
Scene glazed_floor(bool is_point, bool has_pane) {
  SceneMaker maker;
  const std::uint32_t floor = maker.material(Spectrum(static_cast<float>(kReflectance)));
  maker.polygon(floor, {{-4, 0, -4}, {-4, 0, 4}, {4, 0, 4}, {4, 0, -4}});
  const std::uint32_t pane = maker.material({0.9F, 0.9F, 0.9F});
  if (has_pane) maker.polygon(pane, {{-4, 1, -4}, {-4, 1, 4}, {4, 1, 4}, {4, 1, -4}});
  const float s = 0.02F;
  const std::uint32_t lamp = maker.material(Spectrum(), Spectrum(4000.0F));
  if (!is_point) maker.polygon(lamp, {{-s, 2, -s}, {s, 2, -s}, {s, 2, s}, {-s, 2, s}});
  Scene scene = maker.take();
  Material& glass = scene.materials[pane];
  glass.transmission = glass.specular = 1;
  glass.roughness = 0;
  if (is_point) {
    PunctualLight light;
    light.position = {0, 2, 0};
    light.intensity = Spectrum(10.0F);
    scene.lights.push_back(light);
  }
  return scene;
}

class Glazing : public testing::TestWithParam<bool> {};
INSTANTIATE_TEST_SUITE_P(Lamps, Glazing, testing::Bool(), [](const auto& p) { return p.param ? "Point" : "Square"; });

TEST_P(Glazing, LetsThePanesTransmittanceThroughAtEachAngle) {
  const World glazed(glazed_floor(GetParam(), true)), open(glazed_floor(GetParam(), false));
  for (const float x : {0.0F, 1.5F, 3.5F}) {
    // From below the pane, straight down on the floor.
    Film film = film_at({x, 0, 0}, {0, 1, 0});
    film.camera.half_height = 0.02F;
    const double share = 0.9 * static_cast<double>(pane_transmittance(2 / std::sqrt(4 + x * x), 1.5F));
    const Mean with = test::path_traced(glazed, film, 256), without = test::path_traced(open, film, 256);
    const double noise = std::hypot(with.error, without.error) / without.direct;
    // The patch and the lamp span some angles: 4 cm of 2 m.
    EXPECT_NEAR(with.direct / without.direct, share, 2e-3 + kErrors * noise) << x << " m, path trace";
    const Mean gathered = test::gathered(glazed, film, 64);
    const double gather_noise = std::hypot(gathered.error, without.error) / without.direct;
    EXPECT_NEAR(gathered.direct / without.direct, share, 2e-3 + kBias * share + kErrors * gather_noise)
        << x << " m, gather";
  }
}

TEST(Photometry, IlluminanceBelowTheDownlightIsThatOfItsTable) {
  // I cos^3 / h^2 with I from downlight.ies; the lamp hangs at (0.3, 2.1, -0.9) above a grey floor.
  Scene scene = test::own_scene("effects/ies_lamp");
  const Status status = light_scene({"", {{"downlight", "downlight.ies"}}},
                                    test::own_scene_path("effects/ies_lamp").parent_path(), scene);
  ASSERT_TRUE(status) << status.error().message;
  const Vec3 origin = to_float(scene.origin);
  const World world(std::move(scene));
  for (const auto& [degrees, candela] : {std::pair(0.0, 60.0), std::pair(20.0, 24.0), std::pair(50.0, 16.0)}) {
    const double gamma = degrees * kPiD / 180;
    const Vec3 at(0.3F, 0, static_cast<float>(-0.9 + 2.1 * std::tan(gamma)));
    Film film = film_at(at - origin, {0, 1, 0});
    // Small: at 20 degrees the intensity changes by 5 % a degree.
    film.camera.half_height = 1e-4F;
    const double radiance = 0.5 / kPiD * candela * std::pow(std::cos(gamma), 3) / (2.1 * 2.1);
    const Mean traced = test::path_traced(world, film, 4), gathered = test::gathered(world, film, 4);
    EXPECT_NEAR(traced.direct, radiance, 1e-3 * radiance) << degrees;
    EXPECT_NEAR(gathered.direct, radiance, 1e-3 * radiance) << degrees;
  }
}

}  // namespace
}  // namespace radfarm
