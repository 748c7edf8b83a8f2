#include "scene/ies.h"

#include <algorithm>
#include <charconv>
#include <cmath>
#include <functional>
#include <string>
#include <utility>

#include "scene/ies_planes.h"
#include "scene/limits.h"

namespace radfarm {
namespace {

constexpr double kMostAngles = 4096;       // of one kind: 0.1 degrees all around is 3601
constexpr double kMostValues = 4'000'000;  // of candela
constexpr double kMostCandela = 1e18;      // as limits::kLight

/// The start of a text from the file, of which anything may have been made.
std::string printable(std::string_view token) {
  std::string text(token.substr(0, 60));
  for (char& c : text) {
    if (c < ' ' || c > '~') c = '?';
  }
  return text;
}

/// Numbers separated by anything that is white or a comma, over lines that are counted.
class Numbers {
 public:
  Numbers(std::string_view text, std::size_t line) : rest_(text), line_(line) {}

  tl::unexpected<Error> bad(const std::string& what, Code code = Code::kInvalidArgument) const {
    return fail(code, "line " + std::to_string(line_) + ": " + what);
  }
  Result<double> next(const char* what, double low, double high) {
    skip_separators();
    if (rest_.empty()) return bad("the file ends before " + std::string(what));
    const std::string_view token = rest_.substr(0, rest_.find_first_of(" \t\r\n,\f\v"));
    const std::string_view digits = token.starts_with('+') ? token.substr(1) : token;
    double value = 0;
    const auto [stop, error] = std::from_chars(digits.data(), digits.data() + digits.size(), value);
    if (error != std::errc() || stop != digits.data() + digits.size() || !std::isfinite(value)) {
      return bad("'" + printable(token) + "' is no number, should be " + what);
    }
    if (value < low || value > high) return bad(printable(token) + " is out of range for " + what);
    rest_.remove_prefix(token.size());
    return value;
  }
  Result<std::size_t> next_whole(const char* what, double low, double high) {
    RADFARM_TRY(const double value, next(what, low, high));
    if (value != std::floor(value)) return bad(std::string(what) + " should be a whole number");
    return static_cast<std::size_t>(value);
  }
  /// `count` of them. What is not there is not waited for: each takes two bytes.
  Result<std::vector<double>> next_list(const char* what, std::size_t count, double low, double high) {
    if (count > rest_.size() / 2 + 1) return bad("the file ends before " + std::to_string(count) + " of " + what);
    std::vector<double> values;
    for (std::size_t i = 0; i < count; ++i) {
      RADFARM_TRY(const double value, next(what, low, high));
      values.push_back(value);
    }
    return values;
  }
  Result<std::vector<double>> next_angles(const char* what, std::size_t count) {
    RADFARM_TRY(std::vector<double> angles, next_list(what, count, -360, 360));
    const auto same = std::adjacent_find(angles.begin(), angles.end(), std::greater_equal<>());
    if (same != angles.end()) return bad(std::string(what) + " do not ascend");
    return angles;
  }

 private:
  void skip_separators() {
    while (!rest_.empty() && std::string_view(" \t\r\n,\f\v").find(rest_[0]) != std::string_view::npos) {
      if (rest_[0] == '\n') ++line_;
      rest_.remove_prefix(1);
    }
  }
  std::string_view rest_;
  std::size_t line_;
};

/// The head: lines of keywords up to the one that begins with TILT=.
struct Head {
  std::string name;       // of the luminaire
  std::string_view tilt;  // behind the "="
  std::string_view rest;  // of the text
  std::size_t line = 1;   // of the rest
  bool has_lamp_factor =
      true;  // the second factor is the ballast-lamp photometric one; later years gave its place other uses
};

std::string_view trim(std::string_view text) {
  while (!text.empty() && static_cast<unsigned char>(text.front()) <= ' ') text.remove_prefix(1);
  while (!text.empty() && static_cast<unsigned char>(text.back()) <= ' ') text.remove_suffix(1);
  return text;
}

Result<Head> read_head(std::string_view text) {
  Head head;
  if (text.starts_with("\xef\xbb\xbf")) text.remove_prefix(3);
  for (std::size_t number = 1; !text.empty(); ++number) {
    const std::size_t end = std::min(text.find('\n'), text.size());
    const std::string_view line = trim(text.substr(0, end));
    text.remove_prefix(std::min(end + 1, text.size()));
    if (number == 1 && line.starts_with("IES")) {
      head.has_lamp_factor = line.ends_with("91") || line.ends_with("86");
    }
    if (line.starts_with("[LUMINAIRE]") || (line.starts_with("[LUMCAT]") && head.name.empty())) {
      head.name = printable(trim(line.substr(line.find(']') + 1)));
    }
    if (!line.starts_with("TILT")) continue;
    const std::string_view value = trim(line.substr(4));
    if (!value.starts_with('=')) continue;
    head.tilt = trim(value.substr(1));
    head.rest = text;
    head.line = number + 1;
    return head;
  }
  return fail(Code::kInvalidArgument, "no line begins with TILT=: not a photometric file of IES LM-63");
}

Status skip_tilt(std::string_view tilt, std::size_t line, Numbers& numbers) {
  if (tilt == "NONE") return {};
  if (tilt != "INCLUDE") {
    return fail(Code::kUnimplemented, "line " + std::to_string(line) +
                                          ": TILT= names a file of its own; should be TILT=NONE or TILT=INCLUDE");
  }
  RADFARM_TRY_STATUS(numbers.next_whole("the lamp's geometry to the luminaire", 1, 3));
  RADFARM_TRY(const std::size_t pairs, numbers.next_whole("the number of tilt angles", 0, kMostAngles));
  RADFARM_TRY_STATUS(numbers.next_list("tilt angles", pairs, -360, 360));
  RADFARM_TRY_STATUS(numbers.next_list("tilt factors", pairs, 0, kMostCandela));
  return {};
}

}  // namespace

Result<Photometry> read_ies(std::string_view text) {
  RADFARM_TRY(Head head, read_head(text));
  Numbers numbers(head.rest, head.line);
  RADFARM_TRY_STATUS(skip_tilt(head.tilt, head.line - 1, numbers));
  RADFARM_TRY_STATUS(numbers.next("the number of lamps", -1e6, 1e6));
  RADFARM_TRY_STATUS(numbers.next("lumens per lamp", -1, kMostCandela));
  RADFARM_TRY(const double multiplier, numbers.next("the candela multiplier", 0, kMostCandela));
  RADFARM_TRY(const std::size_t verticals, numbers.next_whole("the number of vertical angles", 2, 1e9));
  RADFARM_TRY(const std::size_t horizontals, numbers.next_whole("the number of horizontal angles", 1, 1e9));
  if (static_cast<double>(verticals) > kMostAngles || static_cast<double>(horizontals) > kMostAngles ||
      static_cast<double>(verticals) * static_cast<double>(horizontals) > kMostValues) {
    return numbers.bad("more than 4096 angles of a kind, or 4 million candela values", Code::kResourceExhausted);
  }
  RADFARM_TRY(const std::size_t type, numbers.next_whole("the photometric type", 1, 3));
  RADFARM_TRY_STATUS(numbers.next_whole("the unit of length", 1, 2));
  RADFARM_TRY_STATUS(numbers.next_list("the luminous opening's sizes", 3, -1e6, 1e6));
  RADFARM_TRY(const double ballast, numbers.next("the ballast factor", 0, 1e6));
  RADFARM_TRY(const double lamp_factor, numbers.next("the ballast-lamp photometric factor", 0, 1e6));
  RADFARM_TRY_STATUS(numbers.next("the input watts", -1e9, 1e9));
  IesTable table;
  table.type = static_cast<IesTable::Type>(type);
  RADFARM_TRY(table.vertical, numbers.next_angles("vertical angles", verticals));
  RADFARM_TRY(table.horizontal, numbers.next_angles("horizontal angles", horizontals));
  RADFARM_TRY(table.candela, numbers.next_list("candela values", verticals * horizontals, 0, kMostCandela));
  const double factor = multiplier * ballast * (head.has_lamp_factor ? lamp_factor : 1);
  for (double& value : table.candela) value *= factor;
  const double most = *std::max_element(table.candela.begin(), table.candela.end());
  if (!(most <= kMostCandela)) return numbers.bad("candela times the factors are above 1e18");
  Result<Photometry> photometry = to_type_c(table);
  if (!photometry) return numbers.bad(photometry.error().message);
  photometry->name = std::move(head.name);
  return photometry;
}

}  // namespace radfarm
