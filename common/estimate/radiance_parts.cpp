#include "estimate/radiance_parts.h"

namespace radfarm {

Spectrum& part_of_emission(RadianceParts& parts, PathStage stage) {
  switch (stage) {
    case PathStage::kSeen: return parts.emission;
    case PathStage::kReceiver: return parts.direct;
    case PathStage::kIndirect: return parts.indirect;
    default: return parts.specular;
  }
}

Spectrum& part_of_scattering(RadianceParts& parts, PathStage stage, bool is_specular) {
  const bool is_before_receiver = stage == PathStage::kSeen || stage == PathStage::kEyeChain;
  if (is_before_receiver) return is_specular ? parts.specular : parts.direct;
  if (stage == PathStage::kReceiver) return is_specular ? parts.specular : parts.indirect;
  return stage == PathStage::kIndirect ? parts.indirect : parts.specular;
}

PathStage stage_after(PathStage stage, bool is_specular) {
  const bool is_before_receiver = stage == PathStage::kSeen || stage == PathStage::kEyeChain;
  if (is_before_receiver) return is_specular ? PathStage::kEyeChain : PathStage::kReceiver;
  if (stage == PathStage::kReceiver) return is_specular ? PathStage::kSpecular : PathStage::kIndirect;
  return stage;
}

}  // namespace radfarm
