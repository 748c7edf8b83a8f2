#include "pipeline/fingerprint.h"

#include <cmath>

#include "base/check.h"
#include "base/digest.h"
#include "base/file.h"
#include "base/random.h"
#include "scene/ray_caster.h"

#ifndef RADFARM_VERSION
#define RADFARM_VERSION "0.1.0"
#endif

namespace radfarm {
namespace {

constexpr int kTableSize = 512;
constexpr std::uint32_t kTriangles = 64;
constexpr std::uint32_t kRays = 64;
constexpr std::uint64_t kSceneKey = 0x7363656e65;  // "scene"
constexpr std::uint64_t kRayKey = 0x72617973;      // "rays"

/// The functions that the renderer calls, over arguments that no compiler can fold: libm's last bits are what differs.
template <typename Float>
void add_libm(Sha256& hash) {
  for (int i = 0; i < kTableSize; ++i) {
    volatile Float opaque = static_cast<Float>(i);
    const Float x = (opaque + Float(0.37)) / Float(41);
    const Float y = Float(1.5) - x;
    for (const Float value : {std::sin(x), std::cos(x), std::tan(x), std::exp(y), std::log(x), std::pow(x, y),
                              std::atan2(y, x), std::acos(x / Float(13)), std::sqrt(x), std::cbrt(x), x * y + y / x}) {
      hash.update_value(value);
    }
  }
}

Vec3 point_in_unit_cube(RandomSequence& random) {
  const float x = random.uniform(), y = random.uniform(), z = random.uniform();
  return {x, y, z};
}

/// Triangles at random in the unit cube, each turned its own way: enough for a tree of several levels.
Scene scene_of_triangles() {
  RandomSequence random(kSceneKey);
  Scene scene;
  scene.materials.emplace_back();
  Mesh mesh;
  for (std::uint32_t t = 0; t < kTriangles; ++t) {
    const Vec3 corner = point_in_unit_cube(random);
    for (int i = 0; i < 3; ++i) mesh.positions.push_back(corner + (point_in_unit_cube(random) - Vec3(0.5F)) * 0.5F);
    mesh.triangles.push_back({3 * t, 3 * t + 1, 3 * t + 2});
  }
  scene.meshes.push_back(std::move(mesh));
  scene.instances.push_back({0, Matrix4(), ""});
  return scene;
}

void add_ray_hits(const RaySelfTest& rays, Sha256& hash) {
  hash.update(rays.caster);
  for (const Hit& hit : rays.hits) {
    hash.update_value(hit.instance);
    hash.update_value(hit.triangle);
    for (const float value : {hit.u, hit.v, hit.distance}) hash.update_value(value);
  }
}

}  // namespace

RaySelfTest ray_self_test() {
  const Scene scene = scene_of_triangles();
  const Surfaces surfaces(scene);
  const RayCaster caster(surfaces);
  RandomSequence random(kRayKey);
  RaySelfTest test{ray_caster_name(), {}};
  for (std::uint32_t i = 0; i < kRays; ++i) {
    // From a point outside through one inside.
    const Vec3 origin = point_in_unit_cube(random) - Vec3(0, 0, 2);
    const Vec3 direction = normalize(point_in_unit_cube(random) - origin);
    test.hits.push_back(caster.closest({origin, direction}, i).value_or(Hit{}));
  }
  return test;
}

std::string build_id() {
  std::string id = "radfarm " RADFARM_VERSION ", " __VERSION__;
#ifdef __AVX512F__
  id += ", avx512";
#elif defined(__AVX2__)
  id += ", avx2";
#endif
#ifdef __FMA__
  id += "+fma";
#endif
#ifdef RADFARM_CHECKS
  id += ", checks";
#endif
  return id;
}

std::string program_digest() {
  const Result<MappedFile> program = MappedFile::open("/proc/self/exe");
  RADFARM_CHECK(program);  // the programs find each other there, too
  return sha256_hex(program->bytes());
}

std::string numeric_fingerprint(const RaySelfTest& rays) {
  Sha256 hash;
  hash.update(build_id());
  add_libm<float>(hash);
  add_libm<double>(hash);
  add_ray_hits(rays, hash);
  return hash.hex();
}

}  // namespace radfarm
