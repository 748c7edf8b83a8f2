// No light goes where it cannot: scenes with a lit and a dark part, the dark one gathered and path-traced, block by block.

#include <cmath>
#include <string>
#include <vector>

#include <gtest/gtest.h>

#include "statistical/rendered_view.h"
#include "support/small_scenes.h"

namespace radfarm {
namespace {

constexpr int kWidth = 32, kHeight = 24, kBlock = 8;
constexpr double kLeak = 0.01;  // of the lit part's mean radiance: the dark part's mean
constexpr double kErrors = 4;   // standard errors: over all blocks of all scenes one false alarm in 250, and seeds are fixed

/// One scene and where to look: at its lit part and at its dark one.
struct LeakScene {
  Scene scene;
  Camera lit, dark;
};

Camera look(const Vec3& eye, const Vec3& at) { return place_camera(eye, at, {0, 1, 0}, 1.2F).value(); }

/// A closed white room with a lamp of 0.6 m under its ceiling at `lamp`.
test::SceneMaker lit_room(const Vec3& low, const Vec3& high, const Vec3& lamp, std::uint32_t& white) {
  test::SceneMaker maker;
  white = maker.material(Spectrum(0.7F));
  const std::uint32_t glow = maker.material(Spectrum(0), Spectrum(20));
  maker.room({white, white, white, white, white, white}, low, high);
  const float h = 0.3F;
  maker.polygon(glow, {lamp + Vec3(-h, 0, -h), lamp + Vec3(h, 0, -h), lamp + Vec3(h, 0, h), lamp + Vec3(-h, 0, h)});
  return maker;
}

/// Two rooms with one sheet between them and no way through.
LeakScene thin_wall() {
  std::uint32_t white;
  test::SceneMaker maker = lit_room({0, 0, 0}, {6, 3, 4}, {1.5F, 2.95F, 2}, white);
  maker.polygon(white, {{3, 0, 0}, {3, 3, 0}, {3, 3, 4}, {3, 0, 4}});
  return {maker.take(), look({0.3F, 1.5F, 2}, {3, 1.2F, 2}), look({5.7F, 1.5F, 2}, {3, 1.2F, 2})};
}

/// A cupboard of sheets whose door stands 4 cm open.
LeakScene cupboard() {
  std::uint32_t white;
  test::SceneMaker maker = lit_room({0, 0, 0}, {4, 3, 4}, {2, 2.95F, 2}, white);
  const float x = 1, y = 2, z = 0.6F, gap = 0.04F;
  maker.polygon(white, {{0.01F, y, 0.01F}, {x, y, 0.01F}, {x, y, z}, {0.01F, y, z}});
  maker.polygon(white, {{x, 0, 0.01F}, {x, y, 0.01F}, {x, y, z}, {x, 0, z}});
  maker.polygon(white, {{0.01F, 0, z}, {x - gap, 0, z}, {x - gap, y, z}, {0.01F, y, z}});
  return {maker.take(), look({3.7F, 1.5F, 3.7F}, {1, 1, 1}), look({0.1F, 1.2F, 0.1F}, {0.8F, 0.6F, 0.6F})};
}

/// A room around a corner: a wall leaves a passage at its end.
LeakScene l_shaped() {
  std::uint32_t white;
  test::SceneMaker maker = lit_room({0, 0, 0}, {6, 3, 6}, {1.5F, 2.95F, 1.5F}, white);
  maker.polygon(white, {{3, 0, 0}, {3, 3, 0}, {3, 3, 5}, {3, 0, 5}});
  return {maker.take(), look({0.3F, 1.5F, 5}, {1.5F, 1, 0}), look({5.7F, 1.5F, 4}, {3.2F, 1, 0.2F})};
}

/// Two storeys with one sheet between them, and a hole for a ladder.
LeakScene storeys() {
  std::uint32_t white;
  test::SceneMaker maker = lit_room({0, 0, 0}, {5, 5, 5}, {2.5F, 2.4F, 2.5F}, white);
  maker.polygon(white, {{0, 2.5F, 0}, {4.4F, 2.5F, 0}, {4.4F, 2.5F, 5}, {0, 2.5F, 5}});
  maker.polygon(white, {{4.4F, 2.5F, 0}, {5, 2.5F, 0}, {5, 2.5F, 4.4F}, {4.4F, 2.5F, 4.4F}});
  return {maker.take(), look({0.3F, 1.2F, 2.5F}, {4, 0.5F, 2.5F}), look({0.3F, 4, 0.3F}, {2.5F, 2.6F, 2.5F})};
}

/// A room within a room, with a small window.
LeakScene room_in_room() {
  std::uint32_t white;
  test::SceneMaker maker = lit_room({0, 0, 0}, {8, 4, 8}, {4, 3.95F, 6.5F}, white);
  maker.room({white, white, white, white, white, white}, {2, 0.01F, 1}, {6, 2.5F, 4});
  Scene scene = maker.take();
  scene.instances.pop_back();  // the wall at z = 4: instead with a window of 0.4 m
  LeakScene made{std::move(scene), look({0.4F, 2, 7.5F}, {5, 0.5F, 6}), look({2.2F, 1.8F, 1.2F}, {4.5F, 0.8F, 3})};
  const float lows[4][4] = {{2, 0.01F, 3.8F, 2.5F}, {4.2F, 0.01F, 6, 2.5F}, {3.8F, 0.01F, 4.2F, 1}, {3.8F, 1.4F, 4.2F, 2.5F}};
  for (const auto& [x0, y0, x1, y1] : lows) {
    Mesh mesh;
    mesh.material = white;
    mesh.positions = {{x0, y0, 4}, {x1, y0, 4}, {x1, y1, 4}, {x0, y1, 4}};
    mesh.triangles = {{0, 1, 2}, {0, 2, 3}};
    made.scene.meshes.push_back(std::move(mesh));
    Instance instance;
    instance.mesh = static_cast<std::uint32_t>(made.scene.meshes.size() - 1);
    made.scene.instances.push_back(instance);
  }
  return made;
}

/// `block` is how far one of twelve blocks of the dark film may be off. In the cupboard, radiosity is blurred over patches beside the slit: 2.2 %
/// there when this was written (docs/hard-cases.md).
struct NamedScene {
  const char* name;
  LeakScene (*make)();
  double block = kLeak;
};
void PrintTo(const NamedScene& of, std::ostream* out) { *out << of.name; }

class Leaks : public testing::TestWithParam<NamedScene> {};
INSTANTIATE_TEST_SUITE_P(Scenes, Leaks,
                         testing::Values(NamedScene{"ThinWall", thin_wall}, NamedScene{"Cupboard", cupboard, 0.03},
                                         NamedScene{"LShaped", l_shaped}, NamedScene{"Storeys", storeys},
                                         NamedScene{"RoomInRoom", room_in_room}),
                         [](const auto& p) { return std::string(p.param.name); });

TEST_P(Leaks, AreLessThanAHundredthOfTheLitPart) {
  LeakScene of = GetParam().make();
  const World world(std::move(of.scene));
  const double lit = test::path_traced(world, {of.lit, kWidth, kHeight, 1}, 64).value;
  ASSERT_GT(lit, 0);
  const std::vector<test::Mean> gathered = test::gathered_blocks(world, {of.dark, kWidth, kHeight, 1}, 16, kBlock);
  const std::vector<test::Mean> traced = test::path_traced_blocks(world, {of.dark, kWidth, kHeight, 2}, 256, kBlock);
  double worst = 0, mean = 0, variance = 0;
  const double count = static_cast<double>(gathered.size());
  for (std::size_t i = 0; i < gathered.size(); ++i) {
    const double difference = gathered[i].value - traced[i].value, noise = std::hypot(gathered[i].error, traced[i].error);
    worst = std::max(worst, std::fabs(difference) / lit);
    mean += difference / count;
    variance += noise * noise / (count * count);
    EXPECT_LT(std::fabs(difference), GetParam().block * lit + kErrors * noise) << "block " << i;
  }
  EXPECT_LT(std::fabs(mean), kLeak * lit + kErrors * std::sqrt(variance));
  RecordProperty("share_of_lit", std::to_string(mean / lit));
  RecordProperty("worst_share_of_lit", std::to_string(worst));
  std::printf("dark part %+.2f %%, worst block %.2f %% of the lit part's mean\n", 100 * mean / lit, 100 * worst);
}

}  // namespace
}  // namespace radfarm
