#include "scene/surface_samples.h"

#include <algorithm>
#include <numeric>
#include <span>

namespace radfarm {
namespace {

constexpr std::size_t kMostSamples = 4'000'000;

struct World {
  const Scene& scene;
  std::span<const std::vector<Vec3d>> positions;  // per mesh, or empty
  std::span<const Matrix4d> to_world;             // per instance, or empty
};

Vec3d position(const World& world, std::size_t mesh, std::uint32_t vertex) {
  const bool is_double = mesh < world.positions.size() && !world.positions[mesh].empty();
  return is_double ? world.positions[mesh][vertex] : to_double(world.scene.meshes[mesh].positions[vertex]);
}

SurfaceSamples sample(const World& world) {
  std::size_t total = 0;
  for (const Instance& instance : world.scene.instances) total += world.scene.meshes[instance.mesh].triangles.size();
  const std::size_t step = 1 + total / kMostSamples;
  SurfaceSamples samples;
  std::vector<Vec3d> normals;
  for (std::size_t i = 0; i < world.scene.instances.size(); ++i) {
    const std::size_t mesh = world.scene.instances[i].mesh;
    const auto& triangles = world.scene.meshes[mesh].triangles;
    const Matrix4d to_world = world.to_world.empty() ? Matrix4d(world.scene.instances[i].to_world) : world.to_world[i];
    const double front = to_world.determinant() < 0 ? -1 : 1;
    for (std::size_t t = 0; t < triangles.size(); t += step) {
      const Vec3d a = position(world, mesh, triangles[t][0]) * to_world;
      const Vec3d b = position(world, mesh, triangles[t][1]) * to_world;
      const Vec3d c = position(world, mesh, triangles[t][2]) * to_world;
      const Vec3d area = cross(b - a, c - a) * 0.5;
      samples.centroids.push_back((a + b + c) / 3.0);
      samples.areas.push_back(length(area) * static_cast<double>(step));
      normals.push_back(area * (front * static_cast<double>(step)));
    }
  }
  const Vec3d middle(samples.quantile(0, 0.5), samples.quantile(1, 0.5), samples.quantile(2, 0.5));
  for (std::size_t i = 0; i < normals.size(); ++i) {
    samples.signed_volume += dot(normals[i], samples.centroids[i] - middle) / 3;
  }
  return samples;
}

}  // namespace

double SurfaceSamples::quantile(int axis, double q) const {
  std::vector<std::uint32_t> order(centroids.size());
  std::iota(order.begin(), order.end(), 0U);
  std::sort(order.begin(), order.end(), [&](std::uint32_t a, std::uint32_t b) {
    return centroids[a][axis] != centroids[b][axis] ? centroids[a][axis] < centroids[b][axis] : a < b;
  });
  const double total = std::accumulate(areas.begin(), areas.end(), 0.0);
  if (!(total > 0)) return 0;
  double sum = 0;
  for (const std::uint32_t i : order) {
    sum += areas[i];
    if (sum >= q * total && areas[i] > 0) return centroids[i][axis];
  }
  return centroids[order.back()][axis];
}

SurfaceSamples sample_surfaces(const DraftScene& draft) {
  return sample({draft.scene, draft.positions, draft.instance_to_world});
}

SurfaceSamples sample_surfaces(const Scene& scene) { return sample({scene, {}, {}}); }

}  // namespace radfarm
