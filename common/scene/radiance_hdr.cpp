#include "scene/radiance_hdr.h"

#include <array>
#include <charconv>
#include <cmath>
#include <cstring>
#include <optional>
#include <string>

#include "scene/limits.h"

// The format: G. Ward, "Real Pixels", Graphics Gems II (1991); Radiance's src/common/color.c.
namespace radfarm {
namespace {

using Rgbe = std::array<unsigned char, 4>;

tl::unexpected<Error> bad(const std::string& what) {
  return fail(Code::kInvalidArgument, "not a readable Radiance picture: " + what);
}

struct Header {
  std::size_t width = 0;
  std::size_t height = 0;
  bool is_upside_down = false;  // +Y: the bottom row comes first
  bool is_mirrored = false;     // -X
  double exposure = 1;
};

/// Takes bytes off the front.
class Reader {
 public:
  explicit Reader(std::string_view bytes) : rest_(bytes) {}
  std::size_t left() const { return rest_.size(); }
  std::optional<std::string_view> line() {
    const std::size_t end = rest_.find('\n');
    if (end == std::string_view::npos) return std::nullopt;
    std::string_view line = rest_.substr(0, end);
    rest_.remove_prefix(end + 1);
    if (line.ends_with('\r')) line.remove_suffix(1);
    return line;
  }
  /// Requires: left() >= 1.
  unsigned char byte() {
    const auto first = static_cast<unsigned char>(rest_[0]);
    rest_.remove_prefix(1);
    return first;
  }
  bool pixel(Rgbe& out) {
    if (rest_.size() < out.size()) return false;
    std::memcpy(out.data(), rest_.data(), out.size());
    rest_.remove_prefix(out.size());
    return true;
  }
  bool next_is_new_run(std::size_t width) const {
    if (width < 8 || width > 0x7fff || rest_.size() < 4) return false;
    const auto at = [&](std::size_t i) { return static_cast<unsigned char>(rest_[i]); };
    return at(0) == 2 && at(1) == 2 && (std::size_t{at(2)} << 8U | at(3)) == width;
  }

 private:
  std::string_view rest_;
};

/// "-Y 512 +X 1024" and its mirror images.
Status read_resolution(std::string_view line, Header& header) {
  const auto number = [&](std::size_t& value) {
    const auto [stop, error] = std::from_chars(line.data(), line.data() + line.size(), value);
    if (error != std::errc()) return false;
    line.remove_prefix(static_cast<std::size_t>(stop - line.data()));
    while (line.starts_with(' ')) line.remove_prefix(1);
    return true;
  };
  const auto axis = [&](char name, bool& is_plus) {
    if (line.size() < 3 || (line[0] != '+' && line[0] != '-') || line[1] != name || line[2] != ' ') return false;
    is_plus = line[0] == '+';
    line.remove_prefix(3);
    return true;
  };
  bool is_right = true;
  const std::string whole(line.substr(0, 60));
  if (!axis('Y', header.is_upside_down) || !number(header.height) || !axis('X', is_right) || !number(header.width) ||
      !line.empty()) {
    return bad("its size line is '" + whole + "', should be '-Y <height> +X <width>' (rows first)");
  }
  header.is_mirrored = !is_right;
  if (header.width < 1 || header.height < 1) return bad("it has no pixels");
  if (header.width > limits::kTextureSide || header.height > limits::kTextureSide) {
    return fail(Code::kResourceExhausted, "Radiance picture is " + std::to_string(header.width) + " x " +
                                              std::to_string(header.height) + " pixels, at most " +
                                              std::to_string(limits::kTextureSide) + " a side");
  }
  return {};
}

Result<Header> read_header(Reader& reader) {
  Header header;
  const std::optional<std::string_view> magic = reader.line();
  if (!magic || !magic->starts_with("#?")) return bad("it does not begin with #?RADIANCE");
  for (;;) {
    const std::optional<std::string_view> line = reader.line();
    if (!line) return bad("its header is cut off");
    if (line->empty()) break;
    if (line->starts_with("FORMAT=") && line->find("32-bit_rle_rgbe") == std::string_view::npos) {
      return fail(Code::kUnimplemented,
                  "Radiance picture has " + std::string(line->substr(0, 60)) + ", should be 32-bit_rle_rgbe");
    }
    if (!line->starts_with("EXPOSURE=")) continue;
    std::string_view text = line->substr(9);
    while (text.starts_with(' ')) text.remove_prefix(1);
    double value = 0;
    const auto [stop, error] = std::from_chars(text.data(), text.data() + text.size(), value);
    if (error != std::errc() || !(value > 0) || !std::isfinite(value))
      return bad("its EXPOSURE is not a number above 0");
    header.exposure *= value;
  }
  if (!(header.exposure > 0) || !std::isfinite(header.exposure)) return bad("its EXPOSUREs multiply to 0 or infinity");
  const std::optional<std::string_view> size = reader.line();
  if (!size) return bad("its header is cut off");
  RADFARM_TRY_STATUS(read_resolution(*size, header));
  return header;
}

/// Each of the four components by itself: runs of equal bytes and stretches of different ones.
bool read_new_row(Reader& reader, std::vector<Rgbe>& row) {
  Rgbe mark;
  if (!reader.pixel(mark)) return false;
  for (std::size_t component = 0; component < 4; ++component) {
    for (std::size_t x = 0; x < row.size();) {
      if (reader.left() < 2) return false;
      std::size_t count = reader.byte();
      const bool is_run = count > 128;
      if (is_run) count -= 128;
      if (count == 0 || count > row.size() - x || (!is_run && reader.left() < count)) return false;
      const unsigned char value = is_run ? reader.byte() : static_cast<unsigned char>(0);
      for (; count > 0; --count) row[x++][component] = is_run ? value : reader.byte();
    }
  }
  return true;
}

/// Pixels; one of mantissas 1, 1, 1 repeats the pixel before it, and several in a row are digits of the count, the
/// least first.
bool read_old_row(Reader& reader, std::vector<Rgbe>& row, Rgbe& previous) {
  unsigned shift = 0;
  for (std::size_t x = 0; x < row.size();) {
    Rgbe pixel;
    if (!reader.pixel(pixel)) return false;
    if (pixel[0] != 1 || pixel[1] != 1 || pixel[2] != 1) {
      row[x++] = previous = pixel;
      shift = 0;
      continue;
    }
    if (shift > 16) return false;
    const std::size_t count = std::size_t{pixel[3]} << shift;
    if (count > row.size() - x) return false;
    for (std::size_t i = 0; i < count; ++i) row[x++] = previous;
    shift += 8;
  }
  return true;
}

Spectrum decode(const Rgbe& pixel, double exposure) {
  if (pixel[3] == 0) return {};
  const double scale = std::ldexp(1.0, pixel[3] - (128 + 8)) / exposure;
  // Radiance adds half a step to each mantissa; nearly no writer of maps today expects that, and 0 must stay black.
  const auto value = [&](unsigned char mantissa) { return static_cast<float>(mantissa * scale); };
  return {value(pixel[0]), value(pixel[1]), value(pixel[2])};
}

}  // namespace

Result<HdrImage> decode_radiance_hdr(std::string_view bytes) {
  Reader reader(bytes);
  RADFARM_TRY(const Header header, read_header(reader));
  // The shortest row is one old repeat of 4 bytes.
  if (reader.left() < 4 * header.height) return bad("its pixels are cut off");
  HdrImage image;
  image.width = static_cast<std::uint32_t>(header.width);
  image.height = static_cast<std::uint32_t>(header.height);
  image.pixels.resize(header.width * header.height);
  std::vector<Rgbe> row(header.width);
  Rgbe previous{};
  for (std::size_t y = 0; y < header.height; ++y) {
    const bool is_whole =
        reader.next_is_new_run(header.width) ? read_new_row(reader, row) : read_old_row(reader, row, previous);
    if (!is_whole) return bad("its pixels are damaged or cut off in row " + std::to_string(y));
    Spectrum* const out = image.pixels.data() + (header.is_upside_down ? header.height - 1 - y : y) * header.width;
    for (std::size_t x = 0; x < header.width; ++x) {
      out[header.is_mirrored ? header.width - 1 - x : x] = decode(row[x], header.exposure);
    }
  }
  return image;
}

}  // namespace radfarm
