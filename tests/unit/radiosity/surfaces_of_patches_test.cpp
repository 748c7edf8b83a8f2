#include "radiosity/surfaces_of_patches.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <set>

#include <gtest/gtest.h>

#include "base/random.h"

namespace radfarm {
namespace {

Patch patch_of(const Vec3& a, const Vec3& b, const Vec3& c, std::uint32_t instance = 0) {
  Patch patch;
  patch.vertices = {a, b, c};
  const Vec3 normal = cross(b - a, c - a);
  patch.normal = length(normal) > 0 ? normalize(normal) : Vec3(0, 0, 1);
  patch.instance = instance;
  return patch;
}

/// Both sides of a triangle.
void add(std::vector<Patch>& patches, const Vec3& a, const Vec3& b, const Vec3& c, std::uint32_t instance = 0) {
  patches.push_back(patch_of(a, b, c, instance));
  patches.push_back(patch_of(a, c, b, instance));
}

/// A sheet from the y axis, turned about it.
void add_sheet(std::vector<Patch>& patches, float degrees) {
  const float angle = degrees * std::numbers::pi_v<float> / 180;
  const Vec3 out(std::cos(angle), 0, std::sin(angle));
  add(patches, {0, 0, 0}, out, {0, 1, 0});
}

std::size_t count_of(const std::vector<std::uint32_t>& surfaces) { return std::set(surfaces.begin(), surfaces.end()).size(); }

TEST(SurfacesOfPatches, AnEvenSheetHasTwoWhateverItsWindingAndOrder) {
  for (std::uint64_t seed = 0; seed < 20; ++seed) {
    RandomSequence random(seed);
    std::vector<Patch> patches;
    for (int i = 0; i < 8; ++i) {
      for (int j = 0; j < 8; ++j) {
        // -0 is the same place as 0.
        const auto at = [&](int x, int y) { return Vec3(static_cast<float>(x), static_cast<float>(y), random.uniform() < 0.5F ? 0.0F : -0.0F); };
        random.uniform() < 0.5F ? add(patches, at(i, j), at(i + 1, j), at(i + 1, j + 1)) : add(patches, at(i + 1, j), at(i, j), at(i + 1, j + 1));
        add(patches, at(i, j), at(i + 1, j + 1), at(i, j + 1));
      }
    }
    for (std::size_t i = patches.size(); i-- > 1;) std::swap(patches[i], patches[random.bits() % (i + 1)]);
    const std::vector<std::uint32_t> surfaces = surfaces_of_patches(patches);
    EXPECT_EQ(count_of(surfaces), 2U);
    for (std::size_t i = 0; i < patches.size(); ++i) EXPECT_EQ(surfaces[i] == surfaces[0], patches[i].normal.z * patches[0].normal.z > 0);
  }
}

TEST(SurfacesOfPatches, SharpFoldsAndOtherInstancesPart) {
  for (const float degrees : {0.0F, 20.0F, 24.0F, 26.0F, 90.0F, 170.0F}) {  // 180: folded back onto itself
    std::vector<Patch> patches;
    add_sheet(patches, 0);
    add_sheet(patches, 180 - degrees);
    EXPECT_EQ(count_of(surfaces_of_patches(patches)), degrees < 25 ? 2U : 4U) << degrees;
    patches[2].instance = patches[3].instance = 1;
    EXPECT_EQ(count_of(surfaces_of_patches(patches)), 4U) << degrees;
  }
}

TEST(SurfacesOfPatches, ARoundBodyBecomesSeveral) {
  std::vector<Patch> patches;
  constexpr int kSteps = 72;  // of 5 degrees: every fold is flat enough, the whole ring is not
  const auto at = [](int i, float y) {
    const float angle = 2 * std::numbers::pi_v<float> * static_cast<float>(i % kSteps) / kSteps;
    return Vec3(std::cos(angle), y, std::sin(angle));
  };
  for (int i = 0; i < kSteps; ++i) {
    patches.push_back(patch_of(at(i, 0), at(i + 1, 0), at(i + 1, 1)));
    patches.push_back(patch_of(at(i, 0), at(i + 1, 1), at(i, 1)));
  }
  const std::vector<std::uint32_t> surfaces = surfaces_of_patches(patches);
  // Two neighbours' mean normals turn by 25 degrees or more, or they were one: at most 14 of them, and none goes half around.
  EXPECT_GE(count_of(surfaces), 3U);
  EXPECT_LE(count_of(surfaces), 14U);
}

TEST(SurfacesOfPatches, EdgesOfManyTrianglesJoinWhatIsFlat) {
  std::vector<Patch> cross_section;
  for (const float degrees : {0.0F, 90.0F, 180.0F, 270.0F}) add_sheet(cross_section, degrees);
  EXPECT_EQ(count_of(surfaces_of_patches(cross_section)), 4U);  // two planes, two sides
}

TEST(SurfacesOfPatches, DoubledTrianglesAreJoinedByTheirNeighbours) {
  std::vector<Patch> patches;
  for (int i = 0; i < 3; ++i) add_sheet(patches, 0), add_sheet(patches, 180);
  EXPECT_EQ(count_of(surfaces_of_patches(patches)), 2U);
  for (int i = 0; i < 1000; ++i) add_sheet(patches, 0);  // too many to compare all: no error, and no quadratic time
  EXPECT_LE(count_of(surfaces_of_patches(patches)), patches.size());
}

TEST(SurfacesOfPatches, SidesWithoutAreaStayAlone) {
  std::vector<Patch> patches;
  add_sheet(patches, 0);
  add_sheet(patches, 180);
  patches.push_back(patch_of({0, 0, 0}, {0, 1, 0}, {0, 1, 0}));
  patches.push_back(patch_of({0, 0, 0}, {0, 0.5F, 0}, {0, 1, 0}));
  patches.push_back(patch_of({0, 0, 0}, {0, 0, 0}, {0, 0, 0}));
  const std::vector<std::uint32_t> surfaces = surfaces_of_patches(patches);
  EXPECT_EQ(count_of(surfaces), 5U);
  EXPECT_EQ(*std::max_element(surfaces.begin(), surfaces.end()), 4U);
  EXPECT_TRUE(surfaces_of_patches({}).empty());
}

}  // namespace
}  // namespace radfarm
