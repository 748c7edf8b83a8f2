#include "scene/surface.h"

#include <algorithm>
#include <cmath>

#include "scene/texture.h"

namespace radfarm {
namespace {

// Embree's triangle test and the transforms before it err by a few ulps of the largest vertex coordinate; 64 ulps (2^-18)
// covers them with room, and scales with the scene: no absolute length enters.
constexpr float kOffsetUlps = 64 * 0x1p-24F;

Vec3 transform_point(const Vec3& p, const Matrix4& m) {
  return {p.x * m[0][0] + p.y * m[1][0] + p.z * m[2][0] + m[3][0],
          p.x * m[0][1] + p.y * m[1][1] + p.z * m[2][1] + m[3][1],
          p.x * m[0][2] + p.y * m[1][2] + p.z * m[2][2] + m[3][2]};
}

template <typename T>
T interpolate(const std::vector<T>& values, const std::array<std::uint32_t, 3>& index, float u, float v) {
  return values[index[0]] * (1 - u - v) + values[index[1]] * u + values[index[2]] * v;
}

bool texture_has_alpha(const Texture& texture) {
  return std::any_of(texture.texels.begin(), texture.texels.end(), [](const auto& t) { return t[3] < 255; });
}

bool has_holes(const Scene& scene, const Mesh& mesh) {
  const Material& material = scene.materials[mesh.material];
  if (material.alpha_mode == Material::Alpha::kOpaque) return false;
  const bool vertex_alpha = std::any_of(mesh.colors.begin(), mesh.colors.end(), [](const auto& c) { return c[3] < 1; });
  return material.alpha < 1 || vertex_alpha ||
         (material.base_texture.is_used() && texture_has_alpha(scene.textures[material.base_texture.texture]));
}

/// Whether a point of the material may be a pane: a roughness texture only makes it smoother.
bool may_be_pane(const Material& m) {
  const bool is_smooth = m.roughness * m.roughness < kLeastAlpha || m.metallic_roughness_texture.is_used();
  return m.transmission > 0 && !m.has_volume && is_smooth && (m.metallic < 1 || m.metallic_roughness_texture.is_used());
}

Vec2 moved(const TextureUse& use, const std::array<Vec2, 2>& uv) {
  const Vec2& at = uv[use.uv_set];
  const auto& m = use.map;
  return {m[0] * at.x + m[1] * at.y + m[2], m[3] * at.x + m[4] * at.y + m[5]};
}

Vec4 look_up(const Scene& scene, const TextureUse& use, const std::array<Vec2, 2>& uv) {
  return use.is_used() ? texture_lookup(scene.textures[use.texture], moved(use, uv)) : Vec4(1, 1, 1, 1);
}

Spectrum color(const Vec4& texel) { return {texel.x, texel.y, texel.z}; }

std::array<Vec2, 2> interpolate_uv(const Mesh& mesh, const std::array<std::uint32_t, 3>& index, float u, float v) {
  std::array<Vec2, 2> uv{Vec2(0, 0), Vec2(0, 0)};
  for (std::size_t set = 0; set < 2; ++set) {
    if (!mesh.uv[set].empty()) uv[set] = interpolate(mesh.uv[set], index, u, v);
  }
  return uv;
}

/// A tangent along u and the handedness of its bitangent.
struct Tangent {
  Vec3 along{0, 0, 0};
  float handedness = 1;
};

/// From the mesh's UVs: along growing u; the bitangent points up the image, against growing v.
Tangent tangent_of_uv(const std::array<Vec3, 3>& p, const std::array<Vec2, 3>& uv, const Vec3& normal) {
  const Vec2 a = uv[1] - uv[0], b = uv[2] - uv[0];
  const float turn = a.x * b.y - a.y * b.x;
  if (turn == 0) return {};
  const Vec3 e1 = p[1] - p[0], e2 = p[2] - p[0];
  const Vec3 along = (e1 * b.y - e2 * a.y) / turn, down = (e2 * a.x - e1 * b.x) / turn;
  return {normalize(along), dot(cross(normal, along), down) > 0 ? -1.0F : 1.0F};
}

/// The part of the tangent across the normal, unit; the zero vector when nothing is left.
Vec3 across(const Vec3& tangent, const Vec3& normal) { return normalize(tangent - normal * dot(tangent, normal)); }

/// Turns the shading normal towards the geometric one until the viewer sees it, and its mirror image of the viewer lies above the
/// surface: otherwise bumps seen at a slant show black.
void straighten(SurfacePoint& point, const Vec3& to_viewer) {
  const Vec3 g = point.geometric_normal, bent = point.shading_normal;
  const auto is_seen = [&](const Vec3& n) {
    const float cosine = dot(n, to_viewer);
    return cosine > 0 && 2 * cosine * dot(n, g) > dot(to_viewer, g);  // the mirrored direction is above the surface
  };
  if (bent == g || is_seen(bent)) return;
  float least = 0, most = 1;  // share of the geometric normal
  for (int i = 0; i < 10; ++i) {
    const float middle = (least + most) / 2;
    (is_seen(normalize(bent * (1 - middle) + g * middle)) ? most : least) = middle;
  }
  point.shading_normal = normalize(bent * (1 - most) + g * most);
}

std::array<UvFootprint, 2> footprint_of(const Mesh& mesh, const std::array<std::uint32_t, 3>& index, const TriangleVertices& corners,
                                        const SurfaceFootprint& footprint) {
  std::array<UvFootprint, 2> in_uv = {};
  for (std::size_t set = 0; set < 2; ++set) {
    const std::vector<Vec2>& uv = mesh.uv[set];
    if (!uv.empty()) in_uv[set] = to_uv(footprint, corners, {uv[index[0]], uv[index[1]], uv[index[2]]});
  }
  return in_uv;
}

/// What of a material is looked up over a footprint.
std::array<const TextureUse*, 6> filtered_uses(const Material& m) {
  return {&m.base_texture,           &m.emission_texture,  &m.specular_texture,
          &m.specular_color_texture, &m.clearcoat_texture, &m.sheen_color_texture};
}

bool is_filtered(const Material& m) {
  const auto uses = filtered_uses(m);
  return std::any_of(uses.begin(), uses.end(), [](const TextureUse* use) { return use->is_used(); });
}

std::vector<TexturePyramid> make_pyramids(const Scene& scene) {
  std::vector<bool> is_used(scene.textures.size()), is_cut_out(scene.textures.size());
  for (const Material& m : scene.materials) {
    for (const TextureUse* use : filtered_uses(m)) {
      if (use->is_used()) is_used[use->texture] = true;
    }
    if (m.base_texture.is_used() && m.alpha_mode != Material::Alpha::kOpaque) is_cut_out[m.base_texture.texture] = true;
  }
  std::vector<TexturePyramid> pyramids(scene.textures.size());
  for (std::size_t i = 0; i < pyramids.size(); ++i) {
    if (is_used[i]) pyramids[i] = make_pyramid(scene.textures[i], is_cut_out[i] ? ColorWeight::kAlpha : ColorWeight::kEven);
  }
  return pyramids;
}

}  // namespace

Surfaces::Surfaces(const Scene& scene) : scene_(&scene), pyramids_(make_pyramids(scene)) {
  for (const Instance& instance : scene.instances) {
    const Matrix4d inverse = Matrix4d(instance.to_world).inverse();
    const Matrix4d& to_world = Matrix4d(instance.to_world);
    Matrix4 normals;
    for (int row = 0; row < 3; ++row) {
      for (int column = 0; column < 3; ++column) normals[row][column] = static_cast<float>(inverse[column][row]);
    }
    const Vec3d x(to_world[0][0], to_world[0][1], to_world[0][2]), y(to_world[1][0], to_world[1][1], to_world[1][2]),
        z(to_world[2][0], to_world[2][1], to_world[2][2]);
    placements_.push_back({normals, dot(cross(x, y), z) < 0});
  }
  for (const Mesh& mesh : scene.meshes) {
    mesh_is_pane_.push_back(may_be_pane(scene.materials[mesh.material]));
    mesh_lets_through_.push_back(mesh_is_pane_.back() || has_holes(scene, mesh));
    mesh_has_pyramid_.push_back(is_filtered(scene.materials[mesh.material]));
  }
}

TriangleVertices Surfaces::triangle(std::uint32_t instance, std::uint32_t triangle) const {
  const Instance& placed = scene_->instances[instance];
  const Mesh& mesh = scene_->meshes[placed.mesh];
  const auto& index = mesh.triangles[triangle];
  TriangleVertices vertices = {transform_point(mesh.positions[index[0]], placed.to_world),
                               transform_point(mesh.positions[index[1]], placed.to_world),
                               transform_point(mesh.positions[index[2]], placed.to_world)};
  if (placements_[instance].is_mirrored) std::swap(vertices[1], vertices[2]);
  return vertices;
}

Hit Surfaces::hit_at(std::uint32_t instance, std::uint32_t triangle, const Vec3& position) const {
  const TriangleVertices whole = this->triangle(instance, triangle);
  const Vec3d e1 = to_double(whole[1]) - to_double(whole[0]), e2 = to_double(whole[2]) - to_double(whole[0]);
  const Vec3d d = to_double(position) - to_double(whole[0]), normal = cross(e1, e2);
  const double area = dot(normal, normal);
  double b = std::max(0.0, dot(cross(d, e2), normal) / area), c = std::max(0.0, dot(cross(e1, d), normal) / area);
  const double sum = b + c;
  if (sum > 1) b /= sum, c /= sum;
  const auto u = static_cast<float>(b), v = static_cast<float>(c);
  return is_mirrored(instance) ? Hit{instance, triangle, v, u, 0} : Hit{instance, triangle, u, v, 0};
}

SurfacePoint Surfaces::at(const Hit& hit) const { return place(hit, nullptr); }

SurfacePoint Surfaces::met(const Hit& hit, const Ray& ray) const {
  SurfacePoint point = place(hit, &ray);
  face(point, -ray.direction);
  return point;
}

SurfacePoint Surfaces::place(const Hit& hit, const Ray* ray) const {
  const Instance& placed = scene_->instances[hit.instance];
  const Placement& placement = placements_[hit.instance];
  const Mesh& mesh = scene_->meshes[placed.mesh];
  const auto& index = mesh.triangles[hit.triangle];
  const Vec3 p0 = transform_point(mesh.positions[index[0]], placed.to_world);
  const Vec3 p1 = transform_point(mesh.positions[index[1]], placed.to_world);
  const Vec3 p2 = transform_point(mesh.positions[index[2]], placed.to_world);

  SurfacePoint point;
  point.position = p0 * (1 - hit.u - hit.v) + p1 * hit.u + p2 * hit.v;
  const Vec3 normal = cross(p1 - p0, p2 - p0);
  // Tiny triangles can have an area below the smallest float square: normalise in double.
  point.geometric_normal = to_float(normalize(to_double(placement.is_mirrored ? -normal : normal)));
  point.offset = kOffsetUlps * std::max({max_abs_component(p0), max_abs_component(p1), max_abs_component(p2)});
  point.material = mesh.material;
  point.shading_normal = point.geometric_normal;
  if (!mesh.normals.empty()) {
    Vec3 shading;
    placement.normal_to_world.multDirMatrix(interpolate(mesh.normals, index, hit.u, hit.v), shading);
    shading = normalize(shading);
    // A file's normals may point to either side; the triangle's winding decides which side is the front.
    if (dot(shading, point.geometric_normal) < 0) shading = -shading;
    if (dot(shading, point.geometric_normal) > 0) point.shading_normal = shading;
  }
  point.uv = interpolate_uv(mesh, index, hit.u, hit.v);
  if (!mesh.colors.empty()) {
    for (std::size_t k = 0; k < 4; ++k) {
      point.color[k] = mesh.colors[index[0]][k] * (1 - hit.u - hit.v) + mesh.colors[index[1]][k] * hit.u +
                       mesh.colors[index[2]][k] * hit.v;
    }
  }
  if (ray != nullptr) {
    point.cone = advance(ray->cone, hit.distance);
    if (point.cone.width > 0 && mesh_has_pyramid_[placed.mesh]) {
      const SurfaceFootprint footprint = cone_on_plane(point.geometric_normal, ray->direction, point.cone.width);
      point.footprint = footprint_of(mesh, index, {p0, p1, p2}, footprint);
    }
  }
  const Material& material = scene_->materials[mesh.material];
  if (material.normal_texture.is_used() || material.anisotropy > 0) bend(hit, {p0, p1, p2}, point);
  return point;
}

SurfacePoint Surfaces::at_part(const Hit& hit, float share) const {
  SurfacePoint point = at(hit);
  const std::uint32_t mesh = scene_->instances[hit.instance].mesh;
  if (!mesh_has_pyramid_[mesh]) return point;
  const auto& index = scene_->meshes[mesh].triangles[hit.triangle];
  for (std::size_t set = 0; set < 2; ++set) {
    const std::vector<Vec2>& uv = scene_->meshes[mesh].uv[set];
    if (!uv.empty()) point.footprint[set] = {(uv[index[1]] - uv[index[0]]) * share, (uv[index[2]] - uv[index[0]]) * share};
  }
  return point;
}

Vec4 Surfaces::look_up_footprint(const TextureUse& use, const SurfacePoint& point) const {
  if (!use.is_used()) return {1, 1, 1, 1};
  const Texture& texture = scene_->textures[use.texture];
  const UvFootprint& footprint = point.footprint[use.uv_set];
  if (footprint.is_point()) return texture_lookup(texture, moved(use, point.uv));
  return filtered_lookup(texture, pyramids_[use.texture], moved(use, point.uv), moved(footprint, use.map));
}

/// Gives the point its tangent, and of a normal map its normal.
void Surfaces::bend(const Hit& hit, const TriangleVertices& p, SurfacePoint& point) const {
  const Instance& placed = scene_->instances[hit.instance];
  const Mesh& mesh = scene_->meshes[placed.mesh];
  const Material& material = scene_->materials[mesh.material];
  const auto& index = mesh.triangles[hit.triangle];
  Tangent tangent;
  if (!mesh.tangents.empty()) {
    Vec3 sum(0, 0, 0);
    const std::array<float, 3> weights = {1 - hit.u - hit.v, hit.u, hit.v};
    for (std::size_t k = 0; k < 3; ++k) {
      const auto& t = mesh.tangents[index[k]];
      sum += Vec3(t[0], t[1], t[2]) * weights[k];
    }
    placed.to_world.multDirMatrix(sum, tangent.along);
    const float mirrored = placements_[hit.instance].is_mirrored ? -1.0F : 1.0F;
    tangent.handedness = mesh.tangents[index[0]][3] * mirrored;
  } else if (const auto& uv = mesh.uv[material.normal_texture.uv_set]; !uv.empty()) {
    tangent = tangent_of_uv(p, {uv[index[0]], uv[index[1]], uv[index[2]]}, point.shading_normal);
  }
  const Vec3 n = point.shading_normal, t = across(tangent.along, n);
  if (t == Vec3(0, 0, 0)) return;
  point.tangent = t;
  if (!material.normal_texture.is_used()) return;
  const Vec4 texel = look_up(*scene_, material.normal_texture, point.uv);
  const Vec3 local((2 * texel.x - 1) * material.normal_scale, (2 * texel.y - 1) * material.normal_scale, 2 * texel.z - 1);
  const Vec3 bent = normalize(t * local.x + cross(n, t) * (tangent.handedness * local.y) + n * local.z);
  // A normal below the surface would show the light of its other side.
  if (dot(bent, point.geometric_normal) > 0) point.shading_normal = bent;
}

Matter Surfaces::matter(const SurfacePoint& point) const {
  const Material& m = scene_->materials[point.material];
  const auto look = [&](const TextureUse& use) { return look_up(*scene_, use, point.uv); };
  const auto look_around = [&](const TextureUse& use) { return look_up_footprint(use, point); };
  Matter matter;
  matter.base = m.base_color * Spectrum(point.color[0], point.color[1], point.color[2]);
  if (m.base_texture.is_used()) matter.base *= color(look_around(m.base_texture));
  if (m.is_lambertian()) return matter;
  matter.metallic = m.metallic, matter.roughness = m.roughness;
  if (m.metallic_roughness_texture.is_used()) {
    const Vec4 texel = look(m.metallic_roughness_texture);
    matter.roughness *= texel.y, matter.metallic *= texel.z;
  }
  matter.specular = m.specular * look_around(m.specular_texture).w;
  matter.specular_color = m.specular_color * color(look_around(m.specular_color_texture));
  matter.ior = m.ior;
  matter.transmission = m.transmission * look(m.transmission_texture).x;
  matter.has_volume = m.has_volume;
  matter.clearcoat = m.clearcoat * look_around(m.clearcoat_texture).x;
  matter.clearcoat_roughness = m.clearcoat_roughness * look(m.clearcoat_roughness_texture).y;
  matter.sheen = m.sheen_color * color(look_around(m.sheen_color_texture));
  matter.sheen_roughness = m.sheen_roughness * look(m.sheen_roughness_texture).w;
  matter.anisotropy = m.anisotropy, matter.anisotropy_rotation = m.anisotropy_rotation;
  matter.folds_specular = m.folds_specular;
  return matter;
}

Spectrum Surfaces::absorption(const SurfacePoint& point, float distance) const {
  const Material& m = scene_->materials[point.material];
  if (!m.has_volume || m.transmission == 0 || point.is_front || !(m.attenuation_distance > 0)) return Spectrum(1.0F);
  const float share = distance / m.attenuation_distance;  // Beer and Lambert
  const Spectrum& c = m.attenuation_color;
  return {std::pow(c.r, share), std::pow(c.g, share), std::pow(c.b, share)};
}

Spectrum Surfaces::reflectance(const SurfacePoint& point) const { return mean_reflectance(matter(point)); }

Spectrum Surfaces::reflectance(const SurfacePoint& point, float cosine) const {
  return radfarm::reflectance(matter(point), cosine);
}

Spectrum Surfaces::emission(const SurfacePoint& point) const {
  const Material& material = scene_->materials[point.material];
  if (is_black(material.emission) || !(point.is_front || material.emits_from_both_sides)) return {};
  if (!material.emission_texture.is_used()) return material.emission;
  return material.emission * color(look_up_footprint(material.emission_texture, point));
}

float Surfaces::coverage(const Hit& hit) const {
  const Mesh& mesh = scene_->meshes[scene_->instances[hit.instance].mesh];
  const Material& material = scene_->materials[mesh.material];
  if (material.alpha_mode == Material::Alpha::kOpaque) return 1;
  const auto& index = mesh.triangles[hit.triangle];
  float alpha = material.alpha;
  if (!mesh.colors.empty()) {
    alpha *= mesh.colors[index[0]][3] * (1 - hit.u - hit.v) + mesh.colors[index[1]][3] * hit.u +
             mesh.colors[index[2]][3] * hit.v;
  }
  if (material.base_texture.is_used()) {
    alpha *= look_up(*scene_, material.base_texture, interpolate_uv(mesh, index, hit.u, hit.v)).w;
  }
  if (material.alpha_mode == Material::Alpha::kMask) return alpha >= material.alpha_cutoff ? 1.0F : 0.0F;
  return std::clamp(alpha, 0.0F, 1.0F);
}

Spectrum Surfaces::passage(const Hit& hit, const Vec3& direction) const {
  const float stops = coverage(hit);
  if (!mesh_is_pane_[scene_->instances[hit.instance].mesh] || stops == 0) return Spectrum(1 - stops);
  const SurfacePoint point = at(hit);
  const float cosine = std::fabs(dot(point.geometric_normal, direction)) / length(direction);
  return Spectrum(1 - stops) + pane_passage(matter(point), cosine) * stops;
}

Bsdf bsdf_at(const Surfaces& surfaces, SurfacePoint& point, const Vec3& to_viewer) {
  const Matter matter = surfaces.matter(point);
  if (!matter.is_lambertian()) straighten(point, to_viewer);
  Frame frame(point.shading_normal);
  if (point.tangent != Vec3(0, 0, 0)) {
    frame.tangent = across(point.tangent, point.shading_normal);
    frame.bitangent = cross(point.shading_normal, frame.tangent);
  }
  return Bsdf(matter, frame, to_viewer, point.is_front);
}

void face(SurfacePoint& point, const Vec3& to_viewer) {
  if (dot(point.geometric_normal, to_viewer) >= 0) return;
  point.geometric_normal = -point.geometric_normal;
  point.shading_normal = -point.shading_normal;
  point.is_front = !point.is_front;
}

}  // namespace radfarm
