#pragma once

#include <cstddef>
#include <string>
#include <string_view>
#include <vector>

#include "base/status.h"

namespace radfarm {

/// What an OBJ file refers to, and where.
struct ObjScan {
  struct Library {
    std::string name;
    std::size_t line = 0;
  };
  std::vector<Library> libraries;  // mtllib, in order, each name once
  std::size_t vertices = 0;
  std::size_t faces = 0;
  bool has_vertex_colors = false;
};

/// Reads an OBJ file's text for what tinyobjloader accepts in silence: numbers that are none or not finite, faces that
/// name vertices which do not exist, text in another encoding. Errors are "line N: what is wrong". Cost: O(text).
Result<ObjScan> scan_obj(std::string_view text);

/// Calls visit(line number, line without its end) for every line.
template <typename Visit>
void for_each_line(std::string_view text, const Visit& visit) {
  std::size_t number = 1;
  for (std::size_t begin = 0; begin < text.size(); ++number) {
    std::size_t end = text.find_first_of("\r\n", begin);
    if (end == std::string_view::npos) end = text.size();
    visit(number, text.substr(begin, end - begin));
    begin = end + (text.substr(end, 2) == "\r\n" ? 2 : 1);
  }
}

/// Takes the first word off a line; empty at its end.
std::string_view take_word(std::string_view& line);
/// The rest of the line without blanks at its ends.
std::string_view trimmed(std::string_view line);

}  // namespace radfarm
