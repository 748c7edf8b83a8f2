#include "estimate/paper_gather.h"

#include <algorithm>
#include <cmath>
#include <string>

#include <gtest/gtest.h>

#include "estimate/paper_tile.h"
#include "statistical/rendered_view.h"
#include "support/small_scenes.h"

namespace radfarm {
namespace {

constexpr int kWidth = 48;
constexpr int kHeight = 36;
constexpr double kErrors = 4;  // standard errors of noise, as in gather_test.cpp

/// The paper's gather is biased, by so much of the mean light: docs/pipeline.md, Paper 1 to the letter, has what was measured.
struct Biased {
  const char* name;
  double bias;
};

void PrintTo(const Biased& of, std::ostream* out) { *out << of.name; }

class PaperGatherOf : public testing::TestWithParam<Biased> {};
INSTANTIATE_TEST_SUITE_P(Scenes, PaperGatherOf,
                         testing::Values(Biased{"furnace", 0.015}, Biased{"cornell", 0.03}, Biased{"point_light", 0.01}),
                         [](const auto& p) { return std::string(p.param.name); });

TEST_P(PaperGatherOf, HasTheMeanLightOfAPathTraceWithinItsBias) {
  const World world(test::own_scene(GetParam().name));
  const Film film{world.scene.cameras.at(0), kWidth, kHeight, 1};
  const test::Mean paper = test::gathered(world, film, 4, Gather::kPaper), traced = test::path_traced(world, film, 128);
  EXPECT_EQ(paper.dropped, 0U);
  ASSERT_GT(traced.value, 0);
  const double noise = std::hypot(paper.error, traced.error) / traced.value, ratio = paper.value / traced.value;
  RecordProperty("ratio", std::to_string(ratio));
  RecordProperty("noise", std::to_string(noise));
  EXPECT_NEAR(ratio, 1, GetParam().bias + kErrors * noise);
}

/// The patch that a camera ray to a point meets, and what it shows; kNone where something hides the point.
std::pair<std::uint32_t, double> seen_at(const GatherContext& context, const Vec3& eye, const Vec3& position) {
  const Ray ray{eye, normalize(position - eye)};
  const auto hit = context.world.caster.closest(ray, 0);
  if (!hit) return {kNone, 0};
  SurfacePoint point = context.world.surfaces.at(*hit);
  face(point, -ray.direction);
  if (length(point.position - position) > 1e-4F) return {kNone, 0};
  Counters counters;
  const RadianceParts parts = paper_gather_radiance(context, ray, PixelSampler(1, Stream::kRender, 0, 0, 0), counters);
  return {context.lookup.find(*hit, point), static_cast<double>(luminance(parts.direct + parts.indirect))};
}

bool share_edge(const PatchMesh& mesh, std::uint32_t a, std::uint32_t b, std::size_t edge) {
  const auto& theirs = mesh.corners[b];
  const auto is_theirs = [&](std::uint32_t vertex) { return std::find(theirs.begin(), theirs.end(), vertex) != theirs.end(); };
  return is_theirs(mesh.corners[a][edge]) && is_theirs(mesh.corners[a][(edge + 1) % 3]);
}

TEST(PaperGather, IsContinuousAcrossEdgesThatPatchesShare) {
  const World world(test::own_scene("cornell"));
  const Film film{world.scene.cameras.at(0), kWidth, kHeight, 1};
  const test::GatheredView view(world, film, Gather::kPaper);
  const GatherContext& context = view.context();
  const PatchMesh& mesh = *context.senders.patches();
  std::size_t edges = 0, steps = 0;
  for (std::uint32_t id = 0; id < mesh.corners.size(); ++id) {
    if (!mesh.has(id)) continue;
    const TriangleVertices& v = context.tree.reflectors[id].vertices;
    for (std::size_t e = 0; e < 3; ++e) {
      const Vec3 &a = v[e], &b = v[(e + 1) % 3], middle = (a + b) / 2.0F;
      const Vec3 inward = normalize(v[(e + 2) % 3] - middle) * (2e-4F * length(b - a));
      const auto [inside, light] = seen_at(context, film.camera.position, middle + inward);
      const auto [outside, other] = seen_at(context, film.camera.position, middle - inward);
      if (inside != id || outside == kNone || outside <= id || !mesh.has(outside) || !share_edge(mesh, id, outside, e)) continue;
      ++edges;
      steps += std::fabs(light - other) > 0.005 * (light + other) ? 1 : 0;
    }
  }
  RecordProperty("edges", std::to_string(edges));
  RecordProperty("steps", std::to_string(steps));
  EXPECT_GT(edges, 500U);
  // Between the two points a line to a sender's fixed point may pass what hides it: a real step, and rare.
  EXPECT_LE(steps, edges / 100);
}

/// One where the camera's ray hits, and a little noise of its own.
RadianceParts marked(const World& world, const Ray& ray, const PixelSampler& sampler) {
  RadianceParts parts;
  if (world.caster.closest(ray, 0)) parts.direct = Spectrum(1 + sampler.one(20));
  return parts;
}

TEST(PaperTile, IsTheSameForAnyTiling) {
  const World world(test::own_scene("plates"));
  const Film film{world.scene.cameras.at(0), 20, 14, 1};
  const SampleRadiance radiance = [&](const Ray& ray, const PixelSampler& sampler, Counters&, FirstSurface*) {
    return marked(world, ray, sampler);
  };
  Counters counters;
  const std::vector<PixelSums> whole = render_paper_tile(world, film, {0, 0, 20, 14}, 8, radiance, counters);
  std::size_t oversampled = 0;
  for (int y = 0; y < 14; y += 5) {
    for (int x = 0; x < 20; x += 7) {
      const PixelRect rect{x, y, std::min(x + 7, 20), std::min(y + 5, 14)};
      const std::vector<PixelSums> part = render_paper_tile(world, film, rect, 8, radiance, counters);
      for (std::size_t i = 0; i < part.size(); ++i) {
        const int px = x + static_cast<int>(i) % rect.width(), py = y + static_cast<int>(i) / rect.width();
        EXPECT_EQ(part[i], whole[static_cast<std::size_t>(py * 20 + px)]) << px << " " << py;
        oversampled += part[i].samples > 4 ? 1 : 0;
      }
    }
  }
  // Its plates have borders, and do not fill the image with them.
  EXPECT_GT(oversampled, 0U);
  EXPECT_LT(oversampled, whole.size());
}

}  // namespace
}  // namespace radfarm
