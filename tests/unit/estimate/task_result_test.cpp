#include "estimate/task_result.h"

#include <gtest/gtest.h>

#include "base/random.h"

namespace radfarm {
namespace {

enum class With { kNothing, kAovs };

TileResult example(With with) {
  TileResult tile;
  tile.rect = {4, 0, 7, 2};
  tile.counters.camera_rays = 12;
  for (int i = 0; i < 6; ++i) {
    const auto x = static_cast<float>(i);
    tile.pixels.emplace_back().add({Spectrum(x), Spectrum(1.0F), Spectrum(), Spectrum()});
    if (with == With::kAovs) {
      tile.aovs.emplace_back().add({true, {}, {0, 0, 1}, Spectrum(x), Spectrum(2 * x), 3, 4, {1, 2, 3, 4}}, x);
    }
  }
  return tile;
}

TEST(TileResult, RoundTripKeepsEverythingWithAndWithoutAovs) {
  for (const With with : {With::kNothing, With::kAovs}) {
    const TileResult tile = example(with);
    const Result<TileResult> again = decode_tile_result(encode(tile));
    ASSERT_TRUE(again) << again.error().message;
    EXPECT_EQ(*again, tile);
    EXPECT_EQ(again->aovs.empty(), with == With::kNothing);
  }
}

TEST(TileResult, AovsCostNoByteAPixelWhereNobodyAsked) {
  const std::size_t without = encode(example(With::kNothing)).size(), with = encode(example(With::kAovs)).size();
  EXPECT_GE(with, without + 6 * sizeof(AovSums) - 64);
}

TEST(TileResult, PixelsOrAovsThatDoNotFillTheRectangleAreDataLoss) {
  TileResult short_of_pixels = example(With::kNothing), short_of_aovs = example(With::kAovs), many = example(With::kAovs);
  short_of_pixels.pixels.pop_back();
  short_of_aovs.aovs.pop_back();
  many.aovs.emplace_back();
  for (const TileResult& tile : {short_of_pixels, short_of_aovs, many}) {
    EXPECT_EQ(decode_tile_result(encode(tile)).error().code, Code::kDataLoss);
  }
}

TEST(TileResult, HostileBytesGiveDataLossOrATile) {
  const std::vector<std::byte> bytes = encode(example(With::kAovs));
  for (std::size_t size = 0; size < bytes.size(); ++size) {
    const Result<TileResult> tile = decode_tile_result(std::span(bytes).first(size));
    EXPECT_TRUE(tile || tile.error().code == Code::kDataLoss) << size;
  }
  RandomSequence random(1);
  for (int n = 0; n < 3000; ++n) {
    std::vector<std::byte> damaged = bytes;
    damaged[random.bits() % 400] ^= static_cast<std::byte>(1 + random.bits() % 255);
    const Result<TileResult> tile = decode_tile_result(damaged);
    if (!tile) continue;
    EXPECT_TRUE(tile->aovs.empty() || tile->aovs.size() == tile->pixels.size());
  }
}

}  // namespace
}  // namespace radfarm
