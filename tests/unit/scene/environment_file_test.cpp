#include "scene/environment_file.h"

#include <cmath>
#include <cstdlib>
#include <limits>
#include <optional>
#include <string>

#include <gmock/gmock.h>

#include "base/file.h"
#include "image/exr.h"
#include "scene/environment_light.h"
#include "scene/radiance_hdr.h"

namespace radfarm {
namespace {

using testing::HasSubstr;

std::string text_of(const std::vector<std::byte>& bytes) {
  return {reinterpret_cast<const char*>(bytes.data()), bytes.size()};
}

std::string hdr(const std::string& pixels, const std::string& size,
                const std::string& lines = "FORMAT=32-bit_rle_rgbe\n") {
  return "#?RADIANCE\n" + lines + "\n" + size + "\n" + pixels;
}

std::string rgbe(int r, int g, int b, int e) {
  return {static_cast<char>(r), static_cast<char>(g), static_cast<char>(b), static_cast<char>(e)};
}

/// Row 0: 1, 2, 3, 4 and row 1: 5, 6, 7, 8 in red; green half of it, blue 0.
std::string flat_pixels() {
  std::string pixels;
  for (int i = 1; i <= 8; ++i) pixels += rgbe(16 * i, 8 * i, 0, 132);
  return pixels;
}

float red(const Result<HdrImage>& image, std::size_t i) { return image->pixels.at(i).r; }

TEST(RadianceHdr, ReadsFlatPixels) {
  const Result<HdrImage> image = decode_radiance_hdr(hdr(flat_pixels(), "-Y 2 +X 4"));
  ASSERT_TRUE(image) << image.error().message;
  EXPECT_EQ(image->width, 4U);
  EXPECT_EQ(image->height, 2U);
  EXPECT_EQ(image->pixels[0], Spectrum(1, 0.5F, 0));
  EXPECT_EQ(image->pixels[7], Spectrum(8, 4, 0));
}

TEST(RadianceHdr, ReadsEveryOrderOfRowsAndColumns) {
  EXPECT_EQ(red(decode_radiance_hdr(hdr(flat_pixels(), "+Y 2 +X 4")), 0), 5);
  EXPECT_EQ(red(decode_radiance_hdr(hdr(flat_pixels(), "-Y 2 -X 4")), 0), 4);
  EXPECT_EQ(red(decode_radiance_hdr(hdr(flat_pixels(), "+Y 2 -X 4")), 0), 8);
}

TEST(RadianceHdr, DividesByItsExposures) {
  const auto image = decode_radiance_hdr(hdr(flat_pixels(), "-Y 2 +X 4", "EXPOSURE= 2\r\nEXPOSURE=0.25\n"));
  ASSERT_TRUE(image) << image.error().message;
  EXPECT_EQ(red(image, 0), 2);
  EXPECT_FALSE(decode_radiance_hdr(hdr(flat_pixels(), "-Y 2 +X 4", "EXPOSURE=0\n")));
}

TEST(RadianceHdr, ReadsOldRuns) {
  // 300 pixels: one, then a count of two digits, 0x2a + 1 * 256 = 298, then another.
  const std::string row = rgbe(16, 16, 16, 132) + rgbe(1, 1, 1, 0x2a) + rgbe(1, 1, 1, 1) + rgbe(32, 32, 32, 132);
  const auto image = decode_radiance_hdr(hdr(row, "-Y 1 +X 300"));
  ASSERT_TRUE(image) << image.error().message;
  EXPECT_EQ(red(image, 298), 1);
  EXPECT_EQ(red(image, 299), 2);
  EXPECT_FALSE(decode_radiance_hdr(hdr(row, "-Y 1 +X 200")));
  EXPECT_FALSE(decode_radiance_hdr(hdr(row, "-Y 1 +X 400")));
}

TEST(RadianceHdr, ReadsNewRuns) {
  std::string row = {2, 2, 0, 8};
  for (int component = 0; component < 4; ++component) {
    if (component == 3)
      row += {static_cast<char>(128 + 8), static_cast<char>(132)};
    else
      row += {static_cast<char>(128 + 6), 16, 2, 32, 48};
  }
  const auto image = decode_radiance_hdr(hdr(row, "-Y 1 +X 8"));
  ASSERT_TRUE(image) << image.error().message;
  EXPECT_EQ(red(image, 5), 1);
  EXPECT_EQ(red(image, 6), 2);
  EXPECT_EQ(red(image, 7), 3);
  for (std::size_t size = 0; size < row.size(); ++size)
    EXPECT_FALSE(decode_radiance_hdr(hdr(row.substr(0, size), "-Y 1 +X 8")));
  row[4] = static_cast<char>(128 + 9);
  EXPECT_FALSE(decode_radiance_hdr(hdr(row, "-Y 1 +X 8")));
  row[4] = 0;
  EXPECT_FALSE(decode_radiance_hdr(hdr(row, "-Y 1 +X 8")));
}

TEST(RadianceHdr, RefusesWhatItCannotReadBeforeTakingMemory) {
  EXPECT_EQ(decode_radiance_hdr(hdr("", "-Y 8192 +X 16384")).error().code, Code::kInvalidArgument);
  EXPECT_EQ(decode_radiance_hdr(hdr("", "-Y 1 +X 99999")).error().code, Code::kResourceExhausted);
  EXPECT_EQ(decode_radiance_hdr(hdr("", "-Y 1 +X 4", "FORMAT=32-bit_rle_xyze\n")).error().code, Code::kUnimplemented);
  for (const char* size :
       {"", "-Y 2", "+X 4 -Y 2", "-Y 0 +X 0", "-Y -2 +X 4", "-Y 2 +X 4 5", "-Y 2 +X 99999999999999999999"}) {
    EXPECT_FALSE(decode_radiance_hdr(hdr(flat_pixels(), size))) << size;
  }
}

Image exr_map(int width, int height, const std::vector<const char*>& names) {
  Image image;
  image.width = width;
  image.height = height;
  for (const char* name : names) {
    for (std::size_t i = 0; i < image.pixel_count(); ++i)
      image.channels[name].push_back(static_cast<float>(i + name[0] % 4U));
  }
  return image;
}

TEST(EnvironmentFile, ReadsOpenExrInColourOrGrey) {
  const auto colour = decode_environment(text_of(*encode_exr(exr_map(8, 4, {"R", "G", "B", "A"}))));
  ASSERT_TRUE(colour) << colour.error().message;
  EXPECT_EQ(colour->width, 8U);
  EXPECT_EQ(colour->radiance[3], Spectrum(5, 6, 5));
  const auto grey = decode_environment(text_of(*encode_exr(exr_map(8, 4, {"Y"}))));
  ASSERT_TRUE(grey) << grey.error().message;
  EXPECT_EQ(grey->radiance[3], Spectrum(4));
  const auto depth = decode_environment(text_of(*encode_exr(exr_map(8, 4, {"Z"}))));
  ASSERT_FALSE(depth);
  EXPECT_THAT(depth.error().message, HasSubstr("channels Z, should have R, G and B, or Y"));
}

TEST(EnvironmentFile, CountsPixelsThatAreNoNumbersAndRaisesNegativeOnes) {
  Image image = exr_map(8, 4, {"Y"});
  image.channels["Y"][2] = -3;
  ASSERT_TRUE(decode_environment(text_of(*encode_exr(image))));
  EXPECT_EQ(decode_environment(text_of(*encode_exr(image)))->radiance[2], Spectrum());
  image.channels["Y"][11] = std::numeric_limits<float>::quiet_NaN();
  image.channels["Y"][20] = std::numeric_limits<float>::infinity();
  const auto bad = decode_environment(text_of(*encode_exr(image)));
  ASSERT_FALSE(bad);
  EXPECT_THAT(bad.error().message, HasSubstr("has 2 pixels"));
  EXPECT_THAT(bad.error().message, HasSubstr("column 3 of row 1"));
}

TEST(EnvironmentFile, MustBeTwiceAsWideAsHigh) {
  const auto square = decode_environment(text_of(*encode_exr(exr_map(8, 8, {"Y"}))));
  ASSERT_FALSE(square);
  EXPECT_THAT(square.error().message,
              HasSubstr("8 x 8 pixels, should be twice as wide as high: latitude-longitude, 16 x 8"));
  EXPECT_TRUE(decode_environment(text_of(*encode_exr(exr_map(201, 100, {"Y"})))));
}

TEST(EnvironmentFile, NamesAFileThatIsNone) {
  const auto none = read_environment("/nowhere/map.hdr");
  ASSERT_FALSE(none);
  EXPECT_EQ(none.error().code, Code::kNotFound);
  EXPECT_THAT(decode_environment("P6 2 1").error().message, HasSubstr("neither"));
}

/// All of these are whole scenes' maps; skipped where ../shared is absent.
std::optional<std::filesystem::path> shared_maps() {
  const char* set = std::getenv("RADFARM_SHARED");
  const std::filesystem::path shared =
      set != nullptr ? set : std::filesystem::path(RADFARM_SOURCE_DIR).parent_path() / "shared";
  return std::filesystem::is_directory(shared / "scenes/env") ? std::optional(shared / "scenes/env") : std::nullopt;
}

TEST(RealMaps, AreReadAndGiveLight) {
  const auto folder = shared_maps();
  if (!folder) GTEST_SKIP() << "no scenes/env in $RADFARM_SHARED or ../shared; see docs/testing.md";
  int count = 0;
  for (const auto& entry : std::filesystem::directory_iterator(*folder)) {
    const auto extension = entry.path().extension();
    if (extension != ".hdr" && extension != ".exr") continue;
    ++count;
    const Result<Environment> environment = read_environment(entry.path());
    ASSERT_TRUE(environment) << environment.error().message;
    EXPECT_EQ(environment->width, 2 * environment->height);
    EXPECT_EQ(environment->radiance.size(), std::size_t{environment->width} * environment->height);
    const EnvironmentLight light(*environment);
    EXPECT_GE(light.patches().size(), 145U) << entry.path();
    const float mean_luminance = luminance(light.total()) / (4 * kPi);
    EXPECT_GT(mean_luminance, 0);
    RecordProperty(entry.path().stem().string(),
                   std::to_string(environment->width) + " " + std::to_string(mean_luminance) + " " +
                       std::to_string(light.max_luminance()) + " " + std::to_string(light.patches().size()));
  }
  EXPECT_GT(count, 0);
}

TEST(RealMaps, CutOffGiveOneError) {
  const auto folder = shared_maps();
  if (!folder) GTEST_SKIP() << "no scenes/env in $RADFARM_SHARED or ../shared; see docs/testing.md";
  for (const auto& entry : std::filesystem::directory_iterator(*folder)) {
    const auto extension = entry.path().extension();
    if (extension != ".hdr" && extension != ".exr") continue;
    const std::string bytes = *read_file(entry.path(), std::size_t{1} << 30U);
    // Every 64th byte of the head; further on a prime, so that all of a run's bytes are met.
    for (std::size_t size = 0; size < bytes.size(); size += size < 4096 ? 64 : bytes.size() / 61 | 1U) {
      const Result<Environment> environment = decode_environment(std::string_view(bytes).substr(0, size));
      ASSERT_FALSE(environment) << entry.path() << " " << size;
      EXPECT_EQ(environment.error().message.find('\n'), std::string::npos);
    }
  }
}

TEST(SyntheticMaps, CutOffOrDamagedNeverCrash) {
  std::string pixels;
  for (int y = 0; y < 16; ++y) {
    pixels += {2, 2, 0, 32};
    for (int component = 0; component < 4; ++component) {
      pixels += {static_cast<char>(128 + 20), static_cast<char>(y + 120), 12};
      for (int i = 0; i < 12; ++i) pixels += static_cast<char>(i * y);
    }
  }
  for (const std::string& whole :
       {hdr(pixels, "-Y 16 +X 32"), text_of(*encode_exr(exr_map(32, 16, {"R", "G", "B"})))}) {
    ASSERT_TRUE(decode_environment(whole));
    for (std::size_t size = 0; size < whole.size(); size += 7)
      EXPECT_FALSE(decode_environment(std::string_view(whole).substr(0, size)));
    for (std::size_t i = 0; i < whole.size(); i += 3) {
      std::string damaged = whole;
      damaged[i] = static_cast<char>(damaged[i] ^ 0x5a);
      const auto environment = decode_environment(damaged);  // may be read, with other pixels
      if (environment) {
        EXPECT_EQ(environment->radiance.size(), std::size_t{environment->width} * environment->height);
      }
    }
  }
}

}  // namespace
}  // namespace radfarm
