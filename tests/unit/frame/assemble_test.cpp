#include "frame/assemble.h"

#include <cmath>

#include <gtest/gtest.h>

#include "frame/tasks.h"

namespace radfarm {
namespace {

Settings odd_size() {
  Settings settings;
  settings.width = 13, settings.height = 7, settings.tile = 4;
  return settings;
}

PixelSums sums_of(int x, int y) {
  PixelSums sums;
  const auto value = static_cast<float>(100 * y + x);
  for (int i = 0; i < 2; ++i) sums.add({Spectrum(value), Spectrum(1, 2, 3), Spectrum(0.5F), Spectrum(0.25F)});
  return sums;
}

std::vector<TileResult> all_tiles(const Settings& settings) {
  std::vector<TileResult> tiles;
  for (const Task& task : cut_tasks(settings, first_round(settings))) {
    TileResult tile;
    tile.rect = tile_rect(settings, task.index);
    tile.counters.camera_rays = 1;
    for (int y = tile.rect.y0; y < tile.rect.y1; ++y) {
      for (int x = tile.rect.x0; x < tile.rect.x1; ++x) tile.pixels.push_back(sums_of(x, y));
    }
    tiles.push_back(tile);
  }
  return tiles;
}

TEST(Assemble, PutsEveryPixelInItsPlaceAndAddsTheCounters) {
  const Settings settings = odd_size();
  const std::vector<TileResult> tiles = all_tiles(settings);
  const Result<Raster> raster = assemble(settings, tiles);
  ASSERT_TRUE(raster) << raster.error().message;
  for (int y = 0; y < 7; ++y) {
    for (int x = 0; x < 13; ++x) EXPECT_EQ(raster->pixels[static_cast<std::size_t>(y * 13 + x)], sums_of(x, y));
  }
  EXPECT_EQ(raster->counters.camera_rays, tiles.size());
}

TEST(Assemble, MissingOrRepeatedOrMisplacedTilesAreDataLoss) {
  const Settings settings = odd_size();
  const std::vector<TileResult> tiles = all_tiles(settings);
  for (std::size_t i = 0; i < tiles.size(); ++i) {
    std::vector<TileResult> missing = tiles, repeated = tiles;
    missing.erase(missing.begin() + static_cast<std::ptrdiff_t>(i));
    repeated[i] = tiles[(i + 1) % tiles.size()];
    EXPECT_EQ(assemble(settings, missing).error().code, Code::kDataLoss);
    EXPECT_EQ(assemble(settings, repeated).error().code, Code::kDataLoss);
  }
  std::vector<TileResult> one_more = tiles;
  one_more.push_back(tiles[0]);
  EXPECT_EQ(assemble(settings, one_more).error().code, Code::kDataLoss);
  EXPECT_EQ(assemble(settings, {}).error().code, Code::kDataLoss);
}

TEST(Assemble, AovsFollowTheirPixelsAndAreMissedWhereAskedFor) {
  Settings settings = odd_size();
  settings.aovs = set_of(Aov::kDepth);
  std::vector<TileResult> tiles = all_tiles(settings);
  EXPECT_EQ(assemble(settings, tiles).error().code, Code::kDataLoss);
  for (TileResult& tile : tiles) {
    for (const PixelSums& pixel : tile.pixels) tile.aovs.emplace_back().depth = pixel.emission.r;
  }
  const Result<Raster> raster = assemble(settings, tiles);
  ASSERT_TRUE(raster) << raster.error().message;
  for (std::size_t i = 0; i < raster->pixels.size(); ++i) EXPECT_EQ(raster->aovs[i].depth, raster->pixels[i].emission.r);
}

TEST(Assemble, LayersAddUpToTheImage) {
  const Settings settings = odd_size();
  const Image image = to_image(settings, *assemble(settings, all_tiles(settings)));
  EXPECT_EQ(image.width, 13);
  EXPECT_EQ(image.height, 7);
  for (const char* channel : {"R", "G", "B"}) {
    const std::string c = channel;
    for (std::size_t i = 0; i < image.pixel_count(); ++i) {
      const float sum = image.channels.at("emission." + c)[i] + image.channels.at("direct." + c)[i] +
                        image.channels.at("indirect." + c)[i] + image.channels.at("specular." + c)[i];
      EXPECT_FLOAT_EQ(image.channels.at(c)[i], sum);
    }
  }
  EXPECT_EQ(image.channels.at("direct.B")[20], 3);
}

TEST(Assemble, DroppedSamplesAreCountedAndNeverBlack) {
  const float nan = std::nanf("");
  PixelSums sums;
  sums.add({Spectrum(1.0F), Spectrum(1.0F), Spectrum(1.0F), Spectrum(1.0F)});
  for (const float bad : {nan, HUGE_VALF, -1.0F}) {
    sums.add({Spectrum(), Spectrum(bad), Spectrum(), Spectrum()});
    sums.add({Spectrum(), Spectrum(), Spectrum(), Spectrum(bad)});
  }
  EXPECT_EQ(sums.samples, 1U);
  EXPECT_EQ(sums.dropped, 6U);
  Settings settings;
  settings.width = 2, settings.height = 1;
  PixelSums lost;
  lost.add({Spectrum(nan), Spectrum(), Spectrum(), Spectrum()});
  const Raster raster{{sums, lost}, {}};
  EXPECT_EQ(dropped_share(raster), 0.875);
  const Image image = to_image(settings, raster);
  EXPECT_EQ(image.channels.at("R")[0], 4);
  EXPECT_TRUE(std::isnan(image.channels.at("R")[1]));
}

}  // namespace
}  // namespace radfarm
