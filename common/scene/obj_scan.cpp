#include "scene/obj_scan.h"

#include <algorithm>
#include <array>
#include <charconv>
#include <cmath>
#include <cstdint>

#include "scene/limits.h"

namespace radfarm {
namespace {

constexpr std::string_view kBlanks = " \t";

/// True when the word begins with a finite number below the coordinate limit.
bool is_number(std::string_view word) {
  if (word.starts_with('+')) word.remove_prefix(1);
  double value = 0;
  const auto [end, error] = std::from_chars(word.data(), word.data() + word.size(), value);
  if (error == std::errc::result_out_of_range) return word.find("e-") != word.npos || word.find("E-") != word.npos;
  return error == std::errc() && std::fabs(value) < limits::kCoordinate;
}

/// Keeps counts of v, vt, vn and the first fault.
class Scanner {
 public:
  void line(std::size_t number, std::string_view text) {
    if (!status_) return;
    number_ = number;
    const std::string_view keyword = take_word(text);
    if (keyword == "v") {
      vertex(text);
    } else if (keyword == "vt") {
      ++counts_[1];
    } else if (keyword == "vn") {
      ++counts_[2];
    } else if (keyword == "f") {
      face(text);
    } else if (keyword == "mtllib") {
      library(trimmed(text));
    }
  }

  Result<ObjScan> finish() {
    // Positive indices may refer forward, so they are compared with the final counts.
    for (std::size_t kind = 0; kind < 3; ++kind) {
      if (largest_[kind] <= counts_[kind]) continue;
      number_ = largest_line_[kind];
      if (status_) out_of_range(kind, std::to_string(largest_[kind]));
    }
    if (!status_) return tl::unexpected(status_.error());
    scan_.vertices = counts_[0];
    return std::move(scan_);
  }

 private:
  void fault(const std::string& message, Code code = Code::kInvalidArgument) {
    if (status_) status_ = fail(code, "line " + std::to_string(number_) + ": " + message);
  }

  void out_of_range(std::size_t kind, const std::string& index) {
    static constexpr std::array<const char*, 3> kNames = {"vertex", "texture coordinate", "normal"};
    fault(std::string(kNames[kind]) + " " + index + " does not exist (there are " + std::to_string(counts_[kind]) +
          ")");
  }

  void vertex(std::string_view text) {
    std::size_t numbers = 0;
    for (std::string_view word = take_word(text); !word.empty(); word = take_word(text)) {
      if (!is_number(word) && numbers < 3) return fault("vertex coordinate is not a finite number below 1e18");
      ++numbers;
    }
    if (numbers < 3) return fault("vertex has " + std::to_string(numbers) + " coordinates, must have 3");
    scan_.has_vertex_colors = scan_.has_vertex_colors || numbers >= 6;
    if (++counts_[0] > limits::kVertices) fault("too many vertices", Code::kResourceExhausted);
  }

  void face(std::string_view text) {
    std::size_t corners = 0;
    for (std::string_view word = take_word(text); !word.empty(); word = take_word(text)) {
      ++corners;
      corner(word);
    }
    if (corners > limits::kPolygonCorners) {
      fault("face has more than " + std::to_string(limits::kPolygonCorners) + " corners", Code::kResourceExhausted);
    }
    if (++scan_.faces > limits::kTriangles) fault("too many faces", Code::kResourceExhausted);
  }

  /// v, v/vt, v//vn or v/vt/vn.
  void corner(std::string_view word) {
    for (std::size_t kind = 0; kind < 3; ++kind) {
      const std::size_t slash = std::min(word.find('/'), word.size());
      const std::string_view text = word.substr(0, slash);
      if (!text.empty()) {
        index(kind, text);
      } else if (kind == 0) {
        return fault("face corner has no vertex");
      }
      if (slash == word.size()) return;
      word.remove_prefix(slash + 1);
    }
  }

  void index(std::size_t kind, std::string_view text) {
    std::int64_t value = 0;
    const std::string_view digits = text.starts_with('+') ? text.substr(1) : text;
    const auto [end, error] = std::from_chars(digits.data(), digits.data() + digits.size(), value);
    if (error != std::errc() || end != digits.data() + digits.size()) return fault("face index is not a whole number");
    if (value == 0) return fault("face index is 0; OBJ counts from 1");
    if (value < 0) {
      if (static_cast<std::uint64_t>(-value) > counts_[kind]) out_of_range(kind, std::to_string(value));
    } else if (static_cast<std::uint64_t>(value) > largest_[kind]) {
      largest_[kind] = static_cast<std::size_t>(value);
      largest_line_[kind] = number_;
    }
  }

  void library(std::string_view name) {
    const auto same = [&](const ObjScan::Library& known) { return known.name == name; };
    if (name.empty() || std::any_of(scan_.libraries.begin(), scan_.libraries.end(), same)) return;
    scan_.libraries.push_back({std::string(name), number_});
  }

  ObjScan scan_;
  Status status_;
  std::size_t number_ = 0;
  std::array<std::size_t, 3> counts_{};
  std::array<std::size_t, 3> largest_{};
  std::array<std::size_t, 3> largest_line_{};
};

}  // namespace

std::string_view take_word(std::string_view& line) {
  const std::size_t begin = std::min(line.find_first_not_of(kBlanks), line.size());
  const std::size_t end = std::min(line.find_first_of(kBlanks, begin), line.size());
  const std::string_view word = line.substr(begin, end - begin);
  line.remove_prefix(end);
  return word;
}

std::string_view trimmed(std::string_view line) {
  const std::size_t begin = std::min(line.find_first_not_of(kBlanks), line.size());
  const std::size_t last = line.find_last_not_of(kBlanks);
  return last == std::string_view::npos ? std::string_view() : line.substr(begin, last + 1 - begin);
}

Result<ObjScan> scan_obj(std::string_view text) {
  if (text.find('\0') != std::string_view::npos) {
    return fail(Code::kInvalidArgument, "line 1: is not plain text (UTF-16?); OBJ must be ASCII or UTF-8");
  }
  Scanner scanner;
  for_each_line(text, [&](std::size_t number, std::string_view line) { scanner.line(number, line); });
  return scanner.finish();
}

}  // namespace radfarm
