#include "frame/view.h"

#include <gtest/gtest.h>

#include "base/random.h"

namespace radfarm {
namespace {

View example() {
  View view;
  view.camera.position = {1, 2, 3};
  view.camera.vertical_fov = 0.5F;
  view.camera.lens_diameter = 0.02F, view.camera.focus_distance = 3;
  view.settings.width = 640, view.settings.height = 480;
  view.settings.seed = 18446744073709551615U;
  view.settings.effects_off = 0x1234, view.settings.exactly_off = 0x1030;
  view.settings.senders.threshold = 0.25F;
  view.facts = R"({"warnings": []})";
  view.grid = {std::byte{1}, std::byte{2}, std::byte{255}};
  view.elevation = {2, 1, {1.5F, 10}};
  return view;
}

TEST(View, RoundTripKeepsEveryByte) {
  const std::vector<std::byte> bytes = encode(example());
  const Result<View> view = decode_view(bytes);
  ASSERT_TRUE(view) << view.error().message;
  EXPECT_EQ(encode(*view), bytes);
  EXPECT_EQ(view->camera.position, Vec3(1, 2, 3));
  EXPECT_EQ(view->camera.lens_diameter, 0.02F);
  EXPECT_EQ(view->camera.focus_distance, 3);
  EXPECT_EQ(view->settings.effects_off, 0x1234U);
  EXPECT_EQ(view->settings.exactly_off, 0x1030U);
  EXPECT_EQ(view->settings.seed, example().settings.seed);
  EXPECT_EQ(view->facts, example().facts);
  EXPECT_EQ(view->grid, example().grid);
  EXPECT_EQ(view->elevation.values, example().elevation.values);
}

TEST(View, TruncatedOrDamagedBytesGiveDataLossOrASaneView) {
  const std::vector<std::byte> bytes = encode(example());
  for (std::size_t size = 0; size < bytes.size(); ++size) {
    const Result<View> view = decode_view(std::span(bytes).first(size));
    // What lies behind the last array is padding: a view without it is the same view.
    EXPECT_TRUE(!view || encode(*view) == bytes) << size;
    EXPECT_TRUE(view || view.error().code == Code::kDataLoss) << size;
    EXPECT_TRUE(!view || size + 64 > bytes.size()) << size;
  }
  RandomSequence random(1);
  for (int n = 0; n < 5000; ++n) {
    std::vector<std::byte> damaged = bytes;
    damaged[random.bits() % damaged.size()] ^= static_cast<std::byte>(1 + random.bits() % 255);
    const Result<View> view = decode_view(damaged);
    if (!view) continue;
    const Settings& s = view->settings;
    EXPECT_TRUE(s.width >= 1 && s.width <= 16384 && s.height >= 1 && s.height <= 16384 && s.tile >= 1);
  }
}

TEST(View, RefusesAovsThatItDoesNotKnow) {
  View view = example();
  view.settings.aovs = (AovSet{1} << kAovCount) - 1;
  EXPECT_EQ(decode_view(encode(view))->settings.aovs, view.settings.aovs);
  view.settings.aovs = AovSet{1} << kAovCount;
  EXPECT_EQ(decode_view(encode(view)).error().code, Code::kDataLoss);
}

TEST(View, RefusesSizesOutOfRange) {
  for (const int size : {0, -1, 16385}) {
    View wide = example(), tiled = example();
    wide.settings.width = size;
    tiled.settings.tile = size;
    EXPECT_EQ(decode_view(encode(wide)).error().code, Code::kDataLoss);
    EXPECT_EQ(decode_view(encode(tiled)).error().code, Code::kDataLoss);
  }
}

}  // namespace
}  // namespace radfarm
