#pragma once

#include <cstddef>
#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace radfarm::cli {

/// Text as HTML shows it: & < > " ' escaped.
std::string escaped(std::string_view text);

/// RFC 4648 with padding.
std::string base64(std::span<const std::byte> bytes);

/// An <img> that holds its PNG: a page needs no other file.
std::string png_image(std::span<const std::byte> png, std::string_view alt);

/// A table: cells are HTML already.
std::string html_table(const std::vector<std::string>& head, const std::vector<std::vector<std::string>>& rows);

/// A whole page of one file: no script, no address of any other.
std::string html_page(std::string_view title, std::string_view body);

}  // namespace radfarm::cli
