#include "bench/ray_grid.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>

namespace radfarm::bench {
namespace {

constexpr double kPiD = std::numbers::pi;
constexpr double kWider = 1 + 1e-9;  // what rounding may cost: the exact test has the last word

Vec3d way_of(double polar, double turn) {
  return {std::sin(polar) * std::cos(turn), std::sin(polar) * std::sin(turn), std::cos(polar)};
}

double angle_between(const Vec3d& a, const Vec3d& b) { return std::acos(std::clamp(dot(a, b), -1.0, 1.0)); }

Vec3d across_of(const Vec3d& way) {
  const Vec3d other = std::fabs(way.x) < .5 ? Vec3d(1, 0, 0) : Vec3d(0, 1, 0);
  return normalize(cross(way, other));
}

}  // namespace

bool crosses(const Piece& piece, const OrientedDisc& disc) {
  const Vec3d way = to_double(piece.ray.direction), normal = to_double(disc.normal);
  const double cosine = dot(way, normal);
  if (!(cosine < -1e-7)) return false;
  const Vec3d from = to_double(piece.ray.origin) - to_double(disc.centre);
  const double distance = -dot(from, normal) / cosine;
  if (!(distance > static_cast<double>(piece.begin) && distance <= static_cast<double>(piece.end))) return false;
  const double radius = static_cast<double>(disc.radius);
  return (from + way * distance).length2() <= radius * radius;
}

RayGrid::RayGrid(std::span<const Piece> pieces, const Vec3d& centre, double radius, const RayGridSettings& settings)
    : settings_(settings), centre_(centre), radius_(radius), pieces_(pieces) {
  make_patches();
  const std::size_t cells = static_cast<std::size_t>(settings.columns) * static_cast<std::size_t>(settings.columns);
  first_line_.assign(patches_.size() * cells + 1, 0);
  std::vector<std::uint32_t> cell(pieces.size());
  for (std::size_t i = 0; i < pieces.size(); ++i) {
    const Vec3d way = to_double(pieces[i].ray.direction), from = to_double(pieces[i].ray.origin) - centre_;
    const std::uint32_t number = patch_of(way);
    const Patch& patch = patches_[number];
    const Vec3d met = from - way * (dot(from, patch.way) / dot(way, patch.way));
    cell[i] = static_cast<std::uint32_t>(number * cells + cell_of(patch, dot(met, patch.across), dot(met, patch.up)));
    ++first_line_[cell[i] + 1];
  }
  for (std::size_t c = 1; c < first_line_.size(); ++c) first_line_[c] += first_line_[c - 1];
  std::vector<std::uint32_t> next(first_line_.begin(), first_line_.end() - 1);
  lines_.resize(pieces.size());
  for (std::size_t i = 0; i < pieces.size(); ++i) {
    const Vec3d way = to_double(pieces[i].ray.direction);
    lines_[next[cell[i]]++] = {way, cross(to_double(pieces[i].ray.origin) - centre_, way),
                               static_cast<std::uint32_t>(i)};
  }
}

void RayGrid::make_patches() {
  for (int ring = 0; ring < settings_.rings; ++ring) {
    first_patch_.push_back(static_cast<std::uint32_t>(patches_.size()));
    const double low = kPiD * ring / settings_.rings, high = kPiD * (ring + 1) / settings_.rings;
    const int count = std::max(3, static_cast<int>(std::lround(2 * settings_.rings * std::sin((low + high) / 2))));
    for (int k = 0; k < count; ++k) {
      const double begin = 2 * kPiD * k / count, end = 2 * kPiD * (k + 1) / count;
      const Vec3d way = way_of((low + high) / 2, (begin + end) / 2);
      double angle = 0;
      for (const double polar : {low, high}) angle = std::max(angle, angle_between(way, way_of(polar, begin)));
      angle *= kWider;
      const Vec3d across = across_of(way);
      patches_.push_back(
          {way, across, cross(way, across), std::sin(angle), std::tan(angle), radius_ / std::cos(angle)});
    }
  }
  first_patch_.push_back(static_cast<std::uint32_t>(patches_.size()));
}

std::uint32_t RayGrid::patch_of(const Vec3d& way) const {
  const double polar = std::acos(std::clamp(way.z, -1.0, 1.0)) / kPiD;
  const auto ring =
      static_cast<std::size_t>(std::clamp(static_cast<int>(polar * settings_.rings), 0, settings_.rings - 1));
  const double angle = std::atan2(way.y, way.x), turn = (angle < 0 ? angle + 2 * kPiD : angle) / (2 * kPiD);
  const std::uint32_t count = first_patch_[ring + 1] - first_patch_[ring];
  return first_patch_[ring] + std::min(count - 1, static_cast<std::uint32_t>(turn * count));
}

int RayGrid::column_of(const Patch& patch, double x) const {
  const double place = (x / patch.half + 1) / 2 * settings_.columns;
  return static_cast<int>(std::clamp(place, 0.0, settings_.columns - 1.0));
}

std::size_t RayGrid::cell_of(const Patch& patch, double x, double y) const {
  return static_cast<std::size_t>(column_of(patch, y)) * static_cast<std::size_t>(settings_.columns) +
         static_cast<std::size_t>(column_of(patch, x));
}

void RayGrid::crossed(const OrientedDisc& disc, const std::function<void(std::uint32_t)>& visit) const {
  // The equilateral triangle around the disc, counter-clockwise as its front sees it.
  const Vec3d normal = to_double(disc.normal), x = across_of(normal), y = cross(normal, x);
  std::array<Vec3d, 3> corners;
  for (std::size_t k = 0; k < 3; ++k) {
    const double turn = 2 * kPiD * static_cast<double>(k) / 3,
                 reach = 2 * (1 + 1e-6) * static_cast<double>(disc.radius);
    corners[k] = to_double(disc.centre) - centre_ + (x * std::cos(turn) + y * std::sin(turn)) * reach;
  }
  std::array<Edge, 3> edges;
  for (std::size_t k = 0; k < 3; ++k) {
    const Vec3d way = corners[(k + 1) % 3] - corners[k];
    edges[k] = {way, cross(corners[k], way)};
  }
  for (std::size_t p = 0; p < patches_.size(); ++p) {
    if (dot(patches_[p].way, normal) < patches_[p].sine) search(p, disc, edges, visit);
  }
}

void RayGrid::search(std::size_t number, const OrientedDisc& disc, std::span<const Edge> edges,
                     const std::function<void(std::uint32_t)>& visit) const {
  const Patch& patch = patches_[number];
  const Vec3d from = to_double(disc.centre) - centre_, normal = to_double(disc.normal);
  const double radius = static_cast<double>(disc.radius), x = dot(from, patch.across), y = dot(from, patch.up);
  const double wider = (std::fabs(dot(from, patch.way)) + radius) * patch.tangent + 1e-9 * radius_;
  const double half_x = radius * std::sqrt(std::max(0.0, 1 - std::pow(dot(normal, patch.across), 2))) + wider;
  const double half_y = radius * std::sqrt(std::max(0.0, 1 - std::pow(dot(normal, patch.up), 2))) + wider;
  const auto columns = static_cast<std::size_t>(settings_.columns);
  const auto first = static_cast<std::size_t>(column_of(patch, x - half_x));
  const auto last = static_cast<std::size_t>(column_of(patch, x + half_x));
  const auto low = static_cast<std::size_t>(column_of(patch, y - half_y));
  const auto high = static_cast<std::size_t>(column_of(patch, y + half_y));
  for (std::size_t row = low; row <= high; ++row) {
    const std::size_t cells = (number * columns + row) * columns;
    // Cells of a row lie side by side, and so do their lines.
    for (std::uint32_t i = first_line_[cells + first]; i < first_line_[cells + last + 1]; ++i) {
      const Line& line = lines_[i];
      const auto passes = [&](const Edge& edge) {
        return dot(line.way, edge.moment) + dot(edge.way, line.moment) <= 0;
      };
      if (!passes(edges[0]) || !passes(edges[1]) || !passes(edges[2])) continue;
      if (crosses(pieces_[line.piece], disc)) visit(line.piece);
    }
  }
}

}  // namespace radfarm::bench
