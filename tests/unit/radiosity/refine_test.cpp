#include "radiosity/refine.h"

#include <algorithm>
#include <map>
#include <utility>

#include <gtest/gtest.h>

#include "base/random.h"
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

/// How many links carry light from one undivided node to another: links between any of their wholes.
std::size_t links_over(const std::map<std::pair<std::uint32_t, std::uint32_t>, std::size_t>& links, const Hierarchy& h,
                       std::uint32_t receiver, std::uint32_t sender) {
  std::size_t count = 0;
  for (std::uint32_t r = receiver; r != kNone; r = h.nodes[r].parent) {
    for (std::uint32_t s = sender; s != kNone; s = h.nodes[s].parent) {
      const auto found = links.find({r, s});
      count += found == links.end() ? 0 : found->second;
    }
  }
  return count;
}

TEST(Refine, StartsWithTheRootAndEveryPunctualLight) {
  const World world(test::own_scene("point_light"));
  const SideNumbers sides(world.scene);
  const Hierarchy h = build_hierarchy(world, sides, reachable_sides(world, sides, 1));
  const std::vector<Link> links = initial_links(world, h);
  ASSERT_EQ(links.size(), 2U);
  EXPECT_EQ(links[0].receiver, links[0].sender);
  EXPECT_EQ(links[1].sender, source_sender(0));
  EXPECT_TRUE(initial_links(world, Hierarchy()).empty());
}

TEST(Refine, EveryPairThatMayExchangeLightHasExactlyOneLink) {
  for (const char* name : {"emitters_reflect", "cornell"}) {
    const World world(test::own_scene(name));
    const Refined r = refine_once(world, coarse());
    const Hierarchy& h = r.hierarchy;
    EXPECT_GT(r.splits, 0U);
    std::map<std::pair<std::uint32_t, std::uint32_t>, std::size_t> links;
    for (const Link& link : r.links) ++links[{link.receiver, link.sender}];
    std::vector<std::uint32_t> undivided;
    for (std::uint32_t i = 0; i < h.nodes.size(); ++i) {
      if (h.nodes[i].child_count == 0) undivided.push_back(i);
    }
    RandomSequence random(1);
    for (int i = 0; i < 5000; ++i) {
      const std::uint32_t receiver = undivided[random.bits() % undivided.size()];
      const std::uint32_t sender = undivided[random.bits() % undivided.size()];
      const std::size_t count = links_over(links, h, receiver, sender);
      EXPECT_LE(count, 1U) << name << ": " << receiver << " from " << sender;
      if (receiver != sender && !cannot_see(h, receiver, sender)) {
        EXPECT_EQ(count, 1U) << name << ": " << receiver << " from " << sender;
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

double misplaced_by_all(const Refined& r) {
  double sum = 0;
  for (const Link& link : r.links) {
    const Node& to = r.hierarchy.nodes[link.receiver];
    sum += static_cast<double>(max_component(to.reflectance) * to.area * link.emitted_error *
                               luminance(r.hierarchy.nodes[link.sender].emitted_power));
  }
  return sum;
}

TEST(Refine, ABudgetOfLinksIsKeptAndSpentOnTheWorst) {
  const World world(test::own_scene("emitters_reflect"));
  RadiositySettings settings = coarse();
  settings.max_link_error = 1e-7F;
  settings.min_patch_area = 1e-5F;
  std::vector<double> misplaced;
  for (const std::uint32_t budget : {50U, 500U, 5000U}) {
    settings.max_links = budget;
    const Refined r = refine_once(world, settings);
    EXPECT_LE(r.links.size(), budget);
    // A level takes half of the room left, and stops when that is less than one split: a patch into four at both ends.
    EXPECT_GT(r.links.size(), budget - std::max(32U, budget / 10));
    misplaced.push_back(misplaced_by_all(r));
  }
  // An oracle of 10 lines is noisy: only budgets far apart are compared.
  EXPECT_LT(misplaced[2], 0.5 * misplaced[0]);
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
