#include "scene/image_file.h"

#include <cstring>
#include <limits>
#include <memory>

#include "scene/limits.h"

// The one place that compiles stb_image: static, so that it cannot clash with the copy behind tinygltf.
#define STB_IMAGE_STATIC
#define STB_IMAGE_IMPLEMENTATION
#define STBI_NO_STDIO
#define STBI_NO_HDR
#define STBI_NO_LINEAR
#define STBI_ONLY_PNG
#define STBI_ONLY_JPEG
#define STBI_ONLY_BMP
#define STBI_ONLY_TGA
#include <stb/stb_image.h>

namespace radfarm {
namespace {

struct StbiFree {
  void operator()(stbi_uc* pixels) const { stbi_image_free(pixels); }
};

/// Width and height as a PNG file's first chunk has them, which stb_image withholds where they are too large for it.
bool read_png_size(std::string_view bytes, int& width, int& height) {
  if (bytes.size() < 24 || bytes.substr(1, 3) != "PNG" || bytes.substr(12, 4) != "IHDR") return false;
  const auto byte = [&](std::size_t i) { return static_cast<unsigned char>(bytes[i]); };
  const auto word = [&](std::size_t i) {
    return (byte(i) & 0x7f) << 24 | byte(i + 1) << 16 | byte(i + 2) << 8 | byte(i + 3);
  };
  width = word(16);
  height = word(20);
  return true;
}

}  // namespace

Result<Texture> decode_image(std::string_view bytes) {
  if (bytes.size() > limits::kTextureFileBytes) {
    return fail(Code::kResourceExhausted,
                "image file is larger than " + std::to_string(limits::kTextureFileBytes >> 20U) + " MiB");
  }
  const auto* data = reinterpret_cast<const stbi_uc*>(bytes.data());
  const int size = static_cast<int>(bytes.size());
  int width = 0;
  int height = 0;
  int channels = 0;
  const bool is_known =
      read_png_size(bytes, width, height) || stbi_info_from_memory(data, size, &width, &height, &channels) != 0;
  if (!is_known || width < 1 || height < 1) {
    return fail(Code::kInvalidArgument, "cannot read image: is not a whole PNG, JPEG, BMP or TGA file");
  }
  const auto side = static_cast<std::size_t>(width > height ? width : height);
  if (side > limits::kTextureSide) {
    return fail(Code::kResourceExhausted, "image is " + std::to_string(width) + " x " + std::to_string(height) +
                                              " pixels, at most " + std::to_string(limits::kTextureSide) + " a side");
  }
  const std::unique_ptr<stbi_uc, StbiFree> pixels(stbi_load_from_memory(data, size, &width, &height, &channels, 4));
  if (!pixels) {
    const char* reason = stbi_failure_reason();
    return fail(Code::kInvalidArgument, "cannot decode image: " + std::string(reason == nullptr ? "damaged" : reason));
  }
  Texture texture;
  texture.width = static_cast<std::uint32_t>(width);
  texture.height = static_cast<std::uint32_t>(height);
  texture.texels.resize(std::size_t{texture.width} * texture.height);
  std::memcpy(texture.texels.data(), pixels.get(), texture.texels.size() * 4);
  return texture;
}

}  // namespace radfarm
