#include "scene/disc_caster.h"

#include <algorithm>

#include "base/check.h"
#include "scene/embree.h"

namespace radfarm {
namespace {

// Embree tests strictly inside and in float: discs are wider there by the rounding of their centres and of the test.
constexpr float kWider = 1 + 1e-5F;
constexpr float kRounding = 8 * 0x1p-23F;

/// What a query carries to the callback. Embree hands back a pointer to `base`, which must come first.
struct Query {
  rtc::Context base;
  DiscCaster::Visit visit;
  void* user;
};

void tell(const RTCFilterFunctionNArguments* arguments) {
  const auto* query = reinterpret_cast<const Query*>(arguments->context);
  for (unsigned int lane = 0; lane < arguments->N; ++lane) {
    if (arguments->valid[lane] == 0) continue;
    query->visit(query->user, RTCHitN_primID(arguments->hit, arguments->N, lane));
    arguments->valid[lane] = 0;  // go on: all are wanted
  }
}

}  // namespace

struct DiscCaster::Tree {
  RTCDevice device = rtc::new_device();
  RTCScene scene = rtcNewScene(device);

  Tree() = default;
  ~Tree() {
    rtcReleaseScene(scene);
    rtcReleaseDevice(device);
  }
  Tree(const Tree&) = delete;
  Tree& operator=(const Tree&) = delete;
};

DiscCaster::DiscCaster(std::span<const OrientedDisc> discs) : tree_(std::make_unique<Tree>()) {
  RADFARM_CHECK(tree_->device != nullptr);
  rtcSetSceneBuildQuality(tree_->scene, RTC_BUILD_QUALITY_MEDIUM);
  rtcSetSceneFlags(tree_->scene, RTC_SCENE_FLAG_ROBUST);
  if (!discs.empty()) {
    RTCGeometry geometry = rtcNewGeometry(tree_->device, RTC_GEOMETRY_TYPE_ORIENTED_DISC_POINT);
    auto* places = static_cast<Vec4*>(
        rtcSetNewGeometryBuffer(geometry, RTC_BUFFER_TYPE_VERTEX, 0, RTC_FORMAT_FLOAT4, sizeof(Vec4), discs.size()));
    auto* normals = static_cast<Vec3*>(
        rtcSetNewGeometryBuffer(geometry, RTC_BUFFER_TYPE_NORMAL, 0, RTC_FORMAT_FLOAT3, sizeof(Vec3), discs.size()));
    for (std::size_t i = 0; i < discs.size(); ++i) {
      const OrientedDisc& disc = discs[i];
      const float radius = disc.radius * kWider + kRounding * max_abs_component(disc.centre);
      places[i] = {disc.centre.x, disc.centre.y, disc.centre.z, radius};
      normals[i] = disc.normal;
    }
    rtcSetGeometryMask(geometry, 0xffffffffU);
    rtcSetGeometryIntersectFilterFunction(geometry, tell);
    rtcCommitGeometry(geometry);
    rtcAttachGeometry(tree_->scene, geometry);
    rtcReleaseGeometry(geometry);
  }
  rtcCommitScene(tree_->scene);
}

DiscCaster::DiscCaster(DiscCaster&&) noexcept = default;
DiscCaster::~DiscCaster() = default;

void DiscCaster::crossed(const Ray& ray, float near, float far, Visit visit, void* user) const {
  Query query{{}, visit, user};
  rtc::start(query.base);
  RTCRayHit ray_hit{};
  ray_hit.ray.org_x = ray.origin.x, ray_hit.ray.org_y = ray.origin.y, ray_hit.ray.org_z = ray.origin.z;
  ray_hit.ray.dir_x = ray.direction.x, ray_hit.ray.dir_y = ray.direction.y, ray_hit.ray.dir_z = ray.direction.z;
  ray_hit.ray.tnear = std::max(0.0F, near);
  ray_hit.ray.tfar = far;
  ray_hit.ray.mask = 0xffffffffU;
  ray_hit.hit.geomID = RTC_INVALID_GEOMETRY_ID;
  ray_hit.hit.instID[0] = RTC_INVALID_GEOMETRY_ID;
  rtc::intersect(tree_->scene, query.base, ray_hit);
}

}  // namespace radfarm
