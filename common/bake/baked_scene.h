#pragma once

#include <array>
#include <cstdint>
#include <string>
#include <vector>

#include "radiosity/element_mesh.h"

namespace radfarm {

/// What a viewer needs of one place: unlit, so its colour is the light.
struct BakedVertex {
  Vec3 position{0, 0, 0};                        // m, recentred as Scene is
  std::array<std::uint16_t, 4> color{0, 0, 0, 0};  // of 65535, linear; times the texture: 2^EV radiance, clipped at 1; coverage
  Vec2 uv{0, 0};                                 // as the texture is looked up, its transform included
  Spectrum irradiance;                           // lux
  friend bool operator==(const BakedVertex&, const BakedVertex&) = default;
};

/// A material as a viewer shows it: vertex colours times a texture.
struct BakedMaterial {
  enum class Shows : std::uint8_t { kColor, kBaseTexture, kEmissionTexture };
  std::uint32_t material = 0;  // of the scene
  Shows shows = Shows::kColor;
  friend bool operator==(const BakedMaterial&, const BakedMaterial&) = default;
};

/// The elements of the fronts or of the backs of one instance, where light reaches them: both sides of a sheet are there, each
/// with its light, so triangles show from one side alone. Backs are moved outwards by 2^-16 of the scene's radius.
struct BakedMesh {
  std::string name;
  std::uint32_t material = 0;  // of BakedScene
  std::vector<BakedVertex> vertices;
  std::vector<std::array<std::uint32_t, 3>> triangles;
};

struct BakedScene {
  float exposure_ev = 0;
  std::vector<BakedMaterial> materials;
  std::vector<BakedMesh> meshes;
};

/// The element mesh with the light that each place sends as vertex colours.               docs/pipeline.md (mesh.4)
///
/// 2^EV (L_e + rho E / pi) of what has one colour; where the base colour is textured the texture is left to the viewer and the
/// colour is 2^EV E / pi times its factor; a textured emitter shows its emission. O(elements).
BakedScene bake_mesh(const World& world, const ElementMesh& mesh, float exposure_ev);

/// Stops that bring the mean of the logarithm of the reflected luminance, over the area, to middle grey, 0.18. 0 in the dark.
float auto_exposure(const World& world, const ElementMesh& mesh);

}  // namespace radfarm
