#pragma once

#include <cstddef>
#include <string_view>

namespace radfarm {

/// Whether the bytes are UTF-8 as RFC 3629 has it: no overlong forms, no surrogates, nothing above U+10FFFF.
bool is_utf8(std::string_view text);

/// Whether UTF-8 text holds control characters (U+0000 to U+001F, U+007F to U+009F), which terminals and logs obey.
bool has_control_characters(std::string_view text);

/// The longest start of UTF-8 text with at most `max_bytes` bytes that does not cut a character.
std::string_view utf8_prefix(std::string_view text, std::size_t max_bytes);

}  // namespace radfarm
