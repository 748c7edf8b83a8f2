#include "coordinator/tokens.h"

#include <sys/random.h>

#include <array>

#include "base/check.h"

namespace radfarm {

std::string random_token() {
  std::array<unsigned char, 16> bytes{};
  RADFARM_CHECK(::getrandom(bytes.data(), bytes.size(), 0) == static_cast<ssize_t>(bytes.size()));
  std::string text;
  for (const unsigned char byte : bytes) {
    text += "0123456789abcdef"[byte >> 4U];
    text += "0123456789abcdef"[byte & 15U];
  }
  return text;
}

}  // namespace radfarm
