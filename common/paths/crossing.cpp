#include "paths/crossing.h"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace radfarm {
namespace {

constexpr double kPiD = std::numbers::pi;
constexpr double kParallel = 1e-7;                    // cosine of what never counts: its share of any flux is less
constexpr double kLeastCosine = 0.05;                 // of the length that a segment may go on
constexpr double kRounding = 0x1p-19;                 // of a distance, over the coordinates: Embree's and ours in float
constexpr std::uint64_t kSecondKey = 0x7365636f6e64;  // "second"

double largest_coordinate(const Vec3& a, const Vec3& b) {
  return static_cast<double>(std::max(max_abs_component(a), max_abs_component(b)));
}

/// Angles between which a sector of a disc lies.
struct Sector {
  double begin, end;
};

/// Area of the sector up to `radius` on the near side of a line at distance d of the centre, whose normal has the
/// angle; by 8 slices.
double sector_beyond(Sector sector, double radius, double angle, double d) {
  constexpr int kSlices = 8;
  const double width = (sector.end - sector.begin) / kSlices;
  double area = 0;
  for (int i = 0; i < kSlices; ++i) {
    const double along = std::cos(sector.begin + (i + .5) * width - angle);
    const double until = along < 0 ? std::min(radius, d / -along) : radius;
    area += until * until * width / 2;
  }
  return area;
}

double reach_in(const Disc& disc, const Reach& reach, std::size_t sector) {
  return static_cast<double>(disc.shape.radius) * reach[sector] / kWhole;
}

}  // namespace

double disc_segment(double d) {
  if (d >= 1) return kPiD;
  if (d <= -1) return 0;
  return kPiD - std::acos(d) + d * std::sqrt(1 - d * d);
}

Crossing::Crossing(const World& world, const DiscSet& set, const Segment& segment, const CrossingRules& rules)
    : world_(world), set_(set), segment_(segment), rules_(rules) {}

float Crossing::far() const {
  if (segment_.instance == kNone) return segment_.end;
  const float cosine = std::fabs(dot(segment_.end_normal, segment_.ray.direction));
  const float on = rules_.goes_on ? 4 * set_.largest_radius() / std::max(cosine, static_cast<float>(kLeastCosine)) : 0;
  return segment_.end * (1 + 1e-4F) + on;
}

double Crossing::second_surface() {
  if (second_ >= 0) return second_;
  SurfacePoint point = world_.surfaces.at(world_.surfaces.hit_at(
      segment_.instance, segment_.triangle, segment_.ray.origin + segment_.ray.direction * segment_.end));
  const auto hit = world_.caster.closest({leave(point, segment_.ray.direction), segment_.ray.direction}, kSecondKey);
  second_ = hit ? static_cast<double>(segment_.end + hit->distance) : std::numeric_limits<double>::infinity();
  return second_;
}

/// Whether the surface that the segment meets is the disc's own, or one that it goes on with, as near as the disc is
/// wide.
bool Crossing::belongs_to_surface(const Disc& disc, double distance, double cosine) const {
  if (!continues(disc.geometric_normal, segment_.end_normal)) return false;
  const double radius = static_cast<double>(disc.shape.radius);
  const double beyond = distance - static_cast<double>(segment_.end);
  if (beyond > 2 * radius / std::max(-cosine, kLeastCosine)) return false;
  if (set_.components().of(segment_.instance, segment_.triangle) == disc.component) return true;
  // Of another object: one that bends away from the tangent plane no more than its own slope says. Not a sheet above
  // it.
  const Vec3d met =
      to_double(segment_.ray.origin) + to_double(segment_.ray.direction) * static_cast<double>(segment_.end);
  const Vec3d from = met - to_double(disc.shape.centre);
  const Vec3d normal = to_double(disc.geometric_normal);
  const double height = std::fabs(dot(from, normal)),
               across = std::sqrt(std::max(0.0, from.length2() - height * height));
  const double slope = std::clamp(dot(normal, to_double(segment_.end_normal)), 0.0, 1.0);
  const double rise = slope > 0 ? std::sqrt(1 - slope * slope) / slope : 0;
  return height <= across * rise + kRounding * largest_coordinate(disc.shape.centre, segment_.ray.origin);
}

bool Crossing::is_before_surface(const Disc& disc, double distance, double cosine) {
  if (segment_.instance == kNone) return true;
  const double slack =
      kRounding * largest_coordinate(disc.shape.centre, segment_.ray.origin) / std::max(-cosine, kLeastCosine);
  const double end = static_cast<double>(segment_.end);
  if (distance <= end) return true;
  if (disc.component == Disc::kInAir) return false;
  if (!rules_.goes_on) return distance <= end + slack;
  if (distance <= end + slack && set_.components().of(segment_.instance, segment_.triangle) == disc.component)
    return true;
  return belongs_to_surface(disc, distance, cosine) && distance <= second_surface() + slack;
}

/// What of the disc the segment's origin can reach, and nothing stands on.
double Crossing::free_area(const Disc& disc, const Reach* reach, double radius) const {
  const Vec3d plane = to_double(segment_.plane), normal = to_double(disc.shape.normal);
  const Vec3d across = plane - normal * dot(plane, normal);  // in the disc's plane, towards what is reachable
  const double sine = length(across);
  const double height = dot(to_double(disc.shape.centre) - to_double(segment_.ray.origin), plane);
  double d = std::numeric_limits<double>::infinity();  // of the line that bounds what is reachable, over the centre
  if (rules_.reachable && plane.length2() > 0) {
    // What the centre itself cannot see is not its light, however much of the disc can.
    if (!(height > 0)) return 0;
    if (sine > 0) d = height / sine;
  }
  if (reach == nullptr) return radius * radius * disc_segment(d / radius);
  const Frame frame(disc.shape.normal);
  const double angle =
      sine > 0 ? std::atan2(dot(across, to_double(frame.bitangent)), dot(across, to_double(frame.tangent))) : 0;
  double area = 0;
  for (std::size_t k = 0; k < kSectors; ++k) {
    const double width = 2 * kPiD / kSectors, begin = static_cast<double>(k) * width;
    const double until = std::min(radius, reach_in(disc, *reach, k));
    area += d >= radius ? until * until * width / 2 : sector_beyond({begin, begin + width}, until, angle, d);
  }
  return area;
}

CountedArea Crossing::at(std::uint32_t index) {
  const Disc& disc = set_.discs()[index];
  const Vec3d way = to_double(segment_.ray.direction), normal = to_double(disc.shape.normal);
  const double cosine = dot(way, normal);
  if (!(cosine < -kParallel) || !(dot(segment_.ray.direction, disc.geometric_normal) < 0)) return {};
  const Vec3d from = to_double(segment_.ray.origin) - to_double(disc.shape.centre);
  const double distance = -dot(from, normal) / cosine;
  if (!(distance > static_cast<double>(segment_.begin))) return {};
  const Vec3d across = from + way * distance;
  const double radius = static_cast<double>(disc.shape.radius), off = across.length2();
  if (!(off <= radius * radius) || !is_before_surface(disc, distance, cosine)) return {};
  const Reach* reach = rules_.reach ? set_.reach(index) : nullptr;
  if (reach != nullptr) {
    const Frame frame(disc.shape.normal);
    const double angle = std::atan2(dot(across, to_double(frame.bitangent)), dot(across, to_double(frame.tangent)));
    const double turn = (angle < 0 ? angle + 2 * kPiD : angle) / (2 * kPiD);
    const auto sector = std::min(kSectors - 1, static_cast<std::size_t>(turn * kSectors));
    const double until = reach_in(disc, *reach, sector);
    if (off > until * until) return {};
  }
  const double inner = radius * std::numbers::sqrt2 / 2;
  return {free_area(disc, reach, radius), off <= inner * inner ? free_area(disc, reach, inner) : 0};
}

}  // namespace radfarm
