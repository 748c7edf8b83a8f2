#include "radiosity/links.h"

#include <array>
#include <cmath>
#include <numbers>

#include <gtest/gtest.h>

#include "math/statistics.h"
#include "support/small_scenes.h"
#include "support/statistics.h"

namespace radfarm {
namespace {

constexpr double kPlates = 0.1998248957;  // F between opposite faces of a unit cube, ALGORITHMS O1

Hierarchy all_sides(const World& world) {
  const SideNumbers sides(world.scene);
  return build_hierarchy(world, sides, std::vector<bool>(sides.count, true));
}

TEST(Links, PunctualSendersAreTheirOwnNumbers) {
  for (const std::uint32_t light : {0U, 1U, 77U, 1000000U}) {
    EXPECT_TRUE(is_source(source_sender(light)));
    EXPECT_EQ(source_index(source_sender(light)), light);
    EXPECT_NE(source_sender(light), kNone);
    EXPECT_FALSE(is_source(light));
  }
}

TEST(Links, TwoPlatesExchangeTheirFormFactor) {
  // Sum over the triangle pairs that face each other of factor x A_receiver x power = F x total power.
  const World world(test::own_scene("plates"));
  const Hierarchy h = all_sides(world);
  RunningStatistics received;
  for (std::uint64_t seed = 0; seed < 300; ++seed) {
    double arrived = 0, sent = 0;
    for (const std::uint32_t sender : h.leaves) {
      const auto power = static_cast<double>(luminance(h.nodes[sender].emitted_power));
      sent += power;
      if (power == 0) continue;
      for (const std::uint32_t receiver : h.leaves) {
        if (cannot_see(h, receiver, sender)) continue;
        const Link link = evaluate_link(world, h, receiver, sender, kEmittedPart, 16, seed);
        EXPECT_EQ(link.visibility, 1);
        arrived += static_cast<double>(link.emitted * h.nodes[receiver].area) * power;
      }
    }
    received.add(arrived / sent);
  }
  EXPECT_GT(test::z_test(received.mean(), received.standard_error(), kPlates), 1e-6)
      << received.mean() << " +- " << received.standard_error();
}

TEST(Links, WhatCannotBeSeenCarriesNothing) {
  const World world(test::own_scene("cornell"));
  Hierarchy h = all_sides(world);
  std::size_t dark = 0;
  for (std::uint32_t a = 0; a < h.nodes.size(); a += 3) {
    for (const std::uint32_t b : h.leaves) {
      if (a == b || luminance(h.nodes[b].emitted_power) == 0 || !cannot_see(h, a, b)) continue;
      ++dark;
      EXPECT_EQ(evaluate_link(world, h, a, b, kEmittedPart, 32, 1).emitted, 0);
    }
    EXPECT_EQ(cannot_see(h, a, h.leaves[0]), cannot_see(h, h.leaves[0], a));
  }
  EXPECT_GT(dark, 0U);
}

TEST(Links, ABlockedLinkIsDark) {
  test::SceneMaker maker;
  const std::uint32_t wall = maker.material(Spectrum(0.5F)), light = maker.material(Spectrum(), Spectrum(1.0F));
  maker.polygon(light, {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}});          // shines towards +z
  maker.polygon(wall, {{0, 0, 2}, {0, 1, 2}, {1, 0, 2}});           // looks back
  maker.polygon(wall, {{-9, -9, 1}, {9, -9, 1}, {9, 9, 1}, {-9, 9, 1}});
  const World world(maker.take());
  const Hierarchy h = all_sides(world);
  std::uint32_t sender = kNone, receiver = kNone;
  for (const std::uint32_t leaf : h.leaves) {
    const Patch& patch = h.patches[h.nodes[leaf].patch];
    if (!is_black(patch.emission)) sender = leaf;
    if (patch.vertices[0].z == 2 && patch.normal.z < 0) receiver = leaf;
  }
  ASSERT_NE(sender, kNone);
  ASSERT_NE(receiver, kNone);
  const Link link = evaluate_link(world, h, receiver, sender, kEmittedPart, 32, 1);
  EXPECT_EQ(link.emitted, 0);
  EXPECT_EQ(link.visibility, 0);
  EXPECT_NEAR(link.occluder_distance, 1, 0.8);  // between 1 and sqrt(3) along a slanted line
  EXPECT_EQ(link.evaluated, kEmittedPart);
}

TEST(Links, ThePointLightsMeanOverTheFloorIsItsFlux) {
  // Mean irradiance over a square from height h = flux through it / area: 4 atan(a^2 / (h sqrt(2 a^2 + h^2))) sr x I.
  const World world(test::own_scene("point_light"));
  const Hierarchy h = all_sides(world);
  const double omega = 4 * std::atan(25 / (2 * std::sqrt(54.0)));
  RunningStatistics flux;
  for (std::uint64_t seed = 0; seed < 200; ++seed) {
    double sum = 0;
    for (const std::uint32_t leaf : h.leaves) {
      if (h.patches[h.nodes[leaf].patch].normal.y < 0) continue;
      sum += static_cast<double>(evaluate_source(world, h, leaf, 0, 64, seed).emitted * h.nodes[leaf].area);
    }
    flux.add(sum);
  }
  EXPECT_GT(test::z_test(flux.mean(), flux.standard_error(), 100 * omega), 1e-6)
      << flux.mean() << " +- " << flux.standard_error() << " should be " << 100 * omega;
}

}  // namespace
}  // namespace radfarm
