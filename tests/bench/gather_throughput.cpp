// Visibility rays a second of the gather stage against raw occlusion rays of the ray caster, in one run on one thread.
//
//   gather_throughput SCENE [WIDTH]
//
// First renders the view's tiles with the gather, everything included: camera rays, interpolation, form factors, sampling,
// visibility. Then traces rays of the same kind alone: from the same visible points to points of the same senders, drawn by
// the same weights, so that both meet the same geometry. Prints both rates and their ratio.

#include <cstdio>
#include <cstdlib>

#include "base/random.h"
#include "base/stopwatch.h"
#include "estimate/gather.h"
#include "estimate/render_tile.h"
#include "math/sampling.h"
#include "pipeline/resolve.h"
#include "radiosity/solve.h"
#include "scene/load_scene.h"
#include "senders/sender_grid.h"

namespace radfarm {
namespace {

struct VisibilityRay {
  Vec3 from{0, 0, 0};
  Vec3 to{0, 0, 0};
};

/// Rays from each camera sample's visible point to its vertex's critical senders, as many as the gather draws.
std::vector<VisibilityRay> draw_rays(const GatherContext& context, const Film& film, std::uint32_t samples) {
  std::vector<VisibilityRay> rays;
  for (int y = 0; y < film.height; ++y) {
    for (int x = 0; x < film.width; ++x) {
      for (std::uint32_t s = 0; s < samples; ++s) {
        RandomSequence random(combine(film.seed, static_cast<std::uint64_t>(y), static_cast<std::uint64_t>(x), s));
        const Ray ray = camera_ray(film.camera, film.width, film.height, static_cast<float>(x) + random.uniform(),
                                   static_cast<float>(y) + random.uniform());
        const auto hit = context.world.caster.closest(ray, 0);
        if (!hit) continue;
        SurfacePoint point = context.world.surfaces.at(*hit);
        face(point, -ray.direction);
        const VertexSenders& senders =
            context.senders.at(choose_vertex(interpolate(context.senders.grid(), point.position), random.uniform()));
        std::vector<double> weights;
        for (const CriticalSender& c : senders.critical) {
          const float near = near_distance(context.tree, context.senders.grid(), point.position);
          const float likely = judge_irradiance(c.outline, point.position, point.shading_normal, near).likely;
          weights.push_back(c.resample_visibility != 0 ? static_cast<double>(c.prior * likely) : 0);
        }
        const DiscreteDistribution choice(weights);
        if (!(choice.total() > 0)) continue;
        for (int k = 0; k < static_cast<int>(context.settings.samples_per_gather); ++k) {
          const CriticalSender& chosen = senders.critical[choice.sample(random.uniform_double()).index];
          const SenderSample to = sample_sender(context.tree, chosen.node, random.uniform(), {random.uniform(), random.uniform()});
          const Vec3 offset = to.position - point.position;
          if (dot(offset, point.geometric_normal) > 0 && dot(offset, to.normal) < 0) rays.push_back({leave(point), to.leave()});
        }
      }
    }
  }
  return rays;
}

double million_per_second(double count, double seconds) { return 1e-6 * count / seconds; }

int run(const char* path, int width) {
  auto scene = load_scene(path);
  if (!scene) return std::fprintf(stderr, "%s\n", scene.error().message.c_str()), 3;
  const World world(std::move(*scene));
  RenderRequest request;
  request.width = width;
  const auto camera = choose_camera(world.scene, request);
  if (!camera) return std::fprintf(stderr, "%s\n", camera.error().message.c_str()), 3;
  Settings settings = resolve_settings(request, camera->camera);
  const RadiositySolution solution = solve_radiosity(world, settings.radiosity, 1);
  const SenderTree tree = make_sender_tree(solution);
  const SenderGrid grid(classify_visible(world, tree, camera->camera, settings.width, settings.height, settings.senders, 1).file,
                        world, tree, settings.senders, 1);
  const ReflectorLookup lookup(world, tree);
  const GatherContext context{world, tree, lookup, grid, settings.senders};
  const Film film{camera->camera, settings.width, settings.height, 1};

  Counters counters;
  const double gather_start = thread_cpu_seconds();
  render_tile(film, {0, 0, film.width, film.height}, {settings.camera_samples, settings.camera_samples, 0},
              [&](const Ray& ray, const PixelSampler& sampler, Counters& c, FirstSurface*) {
                return gather_radiance(context, ray, sampler, c);
              },
              counters);
  const double gather_seconds = thread_cpu_seconds() - gather_start;

  const std::vector<VisibilityRay> rays = draw_rays(context, film, 4);
  const double raw_start = thread_cpu_seconds();
  double passed = 0;
  for (const VisibilityRay& ray : rays) passed += static_cast<double>(luminance(world.caster.transmittance(ray.from, ray.to)));
  const double raw_seconds = thread_cpu_seconds() - raw_start;

  const double gather_rate = million_per_second(static_cast<double>(counters.visibility_rays), gather_seconds);
  const double raw_rate = million_per_second(static_cast<double>(rays.size()), raw_seconds);
  std::printf("gather %.2f M visibility rays/s (%.2f s CPU, %.1f rays a camera sample); raw occlusion %.2f M rays/s (%.0f %% pass); "
              "share %.2f\n",
              gather_rate, gather_seconds,
              static_cast<double>(counters.visibility_rays) / static_cast<double>(counters.camera_rays), raw_rate,
              100 * passed / static_cast<double>(rays.size()), gather_rate / raw_rate);
  return 0;
}

}  // namespace
}  // namespace radfarm

int main(int count, char** arguments) {
  if (count < 2) return std::fprintf(stderr, "usage: gather_throughput SCENE [WIDTH]\n"), 2;
  return radfarm::run(arguments[1], count > 2 ? std::atoi(arguments[2]) : 320);
}
