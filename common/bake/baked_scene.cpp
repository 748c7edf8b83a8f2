#include "bake/baked_scene.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <numbers>
#include <unordered_map>
#include <utility>

#include "radiosity/element_point.h"

namespace radfarm {
namespace {

constexpr double kMiddleGrey = 0.18;
// Backs stand so far off their fronts, of the scene's radius (0.1 mm in 8 m), for viewers that draw triangles from both sides.
constexpr float kBackGap = 0x1p-16F;

/// One side of one triangle.
struct Side {
  std::uint32_t instance = 0, triangle = 0;
  bool is_front = true;
};

/// The surface at a place of a side, turned to who looks at it.
SurfacePoint surface_at(const Surfaces& surfaces, const Side& side, const Vec3& position) {
  SurfacePoint point = surfaces.at(surfaces.hit_at(side.instance, side.triangle, position));
  face(point, side.is_front ? point.geometric_normal : -point.geometric_normal);
  return point;
}

/// Calls `visit(side, element)` with each undivided element.
template <typename Visit>
void for_each_element(const World& world, const ElementMesh& mesh, const Visit& visit) {
  std::size_t number = 0;
  std::vector<std::uint32_t> pending;
  for (std::uint32_t i = 0; i < world.scene.instances.size(); ++i) {
    const std::size_t triangles = world.scene.meshes[world.scene.instances[i].mesh].triangles.size();
    for (std::uint32_t side = 0; side < 2 * triangles; ++side) {
      if (mesh.sides[number++] != kNone) pending.push_back(mesh.sides[number - 1]);
      while (!pending.empty()) {
        const Element& element = mesh.elements[pending.back()];
        pending.pop_back();
        for (std::uint32_t c = 0; !element.is_undivided() && c < 4; ++c) pending.push_back(element.first_child + c);
        if (element.is_undivided()) visit(Side{i, side / 2, side % 2 == 0}, element);
      }
    }
  }
}

BakedMaterial::Shows shown(const Material& material, const Spectrum& emission) {
  if (!is_black(emission)) {
    return material.emission_texture.is_used() ? BakedMaterial::Shows::kEmissionTexture : BakedMaterial::Shows::kColor;
  }
  return material.base_texture.is_used() ? BakedMaterial::Shows::kBaseTexture : BakedMaterial::Shows::kColor;
}

/// Radiance, cd/m^2; less the texture that the viewer multiplies.
Spectrum radiance(const World& world, const SurfacePoint& point, BakedMaterial::Shows shows, const Spectrum& irradiance) {
  const Material& material = world.scene.materials[point.material];
  if (shows == BakedMaterial::Shows::kEmissionTexture) return material.emission;
  const Spectrum from_all_around = irradiance * kInversePi;
  if (shows == BakedMaterial::Shows::kBaseTexture) {
    return material.base_color * Spectrum(point.color[0], point.color[1], point.color[2]) * from_all_around;
  }
  return world.emission(point) + world.surfaces.reflectance(point) * from_all_around;
}

std::uint16_t to_unsigned(float value) {
  return static_cast<std::uint16_t>(std::lround(65535 * std::clamp(value, 0.0F, 1.0F)));
}

const TextureUse& texture_of(const Material& material, BakedMaterial::Shows shows) {
  return shows == BakedMaterial::Shows::kEmissionTexture ? material.emission_texture : material.base_texture;
}

BakedVertex bake_vertex(const World& world, const Side& side, BakedMaterial::Shows shows, const MeshVertex& vertex, float gain) {
  const SurfacePoint point = surface_at(world.surfaces, side, vertex.position);
  BakedVertex baked{vertex.position, {}, {0, 0}, vertex.irradiance.total()};
  if (!side.is_front) baked.position += point.shading_normal * (kBackGap * world.radius);
  const Spectrum color = radiance(world, point, shows, baked.irradiance) * gain;
  baked.color = {to_unsigned(color.r), to_unsigned(color.g), to_unsigned(color.b), to_unsigned(point.color[3])};
  if (shows != BakedMaterial::Shows::kColor) {
    const TextureUse& use = texture_of(world.scene.materials[point.material], shows);
    const Vec2& uv = point.uv[use.uv_set];
    const auto& m = use.map;
    baked.uv = {m[0] * uv.x + m[1] * uv.y + m[2], m[3] * uv.x + m[4] * uv.y + m[5]};
  }
  return baked;
}

/// The meshes of all instances, one for each side and way in which an instance's material shows.
class SceneMaker {
 public:
  SceneMaker(const World& world, const ElementMesh& mesh, BakedScene& baked)
      : world_(world), mesh_(mesh), gain_(std::exp2(baked.exposure_ev)), baked_(baked) {}

  void add(const Side& side, const Element& element) {
    if (side.instance != instance_) meshes_.clear();
    instance_ = side.instance;
    const std::uint32_t id = world_.scene.meshes[world_.scene.instances[side.instance].mesh].material;
    const Material& material = world_.scene.materials[id];
    const bool emits = side.is_front || material.emits_from_both_sides;
    const BakedMaterial::Shows shows = shown(material, emits ? material.emission : Spectrum());
    Growing& growing = mesh_of({id, shows}, side.is_front);
    triangles_.clear();
    append_triangles(mesh_, element, triangles_);
    for (const auto& triangle : triangles_) {
      std::array<std::uint32_t, 3> indices{};
      for (std::size_t k = 0; k < 3; ++k) {
        const MeshVertex& vertex = mesh_.vertices[triangle[k]];
        indices[k] = index_of(growing, triangle[k], bake_vertex(world_, side, shows, vertex, gain_));
      }
      baked_.meshes[growing.mesh].triangles.push_back(indices);
    }
  }

 private:
  struct Growing {
    std::size_t mesh = 0;
    std::unordered_map<std::uint32_t, std::vector<std::uint32_t>> known;  // by the element mesh's vertex
  };

  /// The instance's mesh that shows so. Backs are apart: one mesh with a triangle twice is a mistake to many programs.
  Growing& mesh_of(const BakedMaterial& material, bool is_front) {
    const auto found = std::find(baked_.materials.begin(), baked_.materials.end(), material);
    const auto index = static_cast<std::uint32_t>(found - baked_.materials.begin());
    if (found == baked_.materials.end()) baked_.materials.push_back(material);
    const auto [at, is_new] = meshes_.try_emplace({index, is_front});
    if (is_new) {
      const Instance& instance = world_.scene.instances[instance_];
      const std::string& name = instance.name.empty() ? world_.scene.meshes[instance.mesh].name : instance.name;
      at->second.mesh = baked_.meshes.size();
      baked_.meshes.push_back({is_front ? name : name + " (back)", index, {}, {}});
    }
    return at->second;
  }

  /// Equal vertices are one.
  std::uint32_t index_of(Growing& growing, std::uint32_t mesh_vertex, const BakedVertex& vertex) {
    std::vector<BakedVertex>& vertices = baked_.meshes[growing.mesh].vertices;
    std::vector<std::uint32_t>& known = growing.known[mesh_vertex];
    const auto same = std::find_if(known.begin(), known.end(), [&](auto i) { return vertices[i] == vertex; });
    if (same != known.end()) return *same;
    known.push_back(static_cast<std::uint32_t>(vertices.size()));
    vertices.push_back(vertex);
    return known.back();
  }

  const World& world_;
  const ElementMesh& mesh_;
  const float gain_;
  BakedScene& baked_;
  std::uint32_t instance_ = kNone;
  std::map<std::pair<std::uint32_t, bool>, Growing> meshes_;  // of this instance, by material of baked_ and side
  std::vector<std::array<std::uint32_t, 3>> triangles_;
};

/// Luminance that the middle of an element reflects, cd/m^2.
double reflected_luminance(const World& world, const ElementMesh& mesh, const Side& side, const Vec3& middle,
                           const ElementPoint& at) {
  const Spectrum irradiance = interpolate(mesh, at).total();
  return static_cast<double>(luminance(world.surfaces.reflectance(surface_at(world.surfaces, side, middle)) * irradiance)) /
         std::numbers::pi;
}

}  // namespace

BakedScene bake_mesh(const World& world, const ElementMesh& mesh, float exposure_ev) {
  BakedScene baked;
  baked.exposure_ev = exposure_ev;
  SceneMaker maker(world, mesh, baked);
  for_each_element(world, mesh, [&](const Side& side, const Element& element) { maker.add(side, element); });
  return baked;
}

float auto_exposure(const World& world, const ElementMesh& mesh) {
  double area = 0, sum = 0;
  for_each_element(world, mesh, [&](const Side& side, const Element& element) {
    const TriangleVertices v = corners_of(mesh, element);
    const auto index = static_cast<std::uint32_t>(&element - mesh.elements.data());
    const double light = reflected_luminance(world, mesh, side, (v[0] + v[1] + v[2]) / 3, {index, 1.0 / 3, 1.0 / 3});
    if (!(light > 0)) return;
    const auto element_area = static_cast<double>(area_of(v));
    area += element_area;
    sum += element_area * std::log2(light);
  });
  return area > 0 ? static_cast<float>(std::log2(kMiddleGrey) - sum / area) : 0;
}

}  // namespace radfarm
