#include "scene/reference.h"

#include <array>
#include <cstdint>

#include "base/file.h"

namespace radfarm {
namespace {

int hex_digit(char c) {
  if (c >= '0' && c <= '9') return c - '0';
  if (c >= 'a' && c <= 'f') return c - 'a' + 10;
  if (c >= 'A' && c <= 'F') return c - 'A' + 10;
  return -1;
}

/// A text from the file, fit to be quoted in a one-line message.
std::string in_quotes(std::string_view text) {
  constexpr std::size_t kLongest = 80;
  std::string result = "'";
  for (const char c : text.substr(0, kLongest)) result += (c >= ' ' && c != 127) ? c : '?';
  return result + (text.size() > kLongest ? "...'" : "'");
}

Result<std::string> undo_percent_encoding(std::string_view uri) {
  std::string text;
  for (std::size_t i = 0; i < uri.size(); ++i) {
    if (uri[i] != '%') {
      text += uri[i];
      continue;
    }
    const int high = i + 2 < uri.size() ? hex_digit(uri[i + 1]) : -1;
    const int low = i + 2 < uri.size() ? hex_digit(uri[i + 2]) : -1;
    if (high < 0 || low < 0) return fail(Code::kInvalidArgument, "URI " + in_quotes(uri) + " has a broken %-escape");
    text += static_cast<char>(high * 16 + low);
    i += 2;
  }
  return text;
}

/// The relative path, or why it may not be read.
Result<std::filesystem::path> confined(const std::string& text) {
  const auto refused = [&](std::string_view why) {
    return fail(Code::kInvalidArgument, "file name " + in_quotes(text) + " " + std::string(why) +
                                            "; scenes may only name files in their own folder");
  };
  if (text.empty()) return refused("is empty");
  if (text.find('\0') != std::string::npos) return refused("contains a zero byte");
  if (text.find('\\') != std::string::npos) return refused("contains a backslash");
  if (text.substr(0, text.find('/')).find(':') != std::string::npos) return refused("has a scheme or drive");
  const std::filesystem::path path(text);
  if (path.is_absolute()) return refused("is absolute");
  for (const std::filesystem::path& part : path) {
    if (part == "..") return refused("leaves the folder");
  }
  return path.lexically_normal();
}

constexpr std::array<std::int8_t, 256> base64_values() {
  std::array<std::int8_t, 256> values{};
  values.fill(-1);
  constexpr std::string_view kDigits = "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
  for (std::size_t i = 0; i < kDigits.size(); ++i) {
    values[static_cast<unsigned char>(kDigits[i])] = static_cast<std::int8_t>(i);
  }
  return values;
}

Result<std::string> decode_base64(std::string_view text) {
  static constexpr std::array<std::int8_t, 256> kValues = base64_values();
  while (!text.empty() && text.back() == '=') text.remove_suffix(1);
  std::string bytes;
  bytes.reserve(text.size() / 4 * 3 + 3);
  std::uint32_t buffer = 0;
  int bits = 0;
  for (const char c : text) {
    const int value = kValues[static_cast<unsigned char>(c)];
    if (value < 0) return fail(Code::kInvalidArgument, "data URI is not base64");
    buffer = (buffer << 6U) | static_cast<std::uint32_t>(value);
    bits += 6;
    if (bits < 8) continue;
    bits -= 8;
    bytes += static_cast<char>((buffer >> static_cast<unsigned>(bits)) & 0xffU);
  }
  return bytes;
}

}  // namespace

Result<std::filesystem::path> path_of_uri(std::string_view uri) {
  RADFARM_TRY(const std::string text, undo_percent_encoding(uri));
  return confined(text);
}

Result<std::filesystem::path> path_of_name(std::string_view name) {
  std::string text(name);
  for (char& c : text) {
    if (c == '\\') c = '/';
  }
  return confined(text);
}

bool is_data_uri(std::string_view uri) { return uri.substr(0, 5) == "data:"; }

Result<std::string> decode_data_uri(std::string_view uri) {
  const std::size_t comma = uri.find(',');
  if (comma == std::string_view::npos || !uri.substr(0, comma).ends_with(";base64")) {
    return fail(Code::kInvalidArgument, "data URI must be base64: data:<type>;base64,<text>");
  }
  return decode_base64(uri.substr(comma + 1));
}

Result<std::string> read_uri(const std::filesystem::path& folder, std::string_view uri, std::size_t max_bytes) {
  if (is_data_uri(uri)) return decode_data_uri(uri);
  RADFARM_TRY(const std::filesystem::path path, path_of_uri(uri));
  return read_file(folder / path, max_bytes);
}

}  // namespace radfarm
