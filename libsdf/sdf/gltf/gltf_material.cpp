#include "sdf/gltf/gltf_material-inl.h"

#include <utility>

#include "sdf/base/utf8.h"

namespace sdf {
namespace {

/// Index of a square texture of these texels, filtered between them and not beyond.
int addTexture(GltfModel& model, int side, std::span<const Texel> texels) {
  tinygltf::Sampler sampler;
  sampler.minFilter = sampler.magFilter = TINYGLTF_TEXTURE_FILTER_LINEAR;
  sampler.wrapS = sampler.wrapT = TINYGLTF_TEXTURE_WRAP_CLAMP_TO_EDGE;
  tinygltf::Texture texture;
  texture.sampler = placeOf(std::move(sampler), model.samplers);
  texture.source = model.addImage(side, texels);
  return placeOf(std::move(texture), model.textures);
}

}  // namespace

int addMaterial(GltfModel& model, const std::string& name, const PbrMaterial& pbr, const glm::vec3& baseColor,
                std::span<const Texel> emission) {
  tinygltf::Material material;
  material.name = utf8(name);
  material.pbrMetallicRoughness.baseColorFactor = {baseColor.x, baseColor.y, baseColor.z, 1.0};
  material.pbrMetallicRoughness.metallicFactor = pbr.metallic;
  material.pbrMetallicRoughness.roughnessFactor = pbr.roughness;
  material.emissiveFactor = numbers(pbr.emissiveFactor);
  if (!emission.empty()) {
    material.emissiveTexture.index = addTexture(model, 2, emission);
    // VTK 9.1, and with it F3D, looks for other textures only where there is one of the base colour.
    const Texel white[] = {Texel(255)};
    material.pbrMetallicRoughness.baseColorTexture.index = addTexture(model, 1, white);
  }
  if (pbr.emissiveStrength > 1.0f) {
    material.extensions["KHR_materials_emissive_strength"] = tinygltf::Value(tinygltf::Value::Object{
        {"emissiveStrength", tinygltf::Value(static_cast<double>(pbr.emissiveStrength))}});
    model.useExtension("KHR_materials_emissive_strength");
  }
  return placeOf(std::move(material), model.materials);
}

}  // namespace sdf
