#include "image/png.h"

#include <array>
#include <cmath>
#include <cstdint>

#include <png.h>

#include "image/rgb.h"
#include "image/tone_map.h"

namespace radfarm {
namespace {

std::uint8_t to_byte(float linear) { return static_cast<std::uint8_t>(std::lround(255 * srgb_from_linear(linear))); }

std::array<std::uint8_t, 3> to_srgb(const Spectrum& color) {
  if (std::isnan(color.r) || std::isnan(color.g) || std::isnan(color.b)) return {255, 0, 255};
  return {to_byte(color.r), to_byte(color.g), to_byte(color.b)};
}

struct Layout {
  png_uint_32 width = 0, height = 0;
  png_uint_32 format = PNG_FORMAT_RGB;
};

Result<std::vector<std::byte>> write_png(const Layout& layout, const void* pixels) {
  png_image png{};
  png.version = PNG_IMAGE_VERSION;
  png.width = layout.width;
  png.height = layout.height;
  png.format = layout.format;
  png_alloc_size_t size = PNG_IMAGE_PNG_SIZE_MAX(png);
  std::vector<std::byte> bytes(size);
  const int written = png_image_write_to_memory(&png, bytes.data(), &size, 0, pixels, 0, nullptr);
  if (written == 0) return fail(Code::kInternal, std::string("cannot encode PNG: ") + png.message);
  bytes.resize(size);
  return bytes;
}

}  // namespace

Result<std::vector<std::byte>> encode_png(const Image& image, float exposure_ev) {
  RADFARM_TRY(const RgbLayer rgb, rgb_layer(image));
  const float gain = std::exp2(exposure_ev);
  std::vector<std::uint8_t> pixels;
  pixels.reserve(3 * image.pixel_count());
  for (std::size_t i = 0; i < image.pixel_count(); ++i) {
    const std::array<std::uint8_t, 3> pixel = to_srgb(rgb.at(i) * gain);
    pixels.insert(pixels.end(), pixel.begin(), pixel.end());
  }
  return write_png({static_cast<png_uint_32>(image.width), static_cast<png_uint_32>(image.height), PNG_FORMAT_RGB},
                   pixels.data());
}

Result<std::vector<std::byte>> encode_png(std::uint32_t width, std::uint32_t height,
                                          std::span<const std::array<std::uint8_t, 4>> pixels) {
  if (width == 0 || pixels.size() != static_cast<std::size_t>(width) * height) {
    return fail(Code::kInvalidArgument, "cannot encode PNG: the pixels do not fill it");
  }
  return write_png({width, height, PNG_FORMAT_RGBA}, pixels.data());
}

}  // namespace radfarm
