// No seams: light across the borders of tiles, grid cells and tetrahedra is as smooth as beside them.

#include <string>
#include <vector>

#include <gtest/gtest.h>

#include "statistical/scan_lines.h"
#include "support/small_scenes.h"
#include "support/statistics.h"

namespace radfarm {
namespace {

using test::Border;
using test::ScanLine;

// Cells are 40 pixels wide and 45 high: borders are far enough from each other for something to lie between.
constexpr int kWidth = 960, kHeight = 720, kTile = 32, kApart = 24;
constexpr std::uint32_t kSamples = 16;
constexpr std::uint64_t kSeeds = 2;
constexpr std::uint32_t kFloor = 0;                // material
constexpr std::size_t kFewestBorders = 300;        // of a kind
constexpr Border kBorders[] = {Border::kTile, Border::kCell, Border::kTetrahedron};
const double kLevel = test::sidak_level(1e-6, 18);  // three cases, three borders, two statistics

constexpr float kRho = 0.6F;

/// One end of it is near the floor and throws a sharp shadow, the other a smooth one.
void add_blocker(test::SceneMaker& maker, std::uint32_t material) {
  maker.polygon(material, {{-1.3F, 0.6F, -0.5F}, {-1.3F, 0.6F, 0.5F}, {-0.3F, 0.4F, 0.4F}, {-0.3F, 0.4F, -0.6F}});
}

void add_lamp(test::SceneMaker& maker) {
  const std::uint32_t lamp = maker.material(Spectrum(0), Spectrum(30));
  maker.polygon(lamp, {{0.8F, 3, -0.4F}, {1.6F, 3, -0.4F}, {1.6F, 3, 0.4F}, {0.8F, 3, 0.4F}});
}

/// As tests/scenes/make_gather_scenes.py has it: floor, blocker and lamp.
Scene smooth_shadow() {
  test::SceneMaker maker;
  maker.material(Spectrum(kRho));
  maker.polygon(kFloor, {{-5, 0, -5}, {-5, 0, 5}, {5, 0, 5}, {5, 0, -5}});
  add_blocker(maker, maker.material(Spectrum(0.2F)));
  add_lamp(maker);
  return maker.take();
}

/// White walls, and a blocker.
test::SceneMaker white_room(float half, float height) {
  test::SceneMaker maker;
  maker.material(Spectrum(kRho));
  const std::uint32_t white = maker.material(Spectrum(0.75F));
  maker.room({kFloor, white, white, white, white, white}, {-half, 0, -half}, {half, height, half});
  add_blocker(maker, white);
  return maker;
}

Scene shadow_in_room() {
  test::SceneMaker maker = white_room(4, 3.1F);
  add_lamp(maker);
  return maker.take();
}

/// 144 small lamps, each of which is hardly above the threshold of 1 %.
Scene many_lamps() {
  test::SceneMaker maker = white_room(5, 4);
  const std::uint32_t lamp = maker.material(Spectrum(0), Spectrum(20));
  for (int i = 0; i < 144; ++i) {
    const Vec3 at(-4.6F + 0.8F * static_cast<float>(i % 12), 3.95F, -4.6F + 0.8F * static_cast<float>(i / 12));
    maker.polygon(lamp, {at, at + Vec3(0.2F, 0, 0), at + Vec3(0.2F, 0, 0.2F), at + Vec3(0, 0, 0.2F)});
  }
  return maker.take();
}

/// `threshold` is a share of the mean radiance: at 1 % as little is interpolated as in any image. At ten times the mean, all
/// direct light is; then a gather that takes one vertex of a tetrahedron for all of it fails (p of 1e-28). At 1 % its steps are
/// below the noise of light by rays, and pass.
struct Case {
  const char* name;
  Scene (*make)();
  float threshold;
};
void PrintTo(const Case& of, std::ostream* out) { *out << of.name; }

/// What stands for pixel (x, y), tiles counted along the line.
test::Place place_of(const World& world, const PerspectiveGrid& grid, const Film& film, int x, int y, int along) {
  const Ray ray = camera_ray(film.camera, film.width, film.height, static_cast<float>(x) + 0.5F, static_cast<float>(y) + 0.5F);
  const std::optional<Hit> hit = world.caster.closest(ray, 0);
  if (!hit) return {along / kTile};
  const SurfacePoint point = world.surfaces.met(*hit, ray);
  return {along / kTile, grid.cell_at(point.position), interpolate(grid, point.position).vertices, point.material == kFloor};
}

/// Row `at`, or column `at`, tile by tile.
ScanLine render_line(const World& world, const test::GatheredView& view, const Film& film, bool is_row, int at) {
  ScanLine line;
  Counters counters;
  const int length = is_row ? film.width : film.height;
  for (int begin = 0; begin < length; begin += kTile) {
    const int end = std::min(begin + kTile, length);
    const PixelRect rect = is_row ? PixelRect{begin, at, end, at + 1} : PixelRect{at, begin, at + 1, end};
    for (const PixelSums& sums : render_tile(film, rect, {kSamples, kSamples, 0}, view.integrator(), counters).light) {
      const int along = static_cast<int>(line.values.size());
      const double n = sums.samples, mean = luminance(sums.reflected()) / n;
      line.places.push_back(place_of(world, view.grid(), film, is_row ? along : at, is_row ? at : along, along));
      line.values.push_back(mean);  // of radiance: irradiance times rho / pi, the same everywhere
      line.variances.push_back(std::max(0.0, sums.squared_luminance / n - mean * mean) / (n - 1));
    }
  }
  return line;
}

/// Rows and columns of the images of all seeds, so far apart that they have no pixel in common but where they cross.
std::vector<ScanLine> render_lines(const World& world, float threshold) {
  std::vector<ScanLine> lines;
  for (std::uint64_t seed = 1; seed <= kSeeds; ++seed) {
    const Film film{place_camera({0.2F, 2.2F, 3.2F}, {-0.6F, 0, 0}, {0, 1, 0}, 0.8F).value(), kWidth, kHeight, seed};
    const test::GatheredView view(world, film, Gather::kDefault, threshold);
    const int rows = kHeight / kApart, columns = kWidth / kApart;
    std::vector<ScanLine> of_seed(static_cast<std::size_t>(rows + columns));
    parallel_for(of_seed.size(), 1, [&](std::size_t begin, std::size_t end) {
      for (std::size_t i = begin; i < end; ++i) {
        const int k = static_cast<int>(i);
        const bool is_row = k < rows;
        of_seed[i] = render_line(world, view, film, is_row, (is_row ? k : k - rows) * kApart + kApart / 2);
      }
    });
    lines.insert(lines.end(), of_seed.begin(), of_seed.end());
  }
  return lines;
}

std::vector<ScanLine> with_steps(std::vector<ScanLine> lines, Border border, double sigmas, int every) {
  for (ScanLine& line : lines) line = test::with_steps(std::move(line), border, sigmas, every);
  return lines;
}

class Continuity : public testing::TestWithParam<Case> {};
INSTANTIATE_TEST_SUITE_P(Scenes, Continuity,
                         testing::Values(Case{"SmoothShadow", smooth_shadow, 0.01F}, Case{"ManyLamps", many_lamps, 0.01F},
                                         Case{"ShadowInterpolated", shadow_in_room, 10}),
                         [](const auto& p) { return std::string(p.param.name); });

TEST_P(Continuity, SecondDifferencesAtBordersAreAsThoseBeside) {
  const World world(GetParam().make());
  const std::vector<ScanLine> lines = render_lines(world, GetParam().threshold);
  for (const Border border : kBorders) {
    SCOPED_TRACE(static_cast<int>(border));
    const test::Excess ranks = excess_by_ranks(lines, border), largest = excess_of_largest(lines, border);
    std::printf("border %d: %zu compared, p <= %.2g by ranks, p <= %.2g of the largest\n", static_cast<int>(border),
                ranks.borders, ranks.p_value, largest.p_value);
    EXPECT_GT(ranks.borders, kFewestBorders);
    EXPECT_GT(ranks.p_value, kLevel);
    EXPECT_GT(largest.p_value, kLevel);
    // A step of three standard errors of a pixel at every border, and one of twelve at every twentieth: each is found.
    EXPECT_LT(excess_by_ranks(with_steps(lines, border, 3, 1), border).p_value, kLevel);
    EXPECT_LT(excess_of_largest(with_steps(lines, border, 12, 20), border).p_value, kLevel);
  }
}

}  // namespace
}  // namespace radfarm
