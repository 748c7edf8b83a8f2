#include "image/digest.h"

#include <cstdint>
#include <span>
#include <string_view>

#include "base/digest.h"

namespace radfarm {

std::string image_digest(const Image& image) {
  Sha256 hash;
  hash.update_value(static_cast<std::int32_t>(image.width));
  hash.update_value(static_cast<std::int32_t>(image.height));
  for (const auto& [name, values] : image.channels) {
    hash.update(std::string_view(name.c_str(), name.size() + 1));  // with its final zero, so that names cannot run together
    hash.update(std::as_bytes(std::span(values)));
  }
  return hash.hex();
}

}  // namespace radfarm
