#include "base/utf8.h"

#include <algorithm>
#include <cstdint>

namespace radfarm {
namespace {

bool is_continuation(char c) { return (static_cast<unsigned char>(c) & 0xC0U) == 0x80U; }

/// Takes the first character off the text; false when its bytes are not UTF-8.
bool take_character(std::string_view& text, std::uint32_t& character) {
  // By the number of bytes: what the first one's bits must be, which of them count, and the smallest character.
  static constexpr struct {
    std::uint8_t mask, lead;
    std::uint32_t smallest;
  } kForms[] = {{0x80, 0x00, 0}, {0xE0, 0xC0, 0x80}, {0xF0, 0xE0, 0x800}, {0xF8, 0xF0, 0x10000}};
  const auto first = static_cast<std::uint8_t>(text.front());
  for (std::size_t length = 1; length <= 4; ++length) {
    const auto& form = kForms[length - 1];
    if ((first & form.mask) != form.lead) continue;
    if (text.size() < length) return false;
    character = first & static_cast<std::uint8_t>(~form.mask);
    for (const char c : text.substr(1, length - 1)) {
      if (!is_continuation(c)) return false;
      character = (character << 6U) | (static_cast<std::uint8_t>(c) & 0x3FU);
    }
    text.remove_prefix(length);
    const bool is_surrogate = character >= 0xD800 && character <= 0xDFFF;
    return character >= form.smallest && character <= 0x10FFFF && !is_surrogate;
  }
  return false;
}

}  // namespace

bool is_utf8(std::string_view text) {
  std::uint32_t character = 0;
  while (!text.empty()) {
    if (!take_character(text, character)) return false;
  }
  return true;
}

bool has_control_characters(std::string_view text) {
  std::uint32_t character = 0;
  while (!text.empty() && take_character(text, character)) {
    if (character < 0x20 || (character >= 0x7F && character <= 0x9F)) return true;
  }
  return false;
}

std::string_view utf8_prefix(std::string_view text, std::size_t max_bytes) {
  std::size_t end = std::min(text.size(), max_bytes);
  while (end > 0 && end < text.size() && is_continuation(text[end])) --end;
  return text.substr(0, end);
}

}  // namespace radfarm
