#pragma once

#include <array>
#include <cstdint>
#include <filesystem>
#include <string>
#include <utility>
#include <vector>

#include <gtest/gtest.h>

#include "scene/load_scene.h"
#include "scene/world.h"

namespace radfarm::test {

/// A scene of convex polygons under construction, in metres, not recentred.
class SceneMaker {
 public:
  std::uint32_t material(const Spectrum& reflectance, const Spectrum& emission = {}) {
    Material material;
    material.base_color = reflectance;
    material.emission = emission;
    scene_.materials.push_back(material);
    return static_cast<std::uint32_t>(scene_.materials.size() - 1);
  }
  /// Seen counter-clockwise from its front.
  SceneMaker& polygon(std::uint32_t material, const std::vector<Vec3>& corners) {
    std::vector<std::array<std::uint32_t, 3>> triangles;
    for (std::uint32_t i = 1; i + 1 < corners.size(); ++i) triangles.push_back({0, i, i + 1});
    return mesh(material, corners, triangles);
  }
  SceneMaker& mesh(std::uint32_t material, const std::vector<Vec3>& positions,
                   const std::vector<std::array<std::uint32_t, 3>>& triangles) {
    Mesh mesh;
    mesh.material = material;
    mesh.positions = positions;
    mesh.triangles = triangles;
    scene_.meshes.push_back(std::move(mesh));
    Instance instance;
    instance.mesh = static_cast<std::uint32_t>(scene_.meshes.size() - 1);
    scene_.instances.push_back(instance);
    return *this;
  }
  /// A box whose sides face inwards: materials for floor, ceiling, x low, x high, z low, z high.
  SceneMaker& room(const std::vector<std::uint32_t>& m, const Vec3& low, const Vec3& high) {
    const auto [a, b, c] = std::array{low.x, low.y, low.z};
    const auto [d, e, f] = std::array{high.x, high.y, high.z};
    polygon(m.at(0), {{a, b, c}, {a, b, f}, {d, b, f}, {d, b, c}});
    polygon(m.at(1), {{a, e, c}, {d, e, c}, {d, e, f}, {a, e, f}});
    polygon(m.at(2), {{a, b, c}, {a, e, c}, {a, e, f}, {a, b, f}});
    polygon(m.at(3), {{d, b, c}, {d, b, f}, {d, e, f}, {d, e, c}});
    polygon(m.at(4), {{a, b, c}, {d, b, c}, {d, e, c}, {a, e, c}});
    return polygon(m.at(5), {{a, b, f}, {a, e, f}, {d, e, f}, {d, b, f}});
  }
  SceneMaker& light(const PunctualLight& light) {
    scene_.lights.push_back(light);
    return *this;
  }
  Scene take() { return std::move(scene_); }

 private:
  Scene scene_;
};

inline std::filesystem::path own_scene_path(const std::string& name) {
  return std::filesystem::path(RADFARM_SOURCE_DIR) / "tests" / "scenes" / (name + ".gltf");
}

/// A scene of tests/scenes.
inline Scene own_scene(const std::string& name) {
  Result<Scene> scene = load_scene(own_scene_path(name));
  EXPECT_TRUE(scene.has_value()) << scene.error().message;
  return std::move(*scene);
}

}  // namespace radfarm::test
