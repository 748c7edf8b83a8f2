#include "meters/work_plane.h"

#include <algorithm>
#include <cmath>
#include <map>

#include "base/disjoint_sets.h"
#include "base/parallel.h"

namespace radfarm {
namespace {

constexpr float kFacesUp = 0.95F;     // cosine to the vertical
constexpr double kLevelShare = .25;   // of the largest level's area: enough to be a floor
constexpr double kLevelHeight = .05;  // m, of one level
constexpr double kMostCells = 1e7;
constexpr int kMostSurfaces = 64;  // under a meter, on the way down to the floor
constexpr float kLeastPlace = 1;   // m^2, of a place where people work

/// What faces up at about one height.
struct Level {
  double area = 0;
  double height = 0;  // times area
  Box3 box;
};

std::map<long, Level> horizontal_levels(const World& world) {
  std::map<long, Level> levels;
  for (std::uint32_t i = 0; i < world.scene.instances.size(); ++i) {
    const Mesh& mesh = world.scene.meshes[world.scene.instances[i].mesh];
    for (std::uint32_t t = 0; t < mesh.triangles.size(); ++t) {
      const TriangleVertices v = world.surfaces.triangle(i, t);
      const Vec3 across = cross(v[1] - v[0], v[2] - v[0]);
      if (!(across.y > kFacesUp * length(across))) continue;
      const double area = static_cast<double>(length(across)) / 2,
                   y = static_cast<double>(v[0].y + v[1].y + v[2].y) / 3;
      Level& level = levels[std::lround(y / kLevelHeight)];
      level.area += area;
      level.height += area * y;
      for (const Vec3& corner : v) level.box.extendBy(corner);
    }
  }
  return levels;
}

struct Floor {
  float height = 0;
  Box3 box;
};

Result<Floor> find_floor(const World& world, const std::optional<float>& given) {
  const auto levels = horizontal_levels(world);
  double most = 0;
  for (const auto& [key, level] : levels) most = std::max(most, level.area);
  for (const auto& [key, level] : levels) {
    const auto height = static_cast<float>(level.height / level.area);
    if (given ? std::fabs(height - *given) <= 2 * static_cast<float>(kLevelHeight) : level.area >= kLevelShare * most) {
      return Floor{given.value_or(height), level.box};
    }
  }
  return fail(Code::kInvalidArgument, given ? "--floor: no surface there faces up" : "no floor: no surface faces up");
}

struct Place {
  bool is_over_floor = false;
  bool is_under_roof = false;
};

/// What is below and above a point.
Place look_around(const World& world, const Vec3& point, float floor) {
  Place place;
  const float slack = 2 * static_cast<float>(kLevelHeight);
  Vec3 from = point;
  for (int i = 0; i < kMostSurfaces; ++i) {
    const auto hit = world.caster.closest({from, {0, -1, 0}}, 0);
    if (!hit) return place;
    SurfacePoint met = world.surfaces.at(*hit);
    if (i == 0 && !(met.geometric_normal.y > 0)) return place;  // from below the surface: inside a solid
    if (std::fabs(met.position.y - floor) <= slack && met.geometric_normal.y > kFacesUp) {
      place.is_over_floor = true;
      break;
    }
    from = leave(met, {0, -1, 0});
  }
  place.is_under_roof = world.caster.closest({point, {0, 1, 0}}, 0).has_value();
  return place;
}

/// Cells that see a neighbour's centre are of one place; small places are cupboards, or what stands between walls.
void leave_out_small_places(const World& world, const std::vector<Vec3>& centres, std::size_t columns, float spacing,
                            std::vector<bool>& has_meter) {
  DisjointSets places(centres.size());
  for (std::uint32_t i = 0; i < centres.size(); ++i) {
    const auto right = static_cast<std::uint32_t>(i + 1), below = static_cast<std::uint32_t>(i + columns);
    const auto join = [&](std::uint32_t other) {
      if (!has_meter[i] || !has_meter[other]) return;
      if (!is_black(world.caster.transmittance(centres[i], centres[other]))) places.join(i, other);
    };
    if (right % columns != 0) join(right);
    if (below < centres.size()) join(below);
  }
  std::vector<std::size_t> cells(centres.size());
  for (std::uint32_t i = 0; i < centres.size(); ++i) cells[places.root(i)] += has_meter[i] ? 1 : 0;
  const std::size_t largest = *std::max_element(cells.begin(), cells.end());
  for (std::uint32_t i = 0; i < centres.size(); ++i) {
    const std::size_t own = cells[places.root(i)];
    if (own < largest && static_cast<float>(own) * spacing * spacing < kLeastPlace) has_meter[i] = false;
  }
}

std::vector<bool> choose_cells(const World& world, const WorkPlane& plane, const std::vector<Vec3>& centres) {
  std::vector<Place> places(centres.size());
  parallel_for(places.size(), 256, [&](std::size_t begin, std::size_t end) {
    for (std::size_t i = begin; i < end; ++i) places[i] = look_around(world, centres[i], plane.floor);
  });
  const auto roofed =
      std::count_if(places.begin(), places.end(), [](const Place& p) { return p.is_over_floor && p.is_under_roof; });
  const auto over = std::count_if(places.begin(), places.end(), [](const Place& p) { return p.is_over_floor; });
  std::vector<bool> has_meter;
  for (const Place& p : places) has_meter.push_back(p.is_over_floor && (4 * roofed < over || p.is_under_roof));
  leave_out_small_places(world, centres, plane.columns, plane.spacing, has_meter);
  return has_meter;
}

}  // namespace

Result<WorkPlane> make_work_plane(const World& world, const WorkPlaneSettings& settings) {
  RADFARM_TRY(const Floor floor, find_floor(world, settings.floor));
  const double wide = static_cast<double>(floor.box.max.x - floor.box.min.x),
               deep = static_cast<double>(floor.box.max.z - floor.box.min.z);
  const double spacing = static_cast<double>(settings.spacing);
  const double columns = std::max(1.0, std::floor(wide / spacing + 1e-3)),
               rows = std::max(1.0, std::floor(deep / spacing + 1e-3));
  if (columns * rows > kMostCells) {
    return fail(Code::kInvalidArgument, "--spacing: more than 10000000 points; a wider one");
  }
  WorkPlane plane{floor.height, {}, settings.spacing, static_cast<std::size_t>(columns), static_cast<std::size_t>(rows),
                  {},           {}};
  // What the spacing leaves over is shared by both sides.
  plane.corner = {floor.box.min.x + static_cast<float>((wide - columns * spacing) / 2), floor.height + settings.height,
                  floor.box.min.z + static_cast<float>((deep - rows * spacing) / 2)};
  std::vector<Vec3> centres;
  for (std::size_t cell = 0; cell < plane.columns * plane.rows; ++cell) {
    centres.push_back(plane.corner + Vec3((static_cast<float>(cell % plane.columns) + .5F) * settings.spacing, 0,
                                          (static_cast<float>(cell / plane.columns) + .5F) * settings.spacing));
  }
  const std::vector<bool> has_meter = choose_cells(world, plane, centres);
  plane.meter_of.assign(centres.size(), kNone);
  for (std::size_t i = 0; i < centres.size(); ++i) {
    if (!has_meter[i]) continue;
    plane.meter_of[i] = static_cast<std::uint32_t>(plane.meters.size());
    plane.meters.push_back({centres[i], {0, 1, 0}});
  }
  if (plane.meters.empty()) {
    return fail(Code::kInvalidArgument, "no point of the work plane lies over the floor, in the open");
  }
  return plane;
}

}  // namespace radfarm
