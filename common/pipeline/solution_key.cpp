#include "pipeline/solution_key.h"

#include "base/digest.h"
#include "pipeline/fingerprint.h"
#include "scene/scene_file.h"

namespace radfarm {
namespace {

/// Of all in the scene that light depends on.
std::string light_digest(Scene scene) {
  scene.cameras.clear();
  scene.notes.clear();
  return sha256_hex(encode_scene(scene));
}

}  // namespace

std::string solution_key(const Scene& scene, const RadiositySettings& settings, std::uint64_t seed, bool is_reflecting,
                         LightForm form, const Shining& shining) {
  Sha256 hash;
  hash.update(build_id());
  hash.update(program_digest());
  hash.update(numeric_fingerprint());
  hash.update(light_digest(scene));
  hash.update(std::as_bytes(std::span(&settings, 1)));  // no padding: asserted where Settings is stored
  hash.update_value(seed);
  hash.update_value(is_reflecting ? 1U : 0U);
  hash.update_value(static_cast<std::uint64_t>(form));
  for (const Material& material : scene.materials) hash.update_value(material.folds_specular ? 1U : 0U);
  for (const std::vector<std::uint8_t>* which : {&shining.materials, &shining.lights}) {
    hash.update_value(static_cast<std::uint64_t>(which->size()));
    hash.update(std::as_bytes(std::span(*which)));
  }
  hash.update_value(shining.environment ? 1U : 0U);
  return hash.hex();
}

}  // namespace radfarm
