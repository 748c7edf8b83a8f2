#include "cli/html.h"

#include <cstdint>

namespace radfarm::cli {
namespace {

constexpr std::string_view kStyle = R"(
body { font: 15px/1.45 system-ui, sans-serif; margin: 2em auto; max-width: 68em; padding: 0 1em; color: #1b1f24; background: #fff; }
h1 { font-size: 1.5em; } h2 { font-size: 1.15em; margin-top: 2em; }
table { border-collapse: collapse; font-variant-numeric: tabular-nums; margin: .6em 0; }
th, td { text-align: right; padding: .2em .7em; border-bottom: 1px solid #d8dee4; vertical-align: top; }
th:first-child, td:first-child { text-align: left; }
td.text { text-align: left; }
img { max-width: 100%; image-rendering: auto; border: 1px solid #d8dee4; }
figure { display: inline-block; margin: 0 1em 1em 0; } figcaption { font-size: .85em; color: #57606a; }
.big { font-size: 1.25em; } .note { color: #57606a; } .best td { font-weight: 600; }
)";

constexpr std::string_view kDigits = "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";

}  // namespace

std::string escaped(std::string_view text) {
  std::string result;
  for (const char c : text) {
    switch (c) {
      case '&': result += "&amp;"; break;
      case '<': result += "&lt;"; break;
      case '>': result += "&gt;"; break;
      case '"': result += "&quot;"; break;
      case '\'': result += "&#39;"; break;
      default: result += c;
    }
  }
  return result;
}

std::string base64(std::span<const std::byte> bytes) {
  std::string text;
  text.reserve((bytes.size() + 2) / 3 * 4);
  for (std::size_t i = 0; i < bytes.size(); i += 3) {
    const std::size_t count = bytes.size() - i < 3 ? bytes.size() - i : 3;
    std::uint32_t bits = 0;
    for (std::size_t k = 0; k < 3; ++k) bits = bits << 8 | (k < count ? std::to_integer<std::uint32_t>(bytes[i + k]) : 0U);
    for (std::size_t k = 0; k < 4; ++k) text += k <= count ? kDigits[bits >> (18 - 6 * k) & 63U] : '=';
  }
  return text;
}

std::string png_image(std::span<const std::byte> png, std::string_view alt) {
  return "<img alt=\"" + escaped(alt) + "\" src=\"data:image/png;base64," + base64(png) + "\">";
}

std::string html_table(const std::vector<std::string>& head, const std::vector<std::vector<std::string>>& rows) {
  std::string text = "<table><thead><tr>";
  for (const std::string& cell : head) text += "<th>" + cell + "</th>";
  text += "</tr></thead><tbody>\n";
  for (const std::vector<std::string>& row : rows) {
    text += "<tr>";
    for (const std::string& cell : row) text += "<td>" + cell + "</td>";
    text += "</tr>\n";
  }
  return text + "</tbody></table>\n";
}

std::string html_page(std::string_view title, std::string_view body) {
  std::string page = "<!DOCTYPE html>\n<html lang=\"en\"><head><meta charset=\"utf-8\">\n<title>";
  page += escaped(title);
  page += "</title>\n<meta name=\"viewport\" content=\"width=device-width\"><style>";
  page += kStyle;
  page += "</style></head>\n<body>\n";
  page += body;
  return page + "</body></html>\n";
}

}  // namespace radfarm::cli
