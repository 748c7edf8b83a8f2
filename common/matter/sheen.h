#pragma once

#include "math/vec.h"

namespace radfarm {

/// The sheen lobe of KHR_materials_sheen without its colour: fibres with the "Charlie" distribution. [Estevez and Kulla 2017]
/// Local directions above the surface; 1/sr, without the receiver's cosine. Roughness 0 is taken as 0.07, as by glTF's sample
/// renderer: below, the lobe is a spike at grazing that no float holds.
float eval_sheen(float roughness, const Vec3& o, const Vec3& i);

}  // namespace radfarm
