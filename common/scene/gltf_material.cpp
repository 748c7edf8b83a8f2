#include "scene/gltf_material.h"

#include <cmath>
#include <map>
#include <string>
#include <tuple>

#include "scene/draft_scene.h"
#include "scene/image_file.h"
#include "scene/limits.h"

namespace radfarm {
namespace {

using Extensions = tinygltf::ExtensionMap;

const tinygltf::Value* extension(const Extensions& extensions, const std::string& name) {
  const auto found = extensions.find(name);
  return found == extensions.end() ? nullptr : &found->second;
}

double number(const tinygltf::Value* object, const std::string& key, double otherwise) {
  if (object == nullptr || !object->Has(key)) return otherwise;
  return object->Get(key).GetNumberAsDouble();
}

double element(const tinygltf::Value* object, const std::string& key, int index, double otherwise) {
  if (object == nullptr || !object->Has(key)) return otherwise;
  return object->Get(key).Get(index).GetNumberAsDouble();
}

Spectrum spectrum(const std::vector<double>& values, double scale) {
  if (values.size() < 3) return Spectrum(static_cast<float>(scale));
  return Spectrum(SpectrumD(values[0], values[1], values[2]) * scale);
}

Texture::Wrap wrap_mode(int wrap) {
  if (wrap == TINYGLTF_TEXTURE_WRAP_CLAMP_TO_EDGE) return Texture::Wrap::kClamp;
  return wrap == TINYGLTF_TEXTURE_WRAP_MIRRORED_REPEAT ? Texture::Wrap::kMirror : Texture::Wrap::kRepeat;
}

/// Decodes each (image, wrap modes) once.
class TextureReader {
 public:
  TextureReader(const GltfModel& model, Scene& scene) : model_(model), scene_(scene) {}

  /// The scene's texture for the glTF texture, or kNone where it has no image that we can read (with a note).
  Result<std::uint32_t> read(int texture_index) {
    const tinygltf::Texture& texture = model_.document.textures.at(static_cast<std::size_t>(texture_index));
    const std::string pointer = "/textures/" + std::to_string(texture_index);
    if (texture.source < 0) return fail(Code::kInvalidArgument, pointer + ": has no PNG or JPEG source");
    auto wrap_u = Texture::Wrap::kRepeat;
    auto wrap_v = Texture::Wrap::kRepeat;
    if (texture.sampler >= 0) {
      const tinygltf::Sampler& sampler = model_.document.samplers.at(static_cast<std::size_t>(texture.sampler));
      wrap_u = wrap_mode(sampler.wrapS);
      wrap_v = wrap_mode(sampler.wrapT);
    }
    const auto [known, is_new] = textures_.try_emplace({texture.source, wrap_u, wrap_v}, 0);
    if (is_new) {
      RADFARM_TRY(Texture decoded, decode(static_cast<std::size_t>(texture.source)));
      decoded.wrap_u = wrap_u;
      decoded.wrap_v = wrap_v;
      known->second = static_cast<std::uint32_t>(scene_.textures.size());
      scene_.textures.push_back(std::move(decoded));
    }
    return known->second;
  }

 private:
  Result<Texture> decode(std::size_t image) {
    const std::string pointer = "/images/" + std::to_string(image);
    const Result<std::string> bytes = image_bytes(model_, image);
    if (!bytes) return annotate(bytes.error(), pointer);
    Result<Texture> texture = decode_image(*bytes);
    if (!texture) return annotate(texture.error(), pointer);
    texels_ += texture->texels.size();
    if (texels_ > limits::kTextureTexels) {
      return fail(Code::kResourceExhausted,
                  pointer + ": textures have more than " + std::to_string(limits::kTextureTexels) + " pixels together");
    }
    return texture;
  }

  const GltfModel& model_;
  Scene& scene_;
  std::map<std::tuple<int, Texture::Wrap, Texture::Wrap>, std::uint32_t> textures_;
  std::size_t texels_ = 0;
};

GltfCoordinates coordinates(int set, const tinygltf::Value* transform) {
  GltfCoordinates result;
  result.set = static_cast<int>(number(transform, "texCoord", set));
  for (int i = 0; i < 2; ++i) {
    result.offset[i] = static_cast<float>(element(transform, "offset", i, 0));
    result.scale[i] = static_cast<float>(element(transform, "scale", i, 1));
  }
  result.rotation = static_cast<float>(number(transform, "rotation", 0));
  return result;
}

/// Base colour from KHR_materials_pbrSpecularGlossiness, where a file has that instead.
struct BaseColor {
  std::array<double, 4> factor = {1, 1, 1, 1};
  int texture = -1;
  GltfCoordinates uv;
};

BaseColor base_color(const tinygltf::Material& source) {
  BaseColor base;
  const auto* glossiness = extension(source.extensions, "KHR_materials_pbrSpecularGlossiness");
  if (glossiness != nullptr) {
    for (int i = 0; i < 4; ++i) base.factor[static_cast<std::size_t>(i)] = element(glossiness, "diffuseFactor", i, 1);
    if (!glossiness->Has("diffuseTexture")) return base;
    const tinygltf::Value& info = glossiness->Get("diffuseTexture");
    base.texture = info.Get("index").GetNumberAsInt();
    const tinygltf::Value& inner = info.Get("extensions");
    const bool moved = inner.IsObject() && inner.Has("KHR_texture_transform");
    base.uv = coordinates(static_cast<int>(number(&info, "texCoord", 0)),
                          moved ? &inner.Get("KHR_texture_transform") : nullptr);
    return base;
  }
  const tinygltf::PbrMetallicRoughness& pbr = source.pbrMetallicRoughness;
  for (std::size_t i = 0; i < pbr.baseColorFactor.size() && i < 4; ++i) base.factor[i] = pbr.baseColorFactor[i];
  base.texture = pbr.baseColorTexture.index;
  base.uv = coordinates(pbr.baseColorTexture.texCoord,
                        extension(pbr.baseColorTexture.extensions, "KHR_texture_transform"));
  return base;
}

/// True when the file describes exactly a Lambertian surface.
bool is_lambertian(const tinygltf::Material& source) {
  if (extension(source.extensions, "KHR_materials_transmission") != nullptr) return false;
  if (extension(source.extensions, "KHR_materials_clearcoat") != nullptr) return false;
  if (const auto* glossiness = extension(source.extensions, "KHR_materials_pbrSpecularGlossiness")) {
    for (int i = 0; i < 3; ++i) {
      if (element(glossiness, "specularFactor", i, 1) != 0) return false;
    }
    return true;
  }
  const auto* specular = extension(source.extensions, "KHR_materials_specular");
  return source.pbrMetallicRoughness.metallicFactor == 0 && number(specular, "specularFactor", 1) == 0;
}

Material::Alpha alpha_mode(const tinygltf::Material& source) {
  if (source.alphaMode == "MASK") return Material::Alpha::kMask;
  return source.alphaMode == "BLEND" ? Material::Alpha::kBlend : Material::Alpha::kOpaque;
}

void note_extensions(const tinygltf::Material& source, Scene& scene) {
  static const std::map<std::string, std::string> kNotes = {
      {"KHR_materials_unlit", "is simulated as a Lambertian surface of its base colour"},
      {"KHR_materials_transmission", "is ignored: the surface is an opaque Lambertian one"},
      {"KHR_materials_volume", "is ignored: nothing absorbs light between surfaces"},
      {"KHR_materials_clearcoat", "is ignored: there is no coating"},
      {"KHR_materials_sheen", "is ignored"},
      {"KHR_materials_iridescence", "is ignored"},
      {"KHR_materials_anisotropy", "is ignored"},
      {"KHR_materials_dispersion", "is ignored"},
      {"KHR_materials_pbrSpecularGlossiness", "is folded into diffuse: reflectance is its diffuse colour"},
  };
  for (const auto& [name, value] : source.extensions) {
    const auto known = kNotes.find(name);
    if (known != kNotes.end()) add_note(scene, "Material extension " + name + " " + known->second + ".");
  }
}

Result<GltfUvSlots> read_material(const tinygltf::Material& source, TextureReader& textures, Scene& scene) {
  Material material;
  GltfUvSlots slots;
  material.name = source.name;
  const BaseColor base = base_color(source);
  material.reflectance = Spectrum(SpectrumD(base.factor[0], base.factor[1], base.factor[2]));
  material.alpha_mode = alpha_mode(source);
  material.alpha = material.alpha_mode == Material::Alpha::kOpaque ? 1.0F : static_cast<float>(base.factor[3]);
  material.alpha_cutoff = static_cast<float>(source.alphaCutoff);
  material.folds_gloss_into_diffuse = !is_lambertian(source);
  material.emits_from_both_sides = source.doubleSided;
  const auto* strength = extension(source.extensions, "KHR_materials_emissive_strength");
  const bool glows = source.emissiveFactor.size() == 3;
  material.emission = glows ? spectrum(source.emissiveFactor, number(strength, "emissiveStrength", 1)) : Spectrum();
  material.is_switched_off = glows && is_black(material.emission) && !is_black(spectrum(source.emissiveFactor, 1));
  if (base.texture >= 0) {
    RADFARM_TRY(material.reflectance_texture, textures.read(base.texture));
    slots[0] = base.uv;
  }
  // A texture on a factor of zero is never looked up.
  if (source.emissiveTexture.index >= 0 && !is_black(material.emission)) {
    RADFARM_TRY(material.emission_texture, textures.read(source.emissiveTexture.index));
    const GltfCoordinates uv = coordinates(source.emissiveTexture.texCoord,
                                           extension(source.emissiveTexture.extensions, "KHR_texture_transform"));
    material.emission_uv = slots[0].set < 0 || slots[0] == uv ? 0 : 1;
    slots[material.emission_uv] = uv;
  }
  note_extensions(source, scene);
  scene.materials.push_back(std::move(material));
  return slots;
}

}  // namespace

Vec2 GltfCoordinates::apply(float u, float v) const {
  const float x = u * scale[0];
  const float y = v * scale[1];
  // v points down, so a counter-clockwise turn as seen takes (1, 0) to (cos, -sin).
  const float c = std::cos(rotation);
  const float s = std::sin(rotation);
  return {c * x + s * y + offset[0], c * y - s * x + offset[1]};
}

Result<std::vector<GltfUvSlots>> read_gltf_materials(const GltfModel& model, Scene& scene) {
  TextureReader textures(model, scene);
  std::vector<GltfUvSlots> slots;
  for (const tinygltf::Material& source : model.document.materials) {
    auto read = read_material(source, textures, scene);
    if (!read) return annotate(read.error(), "/materials/" + std::to_string(slots.size()));
    slots.push_back(*read);
  }
  Material otherwise;
  otherwise.name = "default";
  otherwise.reflectance = Spectrum(1);
  otherwise.folds_gloss_into_diffuse = true;
  scene.materials.push_back(otherwise);
  slots.emplace_back();
  return slots;
}

}  // namespace radfarm
