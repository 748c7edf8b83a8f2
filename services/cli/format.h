#pragma once

#include <array>
#include <cstdio>
#include <string>

namespace radfarm::cli {

/// Some letters and digits around a format, at most 511: snprintf without a buffer to size.
template <typename... Values>
std::string format(const char* pattern, Values... values) {
  std::array<char, 512> text{};
  std::snprintf(text.data(), text.size(), pattern, values...);
  return text.data();
}

}  // namespace radfarm::cli
