#include "image/exr.h"

#include <bit>
#include <cstdint>
#include <cstring>
#include <filesystem>
#include <limits>
#include <string>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "base/file.h"
#include "base/random.h"

namespace radfarm {
namespace {

Image example(int width, int height) {
  Image image;
  image.width = width;
  image.height = height;
  RandomSequence random(1);
  for (const char* name : {"R", "G", "B", "direct.R", "depth.Z"}) {
    std::vector<float>& values = image.channels[name];
    for (std::size_t i = 0; i < image.pixel_count(); ++i) values.push_back(random.uniform() * 100);
  }
  image.attributes["radfarm.scene"] = "0123abc";
  image.attributes["comments"] = "two\nlines, caf\xc3\xa9";
  return image;
}

std::vector<std::uint32_t> bits_of(const std::vector<float>& values) {
  std::vector<std::uint32_t> bits;
  for (const float value : values) bits.push_back(std::bit_cast<std::uint32_t>(value));
  return bits;
}

TEST(Exr, RoundTripKeepsEveryBitAndAttribute) {
  for (const auto& [width, height] : {std::pair{1, 1}, std::pair{37, 41}, std::pair{64, 3}}) {
    const Image image = example(width, height);
    const Image read = decode_exr(encode_exr(image).value()).value();
    EXPECT_EQ(read.width, width);
    EXPECT_EQ(read.height, height);
    EXPECT_EQ(read.attributes, image.attributes);
    ASSERT_EQ(read.channels.size(), image.channels.size());
    for (const auto& [name, values] : image.channels) EXPECT_EQ(bits_of(read.channels.at(name)), bits_of(values)) << name;
  }
}

TEST(Exr, NotANumberInfinityAndMinusZeroAreKept) {
  Image image = example(2, 2);
  image.channels["R"] = {std::bit_cast<float>(0x7fc12345U), std::numeric_limits<float>::infinity(), -0.0F,
                         std::numeric_limits<float>::denorm_min()};
  const Image read = decode_exr(encode_exr(image).value()).value();
  EXPECT_EQ(bits_of(read.channels.at("R")), bits_of(image.channels["R"]));
}

TEST(Exr, SameImageGivesTheSameBytes) { EXPECT_EQ(encode_exr(example(50, 20)).value(), encode_exr(example(50, 20)).value()); }

TEST(Exr, HeaderStatesRec709) {
  const std::vector<std::byte> bytes = encode_exr(example(4, 4)).value();
  const std::string_view text(reinterpret_cast<const char*>(bytes.data()), bytes.size());
  const std::size_t at = text.find(std::string_view("chromaticities\0chromaticities\0", 30));
  ASSERT_NE(at, std::string_view::npos);
  float primaries[8];
  std::memcpy(primaries, text.data() + at + 34, sizeof primaries);
  EXPECT_THAT(primaries, testing::ElementsAre(0.64F, 0.33F, 0.30F, 0.60F, 0.15F, 0.06F, 0.3127F, 0.3290F));
}

TEST(Exr, UnusableImagesAreRefused) {
  EXPECT_EQ(encode_exr(Image()).error().code, Code::kInvalidArgument);
  Image image = example(4, 4);
  image.channels["R"].pop_back();
  EXPECT_THAT(encode_exr(image).error().message, testing::HasSubstr("'R'"));
  image = example(4, 4);
  image.attributes["dataWindow"] = "not a string";
  EXPECT_EQ(encode_exr(image).error().code, Code::kInvalidArgument);
}

TEST(Exr, EveryTruncationIsAnError) {
  const std::vector<std::byte> whole = encode_exr(example(9, 40)).value();
  for (std::size_t size = 0; size < whole.size(); size += size < 600 ? 1 : 97) {
    EXPECT_FALSE(decode_exr(std::span(whole).first(size))) << size;
  }
}

TEST(Exr, DamagedBytesAreSafe) {
  const std::vector<std::byte> whole = encode_exr(example(9, 40)).value();
  RandomSequence random(2);
  for (int i = 0; i < 3000; ++i) {
    std::vector<std::byte> damaged = whole;
    for (std::uint64_t k = random.bits() % 3 + 1; k > 0; --k) {
      const std::uint64_t range = i % 2 == 0 ? 600 : damaged.size();
      damaged[random.bits() % range] = std::byte{static_cast<unsigned char>(random.bits())};
    }
    (void)decode_exr(damaged);  // an error or an image, never a crash
  }
}

TEST(Exr, FilesThatOnceCrashedOpenExrAreErrors) {
  int files = 0;
  const auto folder = std::filesystem::path(RADFARM_SOURCE_DIR) / "tests/unit/image/damaged_exr";
  for (const auto& entry : std::filesystem::directory_iterator(folder)) {
    if (entry.path().extension() != ".exr") continue;
    ++files;
    const std::string bytes = read_file(entry.path(), 10'000).value();
    EXPECT_FALSE(decode_exr(std::as_bytes(std::span(bytes)))) << entry.path();
  }
  EXPECT_GE(files, 20);
}

TEST(Exr, HugeClaimsAreRefusedBeforeAllocating) {
  std::vector<std::byte> bytes = encode_exr(example(4, 4)).value();
  const std::string_view text(reinterpret_cast<const char*>(bytes.data()), bytes.size());
  const std::size_t window = text.find(std::string_view("dataWindow\0box2i\0", 17)) + 17 + 4;
  const auto claim = [&](std::int32_t right, std::int32_t bottom) {
    std::memcpy(bytes.data() + window + 8, &right, 4);
    std::memcpy(bytes.data() + window + 12, &bottom, 4);
    return decode_exr(bytes);
  };
  EXPECT_FALSE(claim(2'000'000'000, 2'000'000'000));
  EXPECT_FALSE(claim(16'383, 16'383));
  EXPECT_FALSE(claim(-5, 3));
  EXPECT_TRUE(claim(3, 3));
}

TEST(Exr, OtherFilesAreNotOpenExr) {
  EXPECT_EQ(decode_exr({}).error().code, Code::kDataLoss);
  const std::string text = "PNG or anything else";
  EXPECT_EQ(decode_exr(std::as_bytes(std::span(text))).error().code, Code::kDataLoss);
}

}  // namespace
}  // namespace radfarm
