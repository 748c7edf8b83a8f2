#include "estimate/gather.h"

#include <algorithm>

#include "estimate/eye_chain.h"
#include "estimate/off_grid_light.h"
#include "estimate/reflected_light.h"
#include "estimate/sender_light.h"
#include "estimate/sky_light.h"
#include "math/sampling.h"

namespace radfarm {
namespace {

constexpr std::uint32_t kVertexDimension = 2;
constexpr std::uint32_t kChoiceDimension = 3;
constexpr std::uint32_t kRayDimension = 8;  // and the next ones
constexpr std::uint32_t kFirstSenderDimension = 64;
constexpr std::uint32_t kFirstSkyDimension = 1U << 16;

void add_lobes(const GatherPoint& point, const VertexSenders& senders, Arrived& arrived) {
  for (const Lobe& lobe : senders.lobes) {
    const float received = received_from(point, lobe.direction);
    arrived.direct += lobe.direct * received;
    arrived.indirect += lobe.indirect * received;
  }
}

/// What a critical sender is likely to give the point, luminance: known but for visibility where its form factor is interpolated.
float likely_from(const GatherPoint& point, const CriticalSender& sender) {
  if (sender.resample_form_factor == 0) {
    return sender.prior * luminance(sender.direct + sender.indirect) * cosine_to(point, sender.direction);
  }
  return sender.prior * judge_irradiance(sender.outline, point.surface.position, point.surface.shading_normal,
                                         point.near_distance).likely;
}

/// (gather.2) Draws senders by systematic sampling in proportion to what each is likely to give this very point: N positions,
/// one step apart from a random start, fall on senders laid end to end by their weights; sender s is taken floor or ceil of
/// N w_s times, N w_s on average.
void add_critical(const GatherPoint& point, const VertexSenders& senders, Arrived& arrived) {
  thread_local std::vector<float> likely;  // scratch: one a sender
  likely.clear();
  float total = 0;
  for (const CriticalSender& sender : senders.critical) total += likely.emplace_back(likely_from(point, sender));
  const float step = total / point.context.settings.samples_per_gather;
  if (!(step > 0)) return;  // nothing, or so little that a line's share is no float
  std::uint32_t dimension = kFirstSenderDimension;
  float position = point.sampler.one(kChoiceDimension) * step, until = 0;
  for (std::size_t i = 0; i < likely.size(); ++i) {
    until += likely[i];
    std::uint32_t count = 0;
    for (; position < until; position += step) ++count;
    if (count == 0) continue;
    const Arrived one = light_of_sender(point, senders.critical[i], count, dimension);
    const float weight = static_cast<float>(count) * step / likely[i];
    arrived.direct += one.direct * weight;
    arrived.indirect += one.indirect * weight;
    dimension += 4 * count;
  }
}

/// The light of the grid at a point that the camera sees.
Arrived gather_on_grid(const GatherPoint& point) {
  const GatherContext& context = point.context;
  Arrived arrived;
  arrived.direct += punctual_light(point);
  const bool has_sky = !context.world.environment.is_empty();
  if (context.tree.nodes.empty() && context.tree.reflectors.empty() && !has_sky) return arrived;
  const Interpolation at = interpolate(context.senders.grid(), point.surface.position);
  const VertexSenders& senders = context.senders.at(choose_vertex(at, point.sampler.one(kVertexDimension)));
  if (has_sky) arrived.direct += sky_light(point, senders.sky, context.settings.sky_lines, kFirstSkyDimension);
  if (context.has_interreflection) arrived.indirect += reflected_light(point, context.settings.reflected_rays, kRayDimension);
  if (context.tree.nodes.empty()) return arrived;
  add_lobes(point, senders, arrived);
  add_critical(point, senders, arrived);
  return arrived;
}

/// Where in the grid a camera sample's point lies, and how the senders of its vertex are classified.
void note_grid(const GatherContext& context, const PixelSampler& sampler, FirstSurface& first) {
  const PerspectiveGrid& grid = context.senders.grid();
  first.cell = grid.cell_at(first.position);
  first.vertex = choose_vertex(interpolate(grid, first.position), sampler.one(kVertexDimension));
  first.classes = context.senders.at(first.vertex).classes;
  first.threshold = context.senders.threshold_at(first.vertex);
}

/// Grid final gather where the camera looks, and light_off_grid() beyond.
class GridLight : public GridGather {
 public:
  using GridGather::GridGather;

  Arrived seen(const SeenPoint& at, const PixelSampler& sampler, Counters& counters) const override {
    return gather_on_grid({context_, at.point, at.bsdf, sampler, counters, leave(at.point),
                           near_distance(context_.tree, context_.senders.grid(), at.point.position)});
  }
};

}  // namespace

RadianceParts gather_radiance(const GatherContext& context, const Ray& camera_ray, const PixelSampler& sampler,
                              Counters& counters, FirstSurface* first) {
  const GridLight light(context);
  const RadianceParts parts =
      trace_eye_chain({context.world, light, context.has_interreflection, first}, camera_ray, sampler, counters);
  if (first != nullptr && first->is_seen) note_grid(context, sampler, *first);
  return parts;
}

Spectrum gather_emission(const GatherContext& context, const Ray& camera_ray, const PixelSampler& sampler, Counters& counters) {
  const GridLight light(context);
  return seen_emission({context.world, light, context.has_interreflection, nullptr}, camera_ray, sampler, counters);
}

}  // namespace radfarm
