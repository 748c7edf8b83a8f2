#include "senders/paper_vertex.h"

#include <set>

#include <gtest/gtest.h>

#include "unit/senders/solved_scene.h"

namespace radfarm {
namespace {

using test::SolvedScene;

/// A tetrahedron with corners of its own on each side, and beside it one sheet.
Scene tetrahedron_and_sheet() {
  const Vec3 corners[] = {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, 0, 1}};
  Mesh mesh;
  const auto add = [&](const Vec3& a, const Vec3& b, const Vec3& c) {
    const auto first = static_cast<std::uint32_t>(mesh.positions.size());
    mesh.positions.insert(mesh.positions.end(), {a, b, c});
    mesh.triangles.push_back({first, first + 1, first + 2});
  };
  add(corners[0], corners[2], corners[1]);
  add(corners[0], corners[1], corners[3]);
  add(corners[0], corners[3], corners[2]);
  add(corners[1], corners[2], corners[3]);
  add({5, 0, 0}, {6, 0, 0}, {5, 1, 0});
  Scene scene;
  scene.meshes.push_back(std::move(mesh));
  scene.instances.emplace_back();
  return scene;
}

TEST(ClosedComponents, AreThoseWithTwoTrianglesAtEveryEdge) {
  const ClosedComponents components(tetrahedron_and_sheet());
  for (std::uint32_t t = 0; t < 5; ++t) {
    Hit hit;
    hit.instance = 0, hit.triangle = t;
    EXPECT_EQ(components.is_closed(hit), t < 4) << t;
  }
}

/// The paper's classification of what the default gather would look at on the grid, and of all that is gathered on patches.
struct PaperView {
  explicit PaperView(const SolvedScene& scene)
      : file(scene.classify()),
        paper(scene.world, scene.tree, file.grid),
        context{scene.world, scene.tree, file.grid, file.receivers, file.thresholds, scene.settings, 1, &paper} {}

  std::vector<VertexSenders> on_grid() const {
    std::vector<VertexSenders> all;
    for (const std::uint32_t vertex : file.vertices) all.push_back(paper_vertex(context, vertex));
    return all;
  }
  std::vector<VertexSenders> on_patches() const {
    std::vector<VertexSenders> all;
    for (std::uint32_t v = 0; v < paper.patches.vertex_count(); ++v) all.push_back(paper_patch_vertex(context, v));
    return all;
  }

  const SenderGridFile file;
  const PaperContext paper;
  const VertexContext context;
};

void expect_sane(const std::vector<VertexSenders>& all) {
  std::size_t critical = 0, interpolated = 0;
  for (const VertexSenders& senders : all) {
    std::set<std::uint32_t> nodes;
    for (const CriticalSender& sender : senders.critical) {
      nodes.insert(sender.node);
      EXPECT_GE(sender.samples, 1);
      EXPECT_LE(sender.samples, 256);
      EXPECT_TRUE(sender.resample_form_factor + sender.resample_visibility >= 1);
    }
    EXPECT_EQ(nodes.size(), senders.critical.size());
    critical += senders.critical.size();
    interpolated += senders.lobes.size();
  }
  EXPECT_GT(critical, 0U);
  EXPECT_GT(interpolated, 0U);
}

TEST(PaperVertex, AsksForOneSampleAtLeastOfEachSenderOnce) {
  const SolvedScene scene("cornell");
  const PaperView view(scene);
  expect_sane(view.on_grid());
  expect_sane(view.on_patches());
}

TEST(PaperVertex, LeavesOutOfTheFileWhatPatchesInterpolate) {
  SolvedScene scene("cornell");
  const std::size_t by_default = scene.classify().vertices.size();
  scene.settings.gather = Gather::kPaper;
  const SenderGridFile file = scene.classify();
  EXPECT_LT(file.vertices.size(), by_default);
  const PaperContext paper(scene.world, scene.tree, file.grid);
  const VertexContext context{scene.world, scene.tree, file.grid, file.receivers, file.thresholds, scene.settings, 1, &paper};
  SenderGridFile again{file.grid, file.receivers, file.vertices, {}, file.thresholds};
  for (const std::uint32_t vertex : file.vertices) again.senders.push_back(paper_vertex(context, vertex));
  EXPECT_EQ(encode(again), encode(file));
}

TEST(PaperVertex, AsksForLessWhereTheThresholdIsHigher) {
  SolvedScene scene("cornell");
  const auto asked = [](const std::vector<VertexSenders>& all) {
    double samples = 0;
    for (const VertexSenders& senders : all) {
      for (const CriticalSender& sender : senders.critical) samples += static_cast<double>(sender.samples);
    }
    return samples;
  };
  const PaperView fine(scene);
  const double on_grid = asked(fine.on_grid()), on_patches = asked(fine.on_patches());
  scene.settings.threshold *= 8;
  const PaperView coarse(scene);
  EXPECT_LT(asked(coarse.on_grid()), on_grid);
  EXPECT_LT(asked(coarse.on_patches()), on_patches);
}

TEST(FixedSample, IsTheSameForAnyCaller) {
  const SolvedScene scene("cornell");
  for (std::uint32_t i = 0; i < 20; ++i) {
    const SenderSample a = fixed_sample(scene.tree, 0, i), b = fixed_sample(scene.tree, 0, i);
    EXPECT_EQ(a.position, b.position);
    EXPECT_NE(a.position, fixed_sample(scene.tree, 0, i + 1).position);
  }
}

}  // namespace
}  // namespace radfarm
