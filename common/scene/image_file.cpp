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
#define STBI_MAX_DIMENSIONS 16384
#include <stb/stb_image.h>

namespace radfarm {
namespace {

static_assert(STBI_MAX_DIMENSIONS == limits::kTextureSide);

struct StbiFree {
  void operator()(stbi_uc* pixels) const { stbi_image_free(pixels); }
};

}  // namespace

Result<Texture> decode_image(std::string_view bytes) {
  if (bytes.size() > limits::kTextureFileBytes) {
    return fail(Code::kResourceExhausted, "image file is larger than " +
                                              std::to_string(limits::kTextureFileBytes >> 20U) + " MiB");
  }
  const auto* data = reinterpret_cast<const stbi_uc*>(bytes.data());
  const int size = static_cast<int>(bytes.size());
  int width = 0;
  int height = 0;
  int channels = 0;
  if (stbi_info_from_memory(data, size, &width, &height, &channels) == 0 || width < 1 || height < 1) {
    const std::string why = stbi_failure_reason() == nullptr ? "unknown format" : stbi_failure_reason();
    const Code code = why == "too large" ? Code::kResourceExhausted : Code::kInvalidArgument;
    return fail(code, "cannot read image (PNG, JPEG, BMP or TGA expected): " + why);
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
