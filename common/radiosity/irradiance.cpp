#include "radiosity/irradiance.h"

#include "base/random.h"
#include "math/sampling.h"
#include "math/sobol.h"
#include "radiosity/deliveries.h"
#include "radiosity/direct.h"

namespace radfarm {
namespace {

constexpr std::uint64_t kGatherKey = 0x6c6f63616cULL;  // "local"
constexpr std::uint32_t kDirectSamples = 4;
constexpr std::uint32_t kRaysPerRound = 16;            // a round of sample_direct() is 8 rays a patch, more on large ones

/// What the rays meet.
struct Surroundings {
  const World& world;
  const RadiositySolution& solution;
  const SideNumbers sides;
  const std::vector<std::uint32_t> node_of_side;
};

/// lm/m^2 that the surface reflects where a ray meets it; black where nothing is met or no light is known to go.
Spectrum radiosity_along(const Surroundings& around, const Ray& ray, std::uint64_t key) {
  const auto hit = around.world.caster.closest(ray, key);
  if (!hit) return {};
  SurfacePoint met = around.world.surfaces.at(*hit);
  face(met, -ray.direction);
  const std::uint32_t whole = around.node_of_side[around.sides.of(hit->instance, hit->triangle, met.is_front)];
  if (whole == kNone) return {};
  const std::uint32_t part = part_at(around.solution.hierarchy, whole, met.position);
  return hit->weight * around.solution.reflected_power[part] / around.solution.hierarchy.nodes[part].area;
}

/// Cosine-distributed rays bring the mean radiosity that the patch sees: its irradiance.
Spectrum gather_indirect(const Surroundings& around, const Patch& patch, std::uint32_t rays, std::uint64_t key) {
  SpectrumD sum;
  for (std::uint32_t i = 0; i < rays; ++i) {
    const SurfacePoint point = point_on_patch(around.world, patch, sobol_owen_2d(i, combine(key, 1)));
    const Vec3 local = sample_cosine_hemisphere(sobol_owen_2d(i, combine(key, 2)));
    const Ray ray{leave(point), normalize(Frame(point.shading_normal).to_world(local))};
    if (!(dot(ray.direction, point.geometric_normal) > 0)) continue;
    sum += SpectrumD(radiosity_along(around, ray, combine(key, 3, i)));
  }
  return Spectrum(sum / static_cast<double>(rays));
}

/// The mean of independent rounds, in their order.
void add_direct(const World& world, const Hierarchy& hierarchy, std::uint32_t rounds, std::uint64_t seed,
                const Progress& progress, std::vector<Irradiance>& irradiance) {
  std::vector<Spectrum> direct;
  for (std::uint32_t round = 0; round < rounds && !progress.is_cancelled(); ++round) {
    direct.clear();
    sample_direct(world, hierarchy, kDirectSamples, combine(seed, kGatherKey, round), direct, progress);
    for (std::size_t i = 0; i < direct.size(); ++i) {
      if (is_undivided(hierarchy.nodes[i])) irradiance[i].direct += direct[i] / static_cast<float>(rounds);
    }
  }
}

}  // namespace

std::vector<Irradiance> gather_irradiance(const World& world, const RadiositySolution& solution, std::uint32_t rays,
                                          std::uint64_t seed, const Progress& progress) {
  const Hierarchy& hierarchy = solution.hierarchy;
  std::vector<Irradiance> irradiance(hierarchy.nodes.size());
  if (hierarchy.nodes.empty()) return irradiance;
  const SideNumbers sides(world.scene);
  const Surroundings around{world, solution, sides, nodes_of_sides(sides, hierarchy)};
  add_direct(world, hierarchy, rays / kRaysPerRound, seed, progress, irradiance);
  if (is_black(solution.reflected_power[0])) return irradiance;
  parallel_for(progress, "radiosity: elements", hierarchy.nodes.size(), 256, [&](std::size_t begin, std::size_t end) {
    for (std::size_t i = begin; i < end; ++i) {
      if (!is_undivided(hierarchy.nodes[i])) continue;
      const Patch& patch = hierarchy.patches[hierarchy.nodes[i].patch];
      irradiance[i].indirect = gather_indirect(around, patch, rays, combine(seed, kGatherKey, rays, i));
      if (!solution.specular.empty()) irradiance[i].indirect += solution.specular[i];
    }
  });
  return irradiance;
}

}  // namespace radfarm
