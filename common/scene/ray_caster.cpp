#include "scene/ray_caster.h"

#include <array>
#include <limits>
#include <string>
#include <vector>

#include "base/check.h"
#include "base/random.h"
#include "scene/embree.h"

namespace radfarm {
namespace {

/// A pane on a ray's way that changed its colour.
struct Passed {
  float distance = 0;
  Spectrum weight;
};

/// What a query carries to the filter callbacks. Embree hands back a pointer to `base`, which must come first.
struct Query {
  rtc::Context base;
  const Surfaces* surfaces = nullptr;
  std::uint64_t key = 0;
  Vec3 direction{0, 0, 1};
  bool stops_at_panes = false;
  Spectrum transmittance{1.0F};
  std::vector<Passed> passed;  // in the order of traversal: also panes behind the surface that is met

  Query(const Surfaces& s, const Vec3& d, std::uint64_t k = 0) : surfaces(&s), key(k), direction(d) { rtc::start(base); }
};

Hit hit_in_packet(const RTCFilterFunctionNArguments& arguments, unsigned int lane) {
  RTCHitN* hit = arguments.hit;
  const unsigned int n = arguments.N;
  const unsigned int instance = RTCHitN_instID(hit, n, lane, 0);
  return {instance == RTC_INVALID_GEOMETRY_ID ? RTCHitN_geomID(hit, n, lane) : instance,
          RTCHitN_primID(hit, n, lane), RTCHitN_u(hit, n, lane), RTCHitN_v(hit, n, lane), 0};
}

/// Camera and path rays: go on with the probability of the colour that passes most, by a number keyed by ray and triangle.
void choose_by_passage(const RTCFilterFunctionNArguments* arguments) {
  auto* query = reinterpret_cast<Query*>(arguments->context);
  for (unsigned int lane = 0; lane < arguments->N; ++lane) {
    if (arguments->valid[lane] == 0) continue;
    const Hit hit = hit_in_packet(*arguments, lane);
    const Spectrum passage = query->stops_at_panes ? Spectrum(1 - query->surfaces->coverage(hit))
                                                   : query->surfaces->passage(hit, query->direction);
    const float most = max_component(passage);
    if (to_unit_float(combine(query->key, hit.instance, hit.triangle)) >= most) continue;
    arguments->valid[lane] = 0;
    const bool is_tinted = min_component(passage) != most;
    if (is_tinted) query->passed.push_back({RTCRayN_tfar(arguments->ray, arguments->N, lane), passage / most});
  }
}

/// Shadow rays: gather the product of what passes; go on unless nothing is left.
void multiply_by_passage(const RTCFilterFunctionNArguments* arguments) {
  auto* query = reinterpret_cast<Query*>(arguments->context);
  for (unsigned int lane = 0; lane < arguments->N; ++lane) {
    if (arguments->valid[lane] == 0) continue;
    const Spectrum passage = query->surfaces->passage(hit_in_packet(*arguments, lane), query->direction);
    query->transmittance *= passage;
    if (!is_black(passage)) arguments->valid[lane] = 0;
  }
}

RTCRay make_ray(const Vec3& origin, const Vec3& direction, float far) {
  RTCRay ray{};
  ray.org_x = origin.x, ray.org_y = origin.y, ray.org_z = origin.z;
  ray.dir_x = direction.x, ray.dir_y = direction.y, ray.dir_z = direction.z;
  ray.tnear = 0;
  ray.tfar = far;
  ray.mask = 0xffffffffU;
  return ray;
}

/// Where a ray of length 1 from one point to another ends so that it does not meet the surface just behind the other: an offset of that surface
/// knows its own coordinates, the ray's rounding is that of the larger ones.
float end_before(const Vec3& from, const Vec3& to) {
  constexpr float kRounding = 8 * 0x1p-24F;
  const float largest = std::max(max_abs_component(from), max_abs_component(to)), across = max_abs_component(to - from);
  return across > 0 ? std::max(0.0F, 1 - kRounding * largest / across) : 0;
}

RTCGeometry triangle_geometry(RTCDevice device, std::span<const Vec3> positions,
                              std::span<const std::array<std::uint32_t, 3>> triangles) {
  RTCGeometry geometry = rtcNewGeometry(device, RTC_GEOMETRY_TYPE_TRIANGLE);
  auto* vertex_buffer = static_cast<Vec3*>(rtcSetNewGeometryBuffer(geometry, RTC_BUFFER_TYPE_VERTEX, 0, RTC_FORMAT_FLOAT3,
                                                                   sizeof(Vec3), positions.size()));
  auto* index_buffer = static_cast<std::array<std::uint32_t, 3>*>(rtcSetNewGeometryBuffer(
      geometry, RTC_BUFFER_TYPE_INDEX, 0, RTC_FORMAT_UINT3, sizeof(triangles[0]), triangles.size()));
  std::copy(positions.begin(), positions.end(), vertex_buffer);
  std::copy(triangles.begin(), triangles.end(), index_buffer);
  rtcSetGeometryMask(geometry, 0xffffffffU);
  return geometry;
}

void commit_and_attach(RTCScene scene, RTCGeometry geometry, unsigned int id) {
  rtcCommitGeometry(geometry);
  rtcAttachGeometryByID(scene, geometry, id);
  rtcReleaseGeometry(geometry);
}

RTCScene new_scene(RTCDevice device) {
  RTCScene scene = rtcNewScene(device);
  rtcSetSceneBuildQuality(scene, RTC_BUILD_QUALITY_MEDIUM);
  rtcSetSceneFlags(scene, RTC_SCENE_FLAG_ROBUST);
  return scene;
}

}  // namespace

struct RayCaster::Tree {
  const Surfaces* surfaces;
  RTCDevice device = nullptr;
  RTCScene top = nullptr;
  std::vector<RTCScene> shared;  // one a mesh that is used more than once, else null

  explicit Tree(const Surfaces& s) : surfaces(&s) {
    device = rtc::new_device();
    RADFARM_CHECK(device != nullptr);
    top = new_scene(device);
    shared.resize(s.scene().meshes.size(), nullptr);
  }
  ~Tree() {
    for (RTCScene scene : shared) {
      if (scene != nullptr) rtcReleaseScene(scene);
    }
    rtcReleaseScene(top);
    rtcReleaseDevice(device);
  }
  Tree(const Tree&) = delete;
  Tree& operator=(const Tree&) = delete;

  std::optional<Hit> meet(const Ray& ray, float reach, Query& query) const {
    RTCRayHit ray_hit;
    ray_hit.ray = make_ray(ray.origin, ray.direction, reach);
    ray_hit.hit.geomID = RTC_INVALID_GEOMETRY_ID;
    ray_hit.hit.instID[0] = RTC_INVALID_GEOMETRY_ID;
    rtc::intersect(top, query.base, ray_hit);
    const RTCHit& hit = ray_hit.hit;
    if (hit.geomID == RTC_INVALID_GEOMETRY_ID) return std::nullopt;
    return Hit{hit.instID[0] == RTC_INVALID_GEOMETRY_ID ? hit.geomID : hit.instID[0], hit.primID, hit.u, hit.v,
               ray_hit.ray.tfar};
  }
  void set_filters(RTCGeometry geometry, std::uint32_t mesh) const {
    if (!surfaces->lets_through(mesh)) return;  // neither holes nor panes: no callback is bound at all
    rtcSetGeometryIntersectFilterFunction(geometry, choose_by_passage);
    rtcSetGeometryOccludedFilterFunction(geometry, multiply_by_passage);
  }
  /// World-space vertices as Surfaces computes them, so that both agree on where the surface is.
  void place_once(std::uint32_t id) const {
    const Instance& instance = surfaces->scene().instances[id];
    const Mesh& mesh = surfaces->scene().meshes[instance.mesh];
    std::vector<Vec3> positions(mesh.positions.size());
    for (std::uint32_t t = 0; t < mesh.triangles.size(); ++t) {
      const TriangleVertices world = surfaces->triangle(id, t);
      const auto& index = mesh.triangles[t];
      // triangle() swaps two vertices of mirrored instances; a vertex is the same point in either place.
      const bool is_swapped = surfaces->is_mirrored(id);
      positions[index[0]] = world[0];
      positions[index[1]] = world[is_swapped ? 2 : 1];
      positions[index[2]] = world[is_swapped ? 1 : 2];
    }
    RTCGeometry geometry = triangle_geometry(device, positions, mesh.triangles);
    set_filters(geometry, instance.mesh);
    commit_and_attach(top, geometry, id);
  }
  void place_shared(std::uint32_t id) {
    const Instance& instance = surfaces->scene().instances[id];
    RTCScene& scene = shared[instance.mesh];
    if (scene == nullptr) {
      const Mesh& mesh = surfaces->scene().meshes[instance.mesh];
      scene = new_scene(device);
      RTCGeometry geometry = triangle_geometry(device, mesh.positions, mesh.triangles);
      set_filters(geometry, instance.mesh);
      commit_and_attach(scene, geometry, 0);
      rtcCommitScene(scene);
    }
    RTCGeometry geometry = rtcNewGeometry(device, RTC_GEOMETRY_TYPE_INSTANCE);
    rtcSetGeometryInstancedScene(geometry, scene);
    rtcSetGeometryTimeStepCount(geometry, 1);
    rtcSetGeometryMask(geometry, 0xffffffffU);
    // Row vectors stored row by row are column vectors stored column by column: Embree's layout.
    rtcSetGeometryTransform(geometry, 0, RTC_FORMAT_FLOAT4X4_COLUMN_MAJOR, &instance.to_world[0][0]);
    commit_and_attach(top, geometry, id);
  }
};

RayCaster::RayCaster(const Surfaces& surfaces) : tree_(std::make_unique<Tree>(surfaces)) {
  const Scene& scene = surfaces.scene();
  std::vector<int> uses(scene.meshes.size());
  for (const Instance& instance : scene.instances) ++uses[instance.mesh];
  for (std::uint32_t id = 0; id < scene.instances.size(); ++id) {
    if (scene.meshes[scene.instances[id].mesh].triangles.empty()) continue;
    if (uses[scene.instances[id].mesh] == 1) {
      tree_->place_once(id);
    } else {
      tree_->place_shared(id);
    }
  }
  rtcCommitScene(tree_->top);
}

RayCaster::RayCaster(RayCaster&&) noexcept = default;
RayCaster::~RayCaster() = default;

std::optional<Hit> RayCaster::closest(const Ray& ray, std::uint64_t key, float reach, Spectrum* passed) const {
  Query query(*tree_->surfaces, ray.direction, key);
  auto met = tree_->meet(ray, reach, query);
  Spectrum weight(1.0F);
  for (const Passed& pane : query.passed) {
    if (!met || pane.distance < met->distance) weight *= pane.weight;
  }
  if (!met) {
    if (passed != nullptr) *passed = weight;
    return std::nullopt;
  }
  met->weight = weight;
  if (tree_->surfaces->is_pane(tree_->surfaces->scene().instances[met->instance].mesh)) {
    // The ray was stopped with this probability, by what the surface covers.
    const float stopped = 1 - max_component(tree_->surfaces->passage(*met, ray.direction));
    met->weight *= stopped > 0 ? tree_->surfaces->coverage(*met) / stopped : 0;
  }
  return met;
}

std::optional<Hit> RayCaster::closest_with_panes(const Ray& ray, std::uint64_t key) const {
  Query query(*tree_->surfaces, ray.direction, key);
  query.stops_at_panes = true;
  return tree_->meet(ray, std::numeric_limits<float>::infinity(), query);
}

Spectrum RayCaster::transmittance(const Vec3& from, const Vec3& to) const {
  Query query(*tree_->surfaces, to - from);
  RTCRay ray = make_ray(from, to - from, end_before(from, to));
  rtc::occluded(tree_->top, query.base, ray);
  return ray.tfar < 0 ? Spectrum() : query.transmittance;
}

std::string ray_caster_name() { return "Embree " RTC_VERSION_STRING " (" + std::string(rtc::kDeviceConfig) + ")"; }

}  // namespace radfarm
