#pragma once

#include <array>
#include <cstdint>
#include <string>
#include <vector>

#include "math/spectrum.h"
#include "math/vec.h"

namespace radfarm {

/// A scene as radfarm simulates it: plain data, in metres, recentred (docs/architecture.md), light in photometric RGB.
/// Loaders fill it and validate() proves its invariants: every index in range, every float finite, directions unit.

inline constexpr std::uint32_t kNone = 0xffffffffU;

/// 8-bit RGBA as stored in the file. `is_srgb`: the colour channels are sRGB-encoded and must be linearised after lookup
/// of each texel and before filtering. Alpha is always linear.
struct Texture {
  std::uint32_t width = 0;
  std::uint32_t height = 0;
  bool is_srgb = true;
  enum class Wrap : std::uint8_t { kRepeat, kMirror, kClamp };
  Wrap wrap_u = Wrap::kRepeat;
  Wrap wrap_v = Wrap::kRepeat;
  std::vector<std::array<std::uint8_t, 4>> texels;  // row 0 is v = 0 (glTF's convention: top row)
};

/// How a material uses a texture: which one, by which UV set, moved by which affine map (KHR_texture_transform):
/// (u', v') = (m0 u + m1 v + m2, m3 u + m4 v + m5).
struct TextureUse {
  std::uint32_t texture = kNone;
  std::uint32_t uv_set = 0;  // 0 or 1
  std::array<float, 6> map{1, 0, 0, 0, 1, 0};

  bool is_used() const { return texture != kNone; }
  friend bool operator==(const TextureUse&, const TextureUse&) = default;
};

/// What a surface does to light, in the terms of glTF (docs/materials.md). Textures multiply their factors. The default is
/// Lambertian: no metal, no specular layer. Both sides reflect and block, the front emits.
struct Material {
  std::string name;
  Spectrum base_color{0.5F};                 // [0, 1]; times the texture and the vertex colour
  TextureUse base_texture;                   // sRGB colour and alpha
  float metallic = 0;
  float roughness = 1;                       // GGX alpha = roughness^2
  TextureUse metallic_roughness_texture;     // roughness in green, metallic in blue
  float specular = 0;                        // weight of the dielectric layer: 1 in glTF unless KHR_materials_specular says otherwise
  TextureUse specular_texture;               // alpha
  Spectrum specular_color{1.0F};             // of the layer at normal incidence
  TextureUse specular_color_texture;         // sRGB colour
  float ior = 1.5F;
  float transmission = 0;                    // share of the base that light passes instead of being scattered
  TextureUse transmission_texture;           // red
  bool has_volume = false;                   // light bends and is absorbed inside; otherwise the surface is a thin pane
  Spectrum attenuation_color{1.0F};          // of light that went attenuation_distance through the volume
  float attenuation_distance = 0;            // m; 0: none
  float clearcoat = 0;
  TextureUse clearcoat_texture;              // red
  float clearcoat_roughness = 0;
  TextureUse clearcoat_roughness_texture;    // green
  Spectrum sheen_color;
  TextureUse sheen_color_texture;            // sRGB colour
  float sheen_roughness = 0;
  TextureUse sheen_roughness_texture;        // alpha
  float anisotropy = 0;                      // strength along the tangent turned by anisotropy_rotation
  float anisotropy_rotation = 0;             // radians
  TextureUse normal_texture;                 // linear, tangent space; of a material with it, meshes have UVs
  float normal_scale = 1;
  Spectrum emission;                         // emitted radiance L_e, cd/m^2 in luminance; times the texture
  TextureUse emission_texture;               // sRGB colour
  bool emits_from_both_sides = false;        // glTF doubleSided
  enum class Alpha : std::uint8_t { kOpaque, kMask, kBlend };
  Alpha alpha_mode = Alpha::kOpaque;
  float alpha = 1;                           // coverage; times the base texture's alpha and the vertex alpha
  float alpha_cutoff = 0.5F;                 // kMask: coverage is 1 at or above, else 0
  /// What a file may ask for and radfarm cannot do, as bits of `unsimulated`.
  static constexpr std::uint32_t kDispersion = 1, kIridescence = 2, kScatteringInside = 4;
  std::uint32_t unsimulated = 0;
  bool asks_for(std::uint32_t bit) const { return (unsimulated & bit) != 0; }
  bool is_switched_off = false;              // a lamp of no power: the file gives an emission, and 0 as its strength
  bool folds_specular = false;               // diffuse surfaces get its specular light as if it were diffuse (specialise()); not stored

  bool is_lambertian() const {
    return metallic == 0 && specular == 0 && transmission == 0 && clearcoat == 0 && is_black(sheen_color);
  }
};

/// Triangles of one material in their own coordinates. Optional arrays are empty or as long as `positions`.
struct Mesh {
  std::string name;
  std::uint32_t material = 0;
  std::vector<Vec3> positions;
  std::vector<Vec3> normals;                 // unit shading normals
  std::vector<std::array<float, 4>> tangents;  // unit, and the handedness of the bitangent: +1 or -1
  std::array<std::vector<Vec2>, 2> uv;
  std::vector<std::array<float, 4>> colors;  // linear RGB and alpha
  std::vector<std::array<std::uint32_t, 3>> triangles;
};

/// A mesh placed in the world by `to_world` (row vectors, affine, invertible). A negative determinant turns the front side:
/// the front is where the transformed triangle is seen counter-clockwise after the flip glTF prescribes.
struct Instance {
  std::uint32_t mesh = 0;
  Matrix4 to_world;
  std::string name;
};

/// KHR_lights_punctual, in world space. Intensity is cd for point and spot, lux for directional.
struct PunctualLight {
  enum class Kind : std::uint32_t { kPoint, kSpot, kDirectional };
  Kind kind = Kind::kPoint;
  Vec3 position{0, 0, 0};
  Vec3 direction{0, 0, -1};  // unit, the way the light shines
  Spectrum intensity;
  float cos_inner = 1;       // spot: full intensity inside this cone ...
  float cos_outer = 0;       // ... none outside this one
  std::string name;
  std::uint32_t photometry = kNone;  // IES: `intensity` times the table; its nadir is `direction`, its C0 half-plane holds `right`
  Vec3 right{1, 0, 0};               // unit, perpendicular to `direction`
};

/// Luminous intensity by direction as an IES LM-63 file gives it, in type C coordinates: gamma from the nadir, C around it.
struct Photometry {
  std::string name;
  std::vector<float> gamma;    // degrees, ascending, within [0, 180]
  std::vector<float> c;        // degrees, ascending, from 0 to 90, 180 or 360, or just 0: symmetric about the axis
  std::vector<float> candela;  // c.size() rows of gamma.size()
};

/// Light from infinitely far away: a latitude-longitude map and a sun. Empty: width 0 and a black sun.
struct Environment {
  std::uint32_t width = 0;
  std::uint32_t height = 0;
  std::vector<Spectrum> radiance;  // cd/m^2; row 0 is straight up (+y); columns go from -z over +x, +z, -x
  struct Sun {
    Vec3 direction{0, 1, 0};       // unit, towards it
    float cos_radius = 1;          // of its disc
    Spectrum radiance;
  };
  Sun sun;

  bool is_empty() const { return width == 0 && is_black(sun.radiance); }
};

/// A view: `to_world` has orthonormal axes, the camera looks along its -z, +y is up.
struct Camera {
  std::string name;
  enum class Kind : std::uint32_t { kPerspective, kOrthographic };
  Kind kind = Kind::kPerspective;
  Vec3 position{0, 0, 0};
  Vec3 right{1, 0, 0};
  Vec3 up{0, 1, 0};
  Vec3 forward{0, 0, -1};
  float vertical_fov = 0.7854F;  // radians; perspective
  float half_height = 1;         // metres; orthographic
  float aspect = 0;              // width / height the file asks for; 0 when it does not say
  float lens_diameter = 0;       // metres; perspective. 0: a pinhole, everything sharp
  float focus_distance = 1;      // metres along the view to the plane that is sharp
};

struct Scene {
  std::vector<Texture> textures;
  std::vector<Material> materials;
  std::vector<Mesh> meshes;
  std::vector<Instance> instances;
  std::vector<PunctualLight> lights;
  std::vector<Photometry> photometries;
  Environment environment;
  std::vector<Camera> cameras;
  Vec3d origin{0, 0, 0};                         // what was subtracted from the file's coordinates, metres
  std::vector<std::string> notes;       // what the file asks for and radfarm treats otherwise, one sentence each
};

}  // namespace radfarm
