#include "senders/sender_grid.h"

#include <algorithm>

#include <gtest/gtest.h>

#include "base/parallel.h"
#include "base/random.h"
#include "unit/senders/solved_scene.h"

namespace radfarm {
namespace {

using test::SolvedScene;

TEST(SenderGrid, RoundTripKeepsEveryByte) {
  const SolvedScene scene("cornell");
  const std::vector<std::byte> bytes = encode(scene.classify());
  const Result<SenderGridFile> again = decode_sender_grid(bytes, scene.camera(), scene.tree, scene.patches());
  ASSERT_TRUE(again) << again.error().message;
  EXPECT_EQ(encode(*again), bytes);
}

/// The Cornell box, which is open towards the camera, under an even sky.
Scene under_a_sky() {
  Scene scene = test::own_scene("cornell");
  scene.environment = {2, 1, {Spectrum(1.0F), Spectrum(1.0F)}, {}};
  return scene;
}

TEST(SenderGrid, KnowsTheSkyThatItsVerticesSee) {
  const SolvedScene scene(under_a_sky());
  ASSERT_GT(scene.patches(), 0U);
  const SenderGridFile file = scene.classify();
  bool is_hidden = false;
  for (const VertexSenders& senders : file.senders) {
    ASSERT_EQ(senders.sky.size(), scene.patches());
    for (const float seen : senders.sky) {
      EXPECT_TRUE(seen >= 0.25F && seen <= 1) << seen;
      is_hidden = is_hidden || seen < 0.3F;
    }
  }
  EXPECT_TRUE(is_hidden) << "most of the sky is behind walls";
  const std::vector<std::byte> bytes = encode(file);
  const Result<SenderGridFile> again = decode_sender_grid(bytes, scene.camera(), scene.tree, scene.patches());
  ASSERT_TRUE(again) << again.error().message;
  EXPECT_EQ(encode(*again), bytes);
  const auto other_sky = decode_sender_grid(bytes, scene.camera(), scene.tree, scene.patches() + 1);
  ASSERT_FALSE(other_sky);
  EXPECT_EQ(other_sky.error().code, Code::kDataLoss);
}

TEST(SenderGrid, HasTheSameBytesForAnyNumberOfThreads) {
  const SolvedScene scene("cornell");
  const auto with = [&](int threads) {
    const ThreadLimit limit(threads);
    return encode(scene.classify());
  };
  EXPECT_EQ(with(1), with(2));
}

TEST(SenderGrid, HasEveryVertexThatAVisiblePointInterpolates) {
  const SolvedScene scene("cornell");
  const SenderGridFile file = scene.classify();
  EXPECT_TRUE(std::is_sorted(file.vertices.begin(), file.vertices.end()));
  EXPECT_EQ(file.senders.size(), file.vertices.size());
  for (const ReceiverPoint& point : file.receivers.points) {
    const Interpolation at = interpolate(file.grid, point.position);
    for (std::size_t i = 0; i < 4; ++i) {
      EXPECT_TRUE(at.weights[i] <= 0 || std::binary_search(file.vertices.begin(), file.vertices.end(), at.vertices[i]));
    }
  }
}

TEST(SenderGrid, HostileBytesGiveDataLossOrAGrid) {
  const SolvedScene scene("plates");
  const std::vector<std::byte> bytes = encode(scene.classify());
  // Up to 63 bytes behind the last array are padding.
  for (std::size_t size = 0; size + 64 <= bytes.size(); size += 1 + size / 64) {
    const auto cut = decode_sender_grid(std::span(bytes).first(size), scene.camera(), scene.tree, scene.patches());
    ASSERT_FALSE(cut);
    EXPECT_EQ(cut.error().code, Code::kDataLoss);
  }
  RandomSequence random(1);
  for (int n = 0; n < 1000; ++n) {
    std::vector<std::byte> damaged = bytes;
    // Half of the damage goes to the header and the table of sections.
    const std::size_t reach = n % 2 == 0 ? std::min<std::size_t>(damaged.size(), 1024) : damaged.size();
    damaged[random.bits() % reach] ^= static_cast<std::byte>(1 + random.bits() % 255);
    const auto file = decode_sender_grid(damaged, scene.camera(), scene.tree, scene.patches());
    if (!file) continue;
    EXPECT_EQ(file->senders.size(), file->vertices.size());
    for (const std::uint32_t id : file->vertices) EXPECT_LT(id, file->grid.vertex_count());
  }
}

TEST(SenderGrid, ComputesVerticesThatTheFileLacksOnce) {
  const SolvedScene scene("cornell");
  SenderGridFile file = scene.classify();
  const std::vector<std::uint32_t> known = file.vertices;
  const std::size_t lobes = file.senders.back().lobes.size(), critical = file.senders.back().critical.size();
  const std::uint32_t dropped = file.vertices.back();
  file.vertices.pop_back();
  file.senders.pop_back();
  const SenderGrid grid(std::move(file), scene.world, scene.tree, scene.settings, 1);
  EXPECT_EQ(grid.computed(), 0U);
  (void)grid.at(known.front());
  EXPECT_EQ(grid.computed(), 0U);
  EXPECT_EQ(grid.at(dropped).lobes.size(), lobes);
  EXPECT_EQ(grid.at(dropped).critical.size(), critical);
  EXPECT_EQ(grid.computed(), 1U);
  EXPECT_EQ(&grid.at(dropped), &grid.at(dropped));
}

}  // namespace
}  // namespace radfarm
