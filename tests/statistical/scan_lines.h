#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <optional>
#include <vector>

#include "statistical/rendered_view.h"

namespace radfarm::test {

/// Where what the gather goes by may change hands between two pixels.
enum class Border { kTile, kCell, kTetrahedron };

/// What stands for a pixel, by the point at its centre.
struct Place {
  int tile = 0;
  std::uint32_t cell = 0;
  std::array<std::uint32_t, 4> tetrahedron{};
  bool is_receiver = false;  // on the surface that is looked at
};

/// Tetrahedra within one cell: the border of a cell is one of its own kind.
inline bool lies_between(Border border, const Place& a, const Place& b) {
  if (border == Border::kTile) return a.tile != b.tile;
  if (border == Border::kCell) return a.cell != b.cell;
  return a.cell == b.cell && a.tetrahedron != b.tetrahedron;
}

/// A row or a column of an image.
struct ScanLine {
  std::vector<Place> places;
  std::vector<double> values;     // of light, any unit
  std::vector<double> variances;  // of the values

  bool has_border(Border border, std::size_t i) const { return lies_between(border, places[i - 1], places[i]); }
  bool is_seen(std::size_t i) const {
    return i >= 1 && i + 1 < places.size() && places[i - 1].is_receiver && places[i].is_receiver && places[i + 1].is_receiver;
  }
  bool is_plain(std::size_t i) const {
    const auto has_any = [&](std::size_t k) {
      return has_border(Border::kTile, k) || has_border(Border::kCell, k) || has_border(Border::kTetrahedron, k);
    };
    return is_seen(i) && !has_any(i) && !has_any(i + 1);
  }
  double second_difference(std::size_t i) const { return std::fabs(values[i - 1] - 2 * values[i] + values[i + 1]); }
  /// In standard errors.
  double standardised(std::size_t i) const {
    const double d = second_difference(i);
    return d > 0 ? d / std::sqrt(variances[i - 1] + 4 * variances[i] + variances[i + 1]) : 0;
  }
};

/// Pixel `i` just behind a border, and how far on either side of it the nearest second differences are that hold no border. The
/// three have no pixel in common, and what varies linearly along the line is at the border what it is in the mean of the two.
struct Compared {
  std::size_t i = 0, offset = 0;
};

inline std::vector<Compared> compared_at(const ScanLine& line, Border border) {
  constexpr std::size_t kNearest = 3, kFarthest = 12;
  std::vector<Compared> found;
  for (std::size_t i = kFarthest; i + kFarthest < line.places.size(); ++i) {
    if (!line.is_seen(i) || !line.has_border(border, i)) continue;
    for (std::size_t o = kNearest; o <= kFarthest; ++o) {
      if (!line.is_plain(i - o) || !line.is_plain(i + o)) continue;
      found.push_back({i, o});
      break;
    }
  }
  return found;
}

/// A bound on a one-sided p-value.
struct Excess {
  std::size_t borders = 0;
  double p_value = 1;
};

/// Whether second differences at borders are larger than those beside them, by ranks. The score of a border is 1, 0 or -1 as it
/// is larger than both, one or none of its two neighbours; if borders are nothing special, the sum S of a line's scores is
/// symmetric about 0, and lines are independent. Then P(sum S >= t sqrt(sum S^2)) <= exp(-t^2 / 2) for any symmetric S [Efron 1969]:
/// nothing is assumed of the noise.
inline Excess excess_by_ranks(const std::vector<ScanLine>& lines, Border border) {
  const auto above = [](double a, double b) { return a > b ? 1.0 : (a == b ? 0.5 : 0.0); };
  Excess result;
  double sum = 0, squares = 0;
  for (const ScanLine& line : lines) {
    double score = 0;
    for (const Compared& at : compared_at(line, border)) {
      const double d = line.second_difference(at.i);
      score += above(d, line.second_difference(at.i - at.offset)) + above(d, line.second_difference(at.i + at.offset)) - 1;
      ++result.borders;
    }
    sum += score;
    squares += score * score;
  }
  if (sum > 0) result.p_value = std::exp(-sum * sum / squares / 2);
  return result;
}

/// Whether borders have more than their share of the largest hundredth of all second differences, in standard errors. If they
/// are nothing special, their number x among these k is hypergeometric, and P(x >= q k) <= exp(-k KL(q || p)), p the share of
/// borders among all [Hoeffding 1963].
inline Excess excess_of_largest(const std::vector<ScanLine>& lines, Border border) {
  struct Value {
    double d;
    bool is_border;
  };
  std::vector<Value> all;
  Excess result;
  for (const ScanLine& line : lines) {
    std::vector<std::size_t> beside;
    for (const Compared& at : compared_at(line, border)) {
      all.push_back({line.standardised(at.i), true});
      beside.insert(beside.end(), {at.i - at.offset, at.i + at.offset});
      ++result.borders;
    }
    std::sort(beside.begin(), beside.end());
    beside.erase(std::unique(beside.begin(), beside.end()), beside.end());
    for (const std::size_t i : beside) all.push_back({line.standardised(i), false});
  }
  std::sort(all.begin(), all.end(), [](const Value& a, const Value& b) { return a.d > b.d; });
  const std::size_t k = std::max<std::size_t>(1, all.size() / 100);
  const auto at_borders = std::count_if(all.begin(), all.begin() + static_cast<std::ptrdiff_t>(std::min(k, all.size())),
                                        [](const Value& v) { return v.is_border; });
  const double p = static_cast<double>(result.borders) / static_cast<double>(all.size());
  const double q = static_cast<double>(at_borders) / static_cast<double>(k);
  if (!(q > p)) return result;
  const double divergence = q * std::log(q / p) + (q < 1 ? (1 - q) * std::log((1 - q) / (1 - p)) : 0);
  result.p_value = std::exp(-static_cast<double>(k) * divergence);
  return result;
}

/// The line with steps of `sigmas` standard errors, up and down in turn, at every n-th border of a kind.
inline ScanLine with_steps(ScanLine line, Border border, double sigmas, int every) {
  double step = 0;
  int met = 0;
  for (std::size_t i = 1; i < line.values.size(); ++i) {
    if (line.has_border(border, i) && ++met % every == 0) step = step > 0 ? 0 : sigmas * std::sqrt(line.variances[i]);
    line.values[i] += step;
  }
  return line;
}

}  // namespace radfarm::test
