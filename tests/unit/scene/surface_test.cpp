#include "scene/surface.h"

#include <cmath>

#include <gtest/gtest.h>

#include "base/random.h"
#include "math/sampling.h"
#include "scene/texture_uses.h"
#include "support/small_scenes.h"

namespace radfarm {
namespace {

// Positions of up to 4 m go through a few roundings of floats, the inverse back through doubles: 8 ulps of the largest.
constexpr float kRounding = 4 * 8 * 0x1p-24F;

/// An oblique quad, placed as it is, turned and stretched, and mirrored.
Scene three_quads() {
  test::SceneMaker maker;
  maker.polygon(maker.material(Spectrum(0.5F)), {{0, 0, 0.5F}, {1, 0.1F, 0}, {1.2F, 1, 0.3F}, {-0.1F, 0.9F, 0.8F}});
  Scene scene = maker.take();
  Instance turned = scene.instances[0], mirrored = scene.instances[0];
  turned.to_world = Matrix4(0, 2, 0, 0, -1, 0, 0.5F, 0, 0, 0, 3, 0, 0.5F, -1, 0.25F, 1);
  mirrored.to_world = Matrix4(-1.5F, 0, 0, 0, 0, 1, 0.25F, 0, 0, 0, 1, 0, 0.5F, 1, -1, 1);
  scene.instances.insert(scene.instances.end(), {turned, mirrored});
  return scene;
}

TEST(Surfaces, HitAtInvertsAt) {
  const Scene scene = three_quads();
  const Surfaces surfaces(scene);
  ASSERT_FALSE(surfaces.is_mirrored(1));
  ASSERT_TRUE(surfaces.is_mirrored(2));
  RandomSequence random(1);
  for (int n = 0; n < 20'000; ++n) {
    const auto instance = static_cast<std::uint32_t>(n % 3), triangle = static_cast<std::uint32_t>(n / 3 % 2);
    const Vec3 b = sample_uniform_triangle({random.uniform(), random.uniform()});
    const Hit hit{instance, triangle, b.y, b.z, 0};
    const Vec3 position = surfaces.at(hit).position;
    const Hit again = surfaces.hit_at(instance, triangle, position);
    EXPECT_EQ(again.instance, instance);
    EXPECT_EQ(again.triangle, triangle);
    EXPECT_LT(length(surfaces.at(again).position - position), kRounding);
    // Triangles of about 1 m: weights round as positions do.
    EXPECT_NEAR(again.u, hit.u, 4 * kRounding);
    EXPECT_NEAR(again.v, hit.v, 4 * kRounding);
  }
}

TEST(Surfaces, HitAtFindsTheVertices) {
  const Scene scene = three_quads();
  const Surfaces surfaces(scene);
  for (std::uint32_t instance = 0; instance < 3; ++instance) {
    for (const Vec3& vertex : surfaces.triangle(instance, 1)) {
      EXPECT_LT(length(surfaces.at(surfaces.hit_at(instance, 1, vertex)).position - vertex), kRounding);
    }
  }
}

TEST(Surfaces, HitAtStaysInTheTriangle) {
  // Of a position beside the triangle, whichever edge or corner it lies beyond.
  const Scene scene = three_quads();
  const Surfaces surfaces(scene);
  RandomSequence random(2);
  std::size_t outside = 0;
  float worst = 0;
  for (int n = 0; n < 3'000; ++n) {
    const auto instance = static_cast<std::uint32_t>(n % 3);
    const TriangleVertices v = surfaces.triangle(instance, 0);
    const float b = 4 * random.uniform() - 1.5F, c = 4 * random.uniform() - 1.5F;
    const Hit hit = surfaces.hit_at(instance, 0, v[0] * (1 - b - c) + v[1] * b + v[2] * c);
    EXPECT_GE(hit.u, 0);
    EXPECT_GE(hit.v, 0);
    outside += hit.u + hit.v > 1 + 0x1p-22F;
    worst = std::max(worst, hit.u + hit.v);
  }
  EXPECT_EQ(outside, 0U) << "u + v up to " << worst;
}

// Codes of 8 bits through sRGB-free lookups of 1 x 1 textures: a few roundings.
constexpr float kCodeRounding = 16 * 0x1p-24F;

using Texel = std::array<std::uint8_t, 4>;

Texture texture_of(std::vector<Texel> texels) {
  Texture texture{static_cast<std::uint32_t>(texels.size()), 1, false, Texture::Wrap::kClamp, Texture::Wrap::kClamp, {}};
  texture.texels = std::move(texels);
  return texture;
}

/// A unit square in the xy-plane, front to +z, as an image hangs on a wall: u to +x, v down.
Scene picture(const Texture& texture) {
  test::SceneMaker maker;
  maker.polygon(maker.material(Spectrum(0.5F)), {{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0}});
  Scene scene = maker.take();
  scene.textures.push_back(texture);
  scene.meshes[0].uv[0] = {{0, 1}, {1, 1}, {1, 0}, {0, 0}};
  return scene;
}

SurfacePoint point_of(const Scene& scene, float u = 0.25F, float v = 0.25F) {
  return Surfaces(scene).at({0, 0, u, v, 0});
}

void expect_near(const Spectrum& a, const Spectrum& b) {
  EXPECT_NEAR(a.r, b.r, kCodeRounding);
  EXPECT_NEAR(a.g, b.g, kCodeRounding);
  EXPECT_NEAR(a.b, b.b, kCodeRounding);
}

// Tilted to +u and a little up: (1, 0.0039, 0.0039) and its like; what is left of the codes' steps is 0.4 degrees.
constexpr Texel kTowardsU{255, 128, 128, 255};
constexpr Texel kUpTheImage{128, 255, 128, 255};
constexpr float kTilted = 0.99F;

Scene bumpy(const Texel& texel) {
  Scene scene = picture(texture_of({texel}));
  scene.materials[0].normal_texture.texture = 0;
  return scene;
}

Vec3 normal_of(const Scene& scene) { return point_of(scene).shading_normal; }

void add_tangents(Scene& scene, const Vec3& along, float handedness) {
  for (Mesh& mesh : scene.meshes) {
    mesh.tangents.assign(mesh.positions.size(), {along.x, along.y, along.z, handedness});
  }
}

void mirror_x(Scene& scene) { scene.instances[0].to_world[0][0] = -1; }

TEST(NormalMap, TurnsTheNormalTowardsGrowingUAndUpTheImage) {
  EXPECT_GT(normal_of(bumpy(kTowardsU)).x, kTilted);
  EXPECT_GT(normal_of(bumpy(kUpTheImage)).y, kTilted);
  EXPECT_EQ(point_of(bumpy(kTowardsU)).geometric_normal, Vec3(0, 0, 1));
  EXPECT_EQ(point_of(bumpy(kTowardsU)).tangent, Vec3(1, 0, 0));
}

TEST(NormalMap, DoesTheSameWithTangentsFromTheFile) {
  for (const auto& [texel, expected] : {std::pair(kTowardsU, Vec3(1, 0, 0)), std::pair(kUpTheImage, Vec3(0, 1, 0))}) {
    Scene scene = bumpy(texel);
    add_tangents(scene, {1, 0, 0}, 1);
    EXPECT_GT(dot(normal_of(scene), expected), kTilted);
  }
}

TEST(NormalMap, FollowsTheFilesTangentsAndHandedness) {
  Scene scene = bumpy(kTowardsU);
  add_tangents(scene, {0, 1, 0}, 1);
  EXPECT_GT(normal_of(scene).y, kTilted);
  scene = bumpy(kUpTheImage);
  add_tangents(scene, {1, 0, 0}, -1);
  EXPECT_LT(normal_of(scene).y, -kTilted);
}

TEST(NormalMap, MirrorsWithItsInstance) {
  for (const bool has_tangents : {false, true}) {
    for (const auto& [texel, expected] : {std::pair(kTowardsU, Vec3(-1, 0, 0)), std::pair(kUpTheImage, Vec3(0, 1, 0))}) {
      Scene scene = bumpy(texel);
      if (has_tangents) add_tangents(scene, {1, 0, 0}, 1);
      mirror_x(scene);
      EXPECT_EQ(point_of(scene).geometric_normal, Vec3(0, 0, 1));
      EXPECT_GT(dot(normal_of(scene), expected), kTilted) << has_tangents;
    }
  }
}

TEST(NormalMap, OnMirroredCoordinatesTurnsTowardsTheirGrowingU) {
  for (const auto& [texel, expected] : {std::pair(kTowardsU, Vec3(-1, 0, 0)), std::pair(kUpTheImage, Vec3(0, 1, 0))}) {
    Scene scene = bumpy(texel);
    for (Vec2& uv : scene.meshes[0].uv[0]) uv.x = 1 - uv.x;
    EXPECT_GT(dot(normal_of(scene), expected), kTilted);
  }
}

TEST(NormalMap, ScalesItsSlopeAndRoundsFlatCodesToNothing) {
  Scene scene = bumpy({255, 128, 255, 255});  // 45 degrees
  scene.materials[0].normal_scale = 0.5F;
  EXPECT_NEAR(std::atan2(normal_of(scene).x, normal_of(scene).z), std::atan(0.5F), 1e-5F);
  EXPECT_GT(normal_of(bumpy({128, 128, 255, 255})).z, 0.9999F);
}

TEST(NormalMap, NeverTurnsTheNormalBelowTheSurface) {
  EXPECT_EQ(normal_of(bumpy({255, 128, 0, 255})), Vec3(0, 0, 1));
}

TEST(NormalMap, TurnsWithTheSideThatIsSeen) {
  SurfacePoint point = point_of(bumpy(kTowardsU));
  face(point, {0, 0, -1});
  EXPECT_FALSE(point.is_front);
  EXPECT_LT(point.shading_normal.x, -kTilted);
}

TEST(TextureTransform, MovesScalesAndTurnsTheCoordinates) {
  Scene scene = picture(texture_of({{255, 0, 0, 255}, {0, 255, 0, 255}, {0, 0, 255, 255}, {255, 255, 255, 255}}));
  scene.materials[0].base_color = Spectrum(1.0F);
  TextureUse& use = scene.materials[0].base_texture;
  use.texture = 0;
  // Hit (0.1, 0.025) of the triangle (0,1) (1,1) (1,0): uv = (0.125, 0.975), the middle of texel 0.
  const auto color = [&] { return Surfaces(scene).matter(point_of(scene, 0.1F, 0.025F)).base; };
  expect_near(color(), {1, 0, 0});
  use.map = {1, 0, 0.5F, 0, 1, 0};
  expect_near(color(), {0, 0, 1});
  use.map = {3, 0, 0, 0, 1, 0};
  expect_near(color(), {0, 1, 0});
  use.map = {0, 1, -0.1F, 1, 0, 0};  // u' = v - 0.1 = 0.875
  expect_near(color(), {1, 1, 1});
}

TEST(TextureTransform, IsOfItsUseAndItsUvSetAlone) {
  Scene scene = picture(texture_of({{0, 0, 0, 0}, {255, 255, 255, 255}}));
  scene.meshes[0].uv[1].assign(4, Vec2(0.75F, 0.5F));
  Material& m = scene.materials[0];
  m.specular = m.clearcoat = 1;
  m.specular_texture = {0, 0, {0, 0, 0.25F, 0, 0, 0}};
  m.clearcoat_texture = {0, 1};
  const Matter matter = Surfaces(scene).matter(point_of(scene));
  EXPECT_EQ(matter.specular, 0);
  EXPECT_EQ(matter.clearcoat, 1);
}

/// A material with all factors 0.5 and all textures (0.2, 0.4, 0.6, 0.8).
Scene textured() {
  Scene scene = picture(texture_of({{51, 102, 153, 204}}));
  Material& m = scene.materials[0];
  m.metallic = m.roughness = m.specular = m.transmission = m.clearcoat = m.clearcoat_roughness = m.sheen_roughness = 0.5F;
  m.specular_color = m.sheen_color = Spectrum(0.5F);
  return scene;
}

TEST(Matter, TakesEachTexturesOwnChannels) {
  Scene scene = textured();
  for (TextureUse* use : texture_uses(scene.materials[0])) use->texture = 0;
  const Matter m = Surfaces(scene).matter(point_of(scene));
  const Spectrum half_color(0.1F, 0.2F, 0.3F);
  expect_near(m.base, half_color);
  EXPECT_NEAR(m.roughness, 0.2F, kCodeRounding) << "green";
  EXPECT_NEAR(m.metallic, 0.3F, kCodeRounding) << "blue";
  EXPECT_NEAR(m.specular, 0.4F, kCodeRounding) << "alpha";
  expect_near(m.specular_color, half_color);
  EXPECT_NEAR(m.transmission, 0.1F, kCodeRounding) << "red";
  EXPECT_NEAR(m.clearcoat, 0.1F, kCodeRounding) << "red";
  EXPECT_NEAR(m.clearcoat_roughness, 0.2F, kCodeRounding) << "green";
  expect_near(m.sheen, half_color);
  EXPECT_NEAR(m.sheen_roughness, 0.4F, kCodeRounding) << "alpha";
}

TEST(Matter, EachTextureChangesNothingElse) {
  const Matter plain = Surfaces(textured()).matter(point_of(textured()));
  for (std::size_t k = 0; k < texture_uses(textured().materials[0]).size(); ++k) {
    Scene scene = textured();
    texture_uses(scene.materials[0])[k]->texture = 0;
    const Matter m = Surfaces(scene).matter(point_of(scene));
    int changed = 0;
    for (const bool is_other :
         {m.base != plain.base, m.metallic != plain.metallic, m.roughness != plain.roughness, m.specular != plain.specular,
          m.specular_color != plain.specular_color, m.transmission != plain.transmission, m.clearcoat != plain.clearcoat,
          m.clearcoat_roughness != plain.clearcoat_roughness, m.sheen != plain.sheen,
          m.sheen_roughness != plain.sheen_roughness}) {
      changed += is_other ? 1 : 0;
    }
    const TextureUse* use = texture_uses(scene.materials[0])[k];
    const bool is_pair = use == &scene.materials[0].metallic_roughness_texture;
    const bool is_none = use == &scene.materials[0].normal_texture || use == &scene.materials[0].emission_texture;
    EXPECT_EQ(changed, is_pair ? 2 : is_none ? 0 : 1) << k;
  }
}

TEST(Matter, TakesPlainNumbersAndVertexColours) {
  Scene scene = textured();
  Material& m = scene.materials[0];
  m.ior = 1.75F, m.has_volume = true, m.anisotropy = 0.25F, m.anisotropy_rotation = 2;
  scene.meshes[0].colors.assign(4, {0.25F, 0.5F, 1, 1});
  const Matter matter = Surfaces(scene).matter(point_of(scene));
  EXPECT_EQ(matter.ior, 1.75F);
  EXPECT_TRUE(matter.has_volume);
  EXPECT_EQ(matter.anisotropy, 0.25F);
  EXPECT_EQ(matter.anisotropy_rotation, 2);
  expect_near(matter.base, {0.125F, 0.25F, 0.5F});
}

/// Black and white texels by turns.
Texture checker(std::uint32_t size) {
  Texture texture{size, size, false, Texture::Wrap::kRepeat, Texture::Wrap::kRepeat, {}};
  for (std::uint32_t i = 0; i < size * size; ++i) {
    const std::uint8_t code = (i + i / size) % 2 == 0 ? 255 : 0;
    texture.texels.push_back({code, code, code, 255});
  }
  return texture;
}

// Levels of a texture are coded to 16 bits.
constexpr float kLevelCode = 0.5F / 65535 + 64 * 0x1p-24F;

/// The base colour that a ray with a cone of this spread sees at slanted points of the picture, one metre away: least and most.
std::pair<float, float> seen_range(const Scene& scene, float spread) {
  const Surfaces surfaces(scene);
  RandomSequence random(5);
  float least = 1, most = 0;
  for (int i = 0; i < 200; ++i) {
    const Hit hit{0, static_cast<std::uint32_t>(i % 2), random.uniform() / 2, random.uniform() / 2, 1};
    const float base = surfaces.matter(surfaces.met(hit, {{0, 0, 1}, normalize(Vec3(0.6F, 0, -0.8F)), {0, spread, 1}})).base.r;
    least = std::min(least, base), most = std::max(most, base);
  }
  return {least, most};
}

TEST(Met, ALineSeesTexelsAndAFarPixelTheMean) {
  Scene scene = picture(checker(64));
  scene.materials[0].base_color = Spectrum(1.0F);
  scene.materials[0].base_texture.texture = 0;
  const auto [dark, bright] = seen_range(scene, 0);
  EXPECT_LT(dark, 0.1F);
  EXPECT_GT(bright, 0.9F);
  const auto [least, most] = seen_range(scene, 4.0F / 64);  // four texels a pixel: one sample is enough
  EXPECT_NEAR(least, 0.5F, kLevelCode);
  EXPECT_NEAR(most, 0.5F, kLevelCode);
}

TEST(Met, FiltersWhatLightIsProportionalToAndNothingElse) {
  Scene scene = picture(checker(64));
  Material& m = scene.materials[0];
  for (TextureUse* use : texture_uses(m)) use->texture = 0;
  m.base_color = m.emission = m.specular_color = m.sheen_color = Spectrum(1.0F);
  m.metallic = m.transmission = m.clearcoat = m.clearcoat_roughness = m.sheen_roughness = 1;
  const Surfaces surfaces(scene);
  const Ray ray{{0, 0, 1}, {0, 0, -1}, {8.0F / 64, 0, 1}};
  const Hit white{0, 0, 0, 0.5F / 64, 0};
  const SurfacePoint wide = surfaces.met(white, ray), point = surfaces.at(white);
  const Matter far = surfaces.matter(wide), near = surfaces.matter(point);
  for (const float filtered : {far.base.g, far.specular_color.g, far.clearcoat, far.sheen.g, surfaces.emission(wide).g}) {
    EXPECT_NEAR(filtered, 0.5F, kLevelCode);
  }
  EXPECT_EQ(far.metallic, near.metallic);
  EXPECT_EQ(far.roughness, near.roughness);
  EXPECT_EQ(far.transmission, near.transmission);
  EXPECT_EQ(far.clearcoat_roughness, near.clearcoat_roughness);
  EXPECT_EQ(far.sheen_roughness, near.sheen_roughness);
  EXPECT_EQ(wide.shading_normal, point.shading_normal);
  EXPECT_EQ(surfaces.coverage(white), 1);
}

TEST(Met, IsFacedAndCarriesItsCone) {
  const Scene scene = three_quads();
  const Surfaces surfaces(scene);
  const SurfacePoint point = surfaces.met({0, 0, 0.25F, 0.25F, 3}, {{0, 0, -3}, {0, 0, 1}, {0.5F, 0.25F, 1}});
  EXPECT_FALSE(point.is_front);
  EXPECT_EQ(point.cone.width, 1.25F);
  EXPECT_TRUE(point.footprint[0].is_point()) << "nothing is textured";
}

TEST(AtPart, IsTheMeanOfItsPart) {
  Scene scene = picture(checker(64));
  scene.materials[0].base_color = Spectrum(1.0F);
  scene.materials[0].base_texture.texture = 0;
  const Surfaces surfaces(scene);
  EXPECT_NEAR(surfaces.matter(surfaces.at_part({0, 0, 0.3F, 0.3F, 0}, 0.25F)).base.r, 0.5F, kLevelCode);
}

TEST(Absorption, FollowsBeerAndLambertInsideAVolume) {
  Scene scene = textured();
  Material& m = scene.materials[0];
  m.has_volume = true;
  m.attenuation_color = {0.25F, 0.5F, 1};
  m.attenuation_distance = 2;
  const Surfaces surfaces(scene);
  SurfacePoint point = point_of(scene);
  expect_near(surfaces.absorption(point, 4), Spectrum(1.0F));  // outside
  face(point, {0, 0, -1});
  expect_near(surfaces.absorption(point, 0), Spectrum(1.0F));
  expect_near(surfaces.absorption(point, 2), m.attenuation_color);
  expect_near(surfaces.absorption(point, 4), {0.0625F, 0.25F, 1});
  m.has_volume = false;
  expect_near(surfaces.absorption(point, 4), Spectrum(1.0F));
  m.has_volume = true, m.attenuation_distance = 0;
  expect_near(surfaces.absorption(point, 4), Spectrum(1.0F));
}

}  // namespace
}  // namespace radfarm
