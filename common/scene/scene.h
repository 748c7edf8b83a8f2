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

/// Lambertian for now (docs/architecture.md, Materials): both sides reflect and block, the front emits.
struct Material {
  std::string name;
  Spectrum reflectance{0.5F};               // rho, [0, 1]; times the texture and the vertex colour
  std::uint32_t reflectance_texture = kNone;
  std::uint32_t reflectance_uv = 0;          // which UV set: 0 or 1
  Spectrum emission;                         // emitted radiance L_e, cd/m^2 in luminance; times the texture
  std::uint32_t emission_texture = kNone;
  std::uint32_t emission_uv = 0;
  bool emits_from_both_sides = false;        // glTF doubleSided
  enum class Alpha : std::uint8_t { kOpaque, kMask, kBlend };
  Alpha alpha_mode = Alpha::kOpaque;
  float alpha = 1;                           // coverage; times the reflectance texture's alpha and the vertex alpha
  float alpha_cutoff = 0.5F;                 // kMask: coverage is 1 at or above, else 0
  bool folds_gloss_into_diffuse = false;     // the file describes more than a Lambertian surface
  bool is_switched_off = false;              // a lamp of no power: the file gives an emission, and 0 as its strength
};

/// Triangles of one material in their own coordinates. Optional arrays are empty or as long as `positions`.
struct Mesh {
  std::string name;
  std::uint32_t material = 0;
  std::vector<Vec3> positions;
  std::vector<Vec3> normals;                 // unit shading normals
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
};

struct Scene {
  std::vector<Texture> textures;
  std::vector<Material> materials;
  std::vector<Mesh> meshes;
  std::vector<Instance> instances;
  std::vector<PunctualLight> lights;
  std::vector<Camera> cameras;
  Vec3d origin{0, 0, 0};                         // what was subtracted from the file's coordinates, metres
  std::vector<std::string> notes;       // what the file asks for and radfarm treats otherwise, one sentence each
};

}  // namespace radfarm
