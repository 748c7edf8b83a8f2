#include "frame/view.h"

#include <gtest/gtest.h>

#include "base/random.h"
#include "scene/limits.h"

namespace radfarm {
namespace {

std::vector<std::byte> encode_one(const View& view) { return encode(std::span(&view, 1)); }

Result<View> decode_one(std::span<const std::byte> bytes) {
  return decode_views(bytes).map([](std::vector<View> views) { return std::move(views.at(0)); });
}

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
  const std::vector<std::byte> bytes = encode_one(example());
  const Result<View> view = decode_one(bytes);
  ASSERT_TRUE(view) << view.error().message;
  EXPECT_EQ(encode_one(*view), bytes);
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
  const std::vector<std::byte> bytes = encode_one(example());
  for (std::size_t size = 0; size < bytes.size(); ++size) {
    const Result<View> view = decode_one(std::span(bytes).first(size));
    // What lies behind the last array is padding: a view without it is the same view.
    EXPECT_TRUE(!view || encode_one(*view) == bytes) << size;
    EXPECT_TRUE(view || view.error().code == Code::kDataLoss) << size;
    EXPECT_TRUE(!view || size + 64 > bytes.size()) << size;
  }
  RandomSequence random(1);
  for (int n = 0; n < 5000; ++n) {
    std::vector<std::byte> damaged = bytes;
    damaged[random.bits() % damaged.size()] ^= static_cast<std::byte>(1 + random.bits() % 255);
    const Result<View> view = decode_one(damaged);
    if (!view) continue;
    const Settings& s = view->settings;
    EXPECT_TRUE(s.width >= 1 && s.width <= 16384 && s.height >= 1 && s.height <= 16384 && s.tile >= 1);
  }
}

TEST(View, RefusesAovsThatItDoesNotKnow) {
  View view = example();
  view.settings.aovs = (AovSet{1} << kAovCount) - 1;
  EXPECT_EQ(decode_one(encode_one(view))->settings.aovs, view.settings.aovs);
  view.settings.aovs = AovSet{1} << kAovCount;
  EXPECT_EQ(decode_one(encode_one(view)).error().code, Code::kDataLoss);
}

TEST(View, RefusesSizesOutOfRange) {
  for (const int size : {0, -1, 16385}) {
    View wide = example(), tiled = example();
    wide.settings.width = size;
    tiled.settings.tile = size;
    EXPECT_EQ(decode_one(encode_one(wide)).error().code, Code::kDataLoss);
    EXPECT_EQ(decode_one(encode_one(tiled)).error().code, Code::kDataLoss);
  }
}

TEST(View, OfLightGroupsGoesTogether) {
  std::vector<View> views(3, example());
  views[0].light_group = "a", views[1].light_group = "b", views[2].light_group = "c";
  views[1].settings.seed = 5, views[1].grid.clear();
  const Result<std::vector<View>> again = decode_views(encode(views));
  ASSERT_TRUE(again) << again.error().message;
  EXPECT_EQ(encode(*again), encode(views));
  EXPECT_EQ(again->at(1).light_group, "b");
  const auto refused = [](const std::vector<View>& some) { return decode_views(encode(some)).error().code == Code::kDataLoss; };
  EXPECT_TRUE(refused({}));
  EXPECT_TRUE(refused(std::vector<View>(limits::kLightGroups + 1, views[0])));
  std::vector<View> unnamed = views, larger = views, other = views;
  unnamed[2].light_group.clear();
  ++larger[1].settings.width;
  other[1].settings.integrator = Settings::Integrator::kPathTrace;
  EXPECT_TRUE(refused(unnamed));
  EXPECT_TRUE(refused(larger));
  EXPECT_TRUE(refused(other));
}

}  // namespace
}  // namespace radfarm
