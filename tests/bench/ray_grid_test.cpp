#include "bench/ray_grid.h"

#include <algorithm>

#include <gtest/gtest.h>

#include "bench/path_scenes.h"
#include "paths/photon_path.h"

namespace radfarm::bench {
namespace {

std::vector<Piece> pieces_of(const World& world, std::uint64_t paths) {
  std::vector<Piece> pieces;
  follow_batch(
      world, {1, 0, paths},
      [&](const Segment& s) {
        pieces.push_back({s.ray, s.begin, s.end});
      },
      [] {});
  return pieces;
}

using Pair = std::pair<std::uint32_t, std::uint32_t>;  // disc, piece

TEST(RayGrid, FindsTheCrossingsThatATestOfAllFinds) {
  const World world(paper_room());
  const Components components(world.scene);
  const std::vector<Disc> all = paper_discs(world, components);
  ASSERT_EQ(all.size(), 46701U);
  std::vector<OrientedDisc> discs;
  for (std::size_t i = 0; i < all.size(); i += 100) discs.push_back(all[i].shape);
  const std::vector<Piece> pieces = pieces_of(world, 2000);
  std::vector<Pair> truth;
  for (std::uint32_t d = 0; d < discs.size(); ++d) {
    for (std::uint32_t p = 0; p < pieces.size(); ++p) {
      if (crosses(pieces[p], discs[d])) truth.emplace_back(d, p);
    }
  }
  EXPECT_GT(truth.size(), 200U);
  for (const RayGridSettings settings : {RayGridSettings{1, 1}, RayGridSettings{4, 8}, RayGridSettings{24, 32}}) {
    const RayGrid grid(pieces, {0, 0, 0}, 10.1, settings);
    std::vector<Pair> found;
    for (std::uint32_t d = 0; d < discs.size(); ++d) {
      grid.crossed(discs[d], [&](std::uint32_t piece) { found.emplace_back(d, piece); });
    }
    std::sort(found.begin(), found.end());
    EXPECT_EQ(found, truth) << settings.rings;
  }
  // And the discs in Embree.
  struct Query {
    const Piece& piece;
    const std::vector<OrientedDisc>& discs;
    std::vector<Pair>& found;
    std::uint32_t number;
  };
  std::vector<Pair> found;
  const DiscCaster caster(discs);
  for (std::uint32_t p = 0; p < pieces.size(); ++p) {
    Query query{pieces[p], discs, found, p};
    const auto visit = [](void* user, std::uint32_t disc) {
      const Query& q = *static_cast<Query*>(user);
      if (crosses(q.piece, q.discs[disc])) q.found.emplace_back(disc, q.number);
    };
    caster.crossed(pieces[p].ray, pieces[p].begin, pieces[p].end * (1 + 1e-4F), visit, &query);
  }
  std::sort(found.begin(), found.end());
  EXPECT_EQ(found, truth);
}

}  // namespace
}  // namespace radfarm::bench
