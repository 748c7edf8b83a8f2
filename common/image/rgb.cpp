#include "image/rgb.h"

#include <string>

namespace radfarm {

Status validate(const Image& image) {
  if (image.width <= 0 || image.height <= 0) {
    return fail(Code::kInvalidArgument, "image is " + std::to_string(image.width) + "x" + std::to_string(image.height) +
                                            " pixels, both must be positive");
  }
  for (const auto& [name, values] : image.channels) {
    if (values.size() == image.pixel_count()) continue;
    return fail(Code::kInvalidArgument, "image channel '" + name + "' has " + std::to_string(values.size()) +
                                            " values for " + std::to_string(image.pixel_count()) + " pixels");
  }
  return {};
}

Result<RgbLayer> rgb_layer(const Image& image, std::string_view layer) {
  RADFARM_TRY_STATUS(validate(image));
  const std::string prefix = layer.empty() ? std::string() : std::string(layer) + ".";
  const auto r = image.channels.find(prefix + "R");
  const auto g = image.channels.find(prefix + "G");
  const auto b = image.channels.find(prefix + "B");
  if (r == image.channels.end() || g == image.channels.end() || b == image.channels.end()) {
    return fail(Code::kInvalidArgument, "image has no channels " + prefix + "R, " + prefix + "G and " + prefix + "B");
  }
  return RgbLayer{r->second, g->second, b->second};
}

}  // namespace radfarm
