#include "radiosity/refine.h"

#include <gtest/gtest.h>

#include "support/small_scenes.h"

namespace radfarm {
namespace {

struct Refined {
  Hierarchy hierarchy;
  NodePower reflected;
  std::vector<Link> links;
  std::size_t splits = 0;
};

Refined refine_once(const World& world, const RadiositySettings& settings) {
  Refined r;
  const SideNumbers sides(world.scene);
  r.hierarchy = build_hierarchy(world, sides, reachable_sides(world, sides, 1));
  r.reflected.resize(r.hierarchy.nodes.size());
  r.links = initial_links(world, r.hierarchy);
  r.splits = refine(world, r.hierarchy, r.reflected, r.links, settings, world.emitters.total_flux, 1);
  return r;
}

RadiositySettings coarse() {
  RadiositySettings settings;
  settings.max_link_error = 5e-3F;
  settings.min_patch_area = 5e-3F;
  return settings;
}

bool is_at_or_above(const Hierarchy& h, std::uint32_t ancestor, std::uint32_t node) {
  while (node != kNone && node != ancestor) node = h.nodes[node].parent;
  return node == ancestor;
}

TEST(Refine, StartsWithTheRootAndEveryPunctualLight) {
  const World world(test::own_scene("point_light"));
  const SideNumbers sides(world.scene);
  const Hierarchy h = build_hierarchy(world, sides, reachable_sides(world, sides, 1));
  const std::vector<Link> links = initial_links(world, h);
  ASSERT_EQ(links.size(), 2U);
  EXPECT_EQ(links[0].receiver, links[0].sender);
  EXPECT_EQ(links[1].sender, punctual_sender(0));
  EXPECT_TRUE(initial_links(world, Hierarchy()).empty());
}

TEST(Refine, EveryPairThatMayExchangeLightHasExactlyOneLink) {
  for (const char* name : {"emitters_reflect", "cornell"}) {
    const World world(test::own_scene(name));
    const Refined r = refine_once(world, coarse());
    const Hierarchy& h = r.hierarchy;
    EXPECT_GT(r.splits, 0U);
    for (const std::uint32_t receiver : h.leaves) {
      for (const std::uint32_t sender : h.leaves) {
        std::size_t whole = 0, parts = 0;
        for (const Link& link : r.links) {
          const bool over_receiver = is_at_or_above(h, link.receiver, receiver);
          const bool over_sender = is_at_or_above(h, link.sender, sender);
          whole += over_receiver && over_sender ? 1 : 0;
          parts += is_at_or_above(h, receiver, link.receiver) && is_at_or_above(h, sender, link.sender) ? 1 : 0;
        }
        EXPECT_LE(whole, 1U);
        if (receiver != sender && !cannot_see(h, receiver, sender)) {
          EXPECT_GE(whole + parts, 1U) << name;
        }
      }
    }
  }
}

TEST(Refine, KeepsTheErrorsOfItsLinksBelowTheLimit) {
  const World world(test::own_scene("cornell"));
  const RadiositySettings settings = coarse();
  const Refined r = refine_once(world, settings);
  const float smallest = settings.min_patch_area * r.hierarchy.nodes[0].area;
  const double limit = static_cast<double>(settings.max_link_error) * world.emitters.total_flux;
  for (const Link& link : r.links) {
    const Node& to = r.hierarchy.nodes[link.receiver];
    const Node& from = r.hierarchy.nodes[link.sender];
    const bool is_final = to.child_count == 0 && from.child_count == 0 && to.area <= 4 * smallest && from.area <= 4 * smallest;
    if (link.receiver == link.sender || is_final) continue;
    const double misplaced = static_cast<double>(max_component(to.reflectance) * to.area * link.emitted_error *
                                                 luminance(from.emitted_power));
    EXPECT_LT(misplaced, limit);
  }
}

TEST(Refine, StopsAtTheLargestNumberOfLinks) {
  const World world(test::own_scene("emitters_reflect"));
  RadiositySettings settings = coarse();
  settings.max_links = 100;
  // A split of both ends replaces one link by at most four, and by sixteen when patches are cut.
  EXPECT_LE(refine_once(world, settings).links.size(), 116U);
}

TEST(Refine, MeasuringAgainDropsOnlyLinksWithoutLight) {
  const World world(test::own_scene("cornell"));
  Refined r = refine_once(world, coarse());
  const std::size_t before = r.links.size();
  measure_again(world, r.hierarchy, r.reflected, r.links, coarse(), 1);
  EXPECT_LE(r.links.size(), before);
  for (const Link& link : r.links) EXPECT_GT(link.emitted + link.reflected, 0);
}

}  // namespace
}  // namespace radfarm
