#include "bench/path_scenes.h"

#include <algorithm>
#include <cmath>

#include "base/random.h"
#include "support/shapes.h"
#include "support/small_scenes.h"

namespace radfarm::bench {
namespace {

using test::SceneMaker;

/// Numbers of one made-up thing.
struct Numbers {
  std::uint64_t thing;
  float operator()(std::uint64_t use) const {
    return static_cast<float>(combine(0x62656e6368, thing, use) >> 40) / 0x1p24F;
  }
  Vec3 way(std::uint64_t use) const {
    const float z = 1 - 2 * (*this)(use), turn = 2 * kPi * (*this)(use + 1), r = std::sqrt(std::max(0.0F, 1 - z * z));
    return {r * std::cos(turn), r * std::sin(turn), z};
  }
};

void level(SceneMaker& maker, std::uint32_t material, const Vec3& middle, float half_x, float half_z) {
  const auto [x, y, z] = std::array{middle.x, middle.y, middle.z};
  maker.polygon(material, {{x - half_x, y, z - half_z},
                           {x - half_x, y, z + half_z},
                           {x + half_x, y, z + half_z},
                           {x + half_x, y, z - half_z}});
}

/// Faces down.
void lamp(SceneMaker& maker, const Vec3& middle, float half, float radiance) {
  const auto [x, y, z] = std::array{middle.x, middle.y, middle.z};
  maker.polygon(maker.material(Spectrum(0.0F), Spectrum(radiance)),
                {{x - half, y, z - half}, {x + half, y, z - half}, {x + half, y, z + half}, {x - half, y, z + half}});
}

/// Cells x cells squares over [-half, half]^2; `height` of x and z.
template <class Height>
test::Shape sheet(int cells, float half, const Height& height) {
  test::Shape shape;
  const auto at = [&](int i) { return half * (2 * static_cast<float>(i) / static_cast<float>(cells) - 1); };
  for (int i = 0; i <= cells; ++i) {
    for (int k = 0; k <= cells; ++k) shape.positions.push_back({at(i), height(at(i), at(k)), at(k)});
  }
  for (int i = 0; i < cells; ++i) {
    for (int k = 0; k < cells; ++k) {
      const auto a = static_cast<std::uint32_t>(i * (cells + 1) + k), b = a + static_cast<std::uint32_t>(cells) + 1;
      shape.triangles.push_back({a, a + 1, b});
      shape.triangles.push_back({a + 1, b + 1, b});
    }
  }
  return shape;
}

}  // namespace

Scene plain_room() {
  SceneMaker maker;
  const auto wall = maker.material(Spectrum(.5F));
  maker.room(std::vector<std::uint32_t>(6, wall), {-2, 0, -2}, {2, 3, 2});
  lamp(maker, {0, 2.9F, 0}, .4F, 100);
  return maker.take();
}

Scene leaf_cloud(std::uint32_t leaves, float side) {
  SceneMaker maker;
  const auto green = maker.material(Spectrum(.5F));
  level(maker, green, {0, 0, 0}, 2, 2);
  lamp(maker, {0, 4, 0}, .5F, 100);
  std::vector<Vec3> corners;
  std::vector<std::array<std::uint32_t, 3>> triangles;
  for (std::uint32_t i = 0; i < leaves; ++i) {
    const Numbers number{i};
    const Vec3 middle = Vec3(0, 1.5F, 0) + number.way(0) * std::cbrt(number(2));
    Vec3 normal = number.way(3);
    normal.y = std::fabs(normal.y);
    const Frame frame(normal);
    const auto first = static_cast<std::uint32_t>(corners.size());
    for (const Vec2& corner : {Vec2(-1, -1), Vec2(1, -1), Vec2(1, 1), Vec2(-1, 1)}) {
      corners.push_back(middle + (frame.tangent * corner.x + frame.bitangent * corner.y) * (side / 2));
    }
    triangles.push_back({first, first + 1, first + 2});
    triangles.push_back({first, first + 2, first + 3});
  }
  return maker.mesh(green, corners, triangles).take();
}

Scene shadow_plane() {
  SceneMaker maker;
  const auto grey = maker.material(Spectrum(.5F));
  level(maker, grey, {0, 0, 0}, 1, 1);
  level(maker, grey, {0, .4F, 0}, .4F, .4F);
  lamp(maker, {.3F, 2, .2F}, .1F, 1000);
  return maker.take();
}

Scene waves() {
  SceneMaker maker;
  const auto grey = maker.material(Spectrum(.5F));
  const test::Shape folds =
      sheet(96, 1, [](float x, float z) { return .15F * std::cos(3 * kPi * x) * std::cos(2 * kPi * z); });
  maker.mesh(grey, folds.positions, folds.triangles);
  lamp(maker, {.3F, 2, .2F}, .3F, 100);
  return maker.take();
}

Scene table() {
  SceneMaker maker;
  const auto grey = maker.material(Spectrum(.5F));
  level(maker, grey, {0, 0, 0}, 2, 2);
  level(maker, grey, {0, 1, 0}, .6F, .6F);
  level(maker, grey, {0, 1.05F, 0}, .15F, .4F);
  lamp(maker, {0, 3, 0}, .3F, 100);
  return maker.take();
}

Scene paper_room() {
  SceneMaker maker;
  const auto wall = maker.material(Spectrum(.5F)), ball = maker.material(Spectrum(.7F, .5F, .3F));
  constexpr float kHalf = 5.77F;  // the corners of the cube are 10 m from its middle
  for (std::uint32_t i = 0; i < 16; ++i) {
    const test::Shape one = test::sphere(.5 + .04 * i, 4);
    std::vector<Vec3> moved;
    const Vec3 to{-4.2F + 2.8F * static_cast<float>(i % 4), -4 + 2 * Numbers{i}(0),
                  -4.2F + 2.8F * static_cast<float>(i / 4)};
    for (const Vec3& p : one.positions) moved.push_back(p + to);
    maker.mesh(ball, moved, one.triangles);
  }
  for (int side = 0; side < 6; ++side) {
    test::Shape face = sheet(30, kHalf, [](float, float) { return -kHalf; });
    for (Vec3& p : face.positions) {
      if (side == 1) p = {p.x, -p.y, -p.z};
      if (side == 2) p = {p.y, p.z, p.x};
      if (side == 3) p = {-p.y, p.z, -p.x};
      if (side == 4) p = {p.z, p.x, p.y};
      if (side == 5) p = {-p.z, p.x, -p.y};
    }
    maker.mesh(wall, face.positions, face.triangles);
  }
  lamp(maker, {0, kHalf - .05F, 0}, 1, 100);
  return maker.take();
}

std::vector<Disc> paper_discs(const World& world, const Components& components) {
  constexpr std::size_t kVertices = 46701;
  std::vector<Disc> discs;
  for (std::uint32_t i = 0; i < world.scene.instances.size(); ++i) {
    const Mesh& mesh = world.scene.meshes[world.scene.instances[i].mesh];
    std::vector<Vec3> normals(mesh.positions.size());
    for (const auto& t : mesh.triangles) {
      const Vec3 area = cross(mesh.positions[t[1]] - mesh.positions[t[0]], mesh.positions[t[2]] - mesh.positions[t[0]]);
      for (const std::uint32_t corner : t) normals[corner] += area;
    }
    for (std::size_t v = 0; v < normals.size() && discs.size() < kVertices; ++v) {
      discs.push_back(disc_in_air(mesh.positions[v], normalize(normals[v]), .2F));
      discs.back().component = components.of(i, 0);
    }
  }
  return discs;
}

std::vector<Disc> upper_discs(const World& world, const Components& components, std::size_t count, float radius) {
  struct Face {
    std::uint32_t instance, triangle;
    double until;  // area up to its end
  };
  std::vector<Face> faces;
  double area = 0;
  for (std::uint32_t i = 0; i < world.scene.instances.size(); ++i) {
    const Mesh& mesh = world.scene.meshes[world.scene.instances[i].mesh];
    for (std::uint32_t t = 0; t < mesh.triangles.size(); ++t) {
      const auto& c = mesh.triangles[t];
      const Vec3 normal =
          cross(mesh.positions[c[1]] - mesh.positions[c[0]], mesh.positions[c[2]] - mesh.positions[c[0]]);
      if (normal.y > 0) faces.push_back({i, t, area += static_cast<double>(length(normal)) / 2});
    }
  }
  std::vector<Disc> discs;
  for (std::size_t k = 0; k < count; ++k) {
    const Numbers number{k};
    const double at = area * (static_cast<double>(k) + static_cast<double>(number(10))) / static_cast<double>(count);
    const Face& f =
        *std::lower_bound(faces.begin(), faces.end() - 1, at, [](const Face& a, double x) { return a.until < x; });
    const Mesh& mesh = world.scene.meshes[world.scene.instances[f.instance].mesh];
    const auto& c = mesh.triangles[f.triangle];
    const float root = std::sqrt(number(11)), u = 1 - root, v = root * number(12);
    const Vec3 place = mesh.positions[c[0]] * u + mesh.positions[c[1]] * v + mesh.positions[c[2]] * (1 - u - v);
    SurfacePoint point = world.surfaces.at(world.surfaces.hit_at(f.instance, f.triangle, place));
    face(point, {0, 1, 0});
    discs.push_back(disc_at(point, components.of(f.instance, f.triangle), radius));
  }
  return discs;
}

}  // namespace radfarm::bench
