#pragma once

#include <array>

#include "scene/scene.h"

namespace radfarm {

/// Pointers to every place where a (const) Material may use a texture, for code that treats them alike.
template <typename M>
auto texture_uses(M& m) {
  return std::array{&m.base_texture,
                    &m.metallic_roughness_texture,
                    &m.specular_texture,
                    &m.specular_color_texture,
                    &m.transmission_texture,
                    &m.clearcoat_texture,
                    &m.clearcoat_roughness_texture,
                    &m.sheen_color_texture,
                    &m.sheen_roughness_texture,
                    &m.normal_texture,
                    &m.emission_texture};
}

}  // namespace radfarm
