#include "image/png.h"

#include <array>
#include <cstdint>
#include <limits>

#include <gtest/gtest.h>
#include <png.h>

namespace radfarm {
namespace {

std::vector<std::uint8_t> decoded(const std::vector<std::byte>& bytes) {
  png_image png{};
  png.version = PNG_IMAGE_VERSION;
  EXPECT_NE(png_image_begin_read_from_memory(&png, bytes.data(), bytes.size()), 0);
  EXPECT_EQ(png.format, static_cast<png_uint_32>(PNG_FORMAT_RGB));
  std::vector<std::uint8_t> pixels(PNG_IMAGE_SIZE(png));
  EXPECT_NE(png_image_finish_read(&png, nullptr, pixels.data(), 0, nullptr), 0);
  return pixels;
}

Image image_of(const std::vector<std::array<float, 3>>& pixels) {
  Image image;
  image.width = static_cast<int>(pixels.size());
  image.height = 1;
  for (const auto& [r, g, b] : pixels) {
    image.channels["R"].push_back(r);
    image.channels["G"].push_back(g);
    image.channels["B"].push_back(b);
  }
  return image;
}

TEST(Png, KnownPixels) {
  constexpr float kInfinity = std::numeric_limits<float>::infinity();
  constexpr float kNan = std::numeric_limits<float>::quiet_NaN();
  const Image image = image_of({{0, 1, 0.5F}, {0.18F, 0.0031308F, 2}, {-1, kInfinity, 0}, {0, kNan, 0}});
  const std::vector<std::uint8_t> expected = {0, 255, 188, 118, 10, 255, 0, 255, 0, 255, 0, 255};
  EXPECT_EQ(decoded(encode_png(image, 0).value()), expected);
}

TEST(Png, ExposureIsInStops) {
  EXPECT_EQ(decoded(encode_png(image_of({{0.25F, 0.5F, 0.125F}}), 1).value()),
            decoded(encode_png(image_of({{0.5F, 1, 0.25F}}), 0).value()));
}

TEST(Png, ImageWithoutRgbIsRefused) {
  Image image = image_of({{0, 0, 0}});
  image.channels.erase("G");
  EXPECT_EQ(encode_png(image, 0).error().code, Code::kInvalidArgument);
}

}  // namespace
}  // namespace radfarm
