#include "image/digest.h"

#include <gtest/gtest.h>

#include "base/digest.h"
#include "image/exr.h"

namespace radfarm {
namespace {

Image example() { return {2, 1, {{"R", {1, 2}}, {"G", {3, 4}}}, {}}; }

TEST(ImageDigest, CoversSizeNamesAndFloatsOnly) {
  const std::string digest = image_digest(example());
  EXPECT_TRUE(is_sha256_hex(digest));
  Image image = example();
  image.attributes.emplace("host", "a");
  EXPECT_EQ(image_digest(image), digest);
  image.channels["G"][1] = -4;
  EXPECT_NE(image_digest(image), digest);
  image = example();
  image.channels["GG"] = image.channels["G"];
  image.channels.erase("G");
  EXPECT_NE(image_digest(image), digest);
  image = example();
  std::swap(image.width, image.height);
  EXPECT_NE(image_digest(image), digest);
}

TEST(ImageDigest, SurvivesAFile) {
  EXPECT_EQ(image_digest(decode_exr(encode_exr(example()).value()).value()), image_digest(example()));
}

// docs/formats.md: width and height as 32-bit little-endian, then each channel's name, a zero byte and its floats.
TEST(ImageDigest, BytesAreThoseOfTheFormat) {
  const std::string bytes("\x01\0\0\0\x01\0\0\0R\0\0\0\x80\x3f", 14);
  EXPECT_EQ(image_digest({1, 1, {{"R", {1}}}, {}}), sha256_hex(bytes));
}

}  // namespace
}  // namespace radfarm
