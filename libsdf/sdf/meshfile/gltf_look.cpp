#include "sdf/meshfile/gltf_look-inl.h"

#include <cmath>
#include <glm/vec2.hpp>

namespace sdf {
namespace {

glm::vec3 vectorOf(const std::vector<double>& numbers, const glm::vec3& otherwise) {
  return numbers.size() < 3 ? otherwise : glm::vec3(numbers[0], numbers[1], numbers[2]);
}

const tinygltf::Value* extension(const tinygltf::ExtensionMap& extensions, const char* name) {
  const auto found = extensions.find(name);
  return found != extensions.end() && found->second.IsObject() ? &found->second : nullptr;
}

float number(const tinygltf::Value& object, const char* name, float otherwise) {
  const tinygltf::Value& value = object.Get(name);
  return value.IsNumber() ? static_cast<float>(value.GetNumberAsDouble()) : otherwise;
}

glm::vec2 pair(const tinygltf::Value& object, const char* name, const glm::vec2& otherwise) {
  const tinygltf::Value& value = object.Get(name);
  if (!value.IsArray() || value.ArrayLen() != 2) return otherwise;
  return {value.Get(0).GetNumberAsDouble(), value.Get(1).GetNumberAsDouble()};
}

}  // namespace

Result<GltfLook::Used> GltfLook::material(int index, bool hasColors) {
  const auto& materials = document_.model().materials;
  if (index >= static_cast<int>(materials.size()))
    return unreadable(document_.file().path, "it has no material " + std::to_string(index));
  const int key = index >= 0 ? index : (hasColors ? -1 : -2);
  const auto found = used_.find(key);
  if (found != used_.end()) return found->second;
  if (index >= 0) return used_[key] = describe(materials[index]);
  const auto place = static_cast<std::uint32_t>(out_.mesh.materials.size());
  TriangleMaterial& plain = out_.mesh.materials.emplace_back();
  if (hasColors) plain.color = glm::vec3(1.0f);
  return used_[key] = Used{place, std::nullopt};
}

GltfLook::Used GltfLook::describe(const tinygltf::Material& from) {
  const tinygltf::PbrMetallicRoughness& pbr = from.pbrMetallicRoughness;
  const std::string name = "material " + inQuotes(from.name);
  TriangleMaterial to;
  to.name = from.name;
  to.color = vectorOf(pbr.baseColorFactor, glm::vec3(1.0f));
  to.metallic = static_cast<float>(pbr.metallicFactor);
  to.roughness = static_cast<float>(pbr.roughnessFactor);
  to.emission = vectorOf(from.emissiveFactor, glm::vec3(0.0f));
  if (const auto* strength = extension(from.extensions, "KHR_materials_emissive_strength"))
    to.emission *= number(*strength, "emissiveStrength", 1.0f);
  if (!from.alphaMode.empty() && from.alphaMode != "OPAQUE")
    warn(out_.warnings, name + " is transparent, and read as opaque");

  Used used{static_cast<std::uint32_t>(out_.mesh.materials.size()), std::nullopt};
  to.colorTexture = picture(pbr.baseColorTexture.index);
  if (to.colorTexture >= 0)
    used.textureAt = textureAt(pbr.baseColorTexture.texCoord, pbr.baseColorTexture.extensions);
  if (to.emission != glm::vec3(0.0f)) to.emissionTexture = picture(from.emissiveTexture.index);
  if (to.emissionTexture >= 0) {
    const GltfTextureAt at = textureAt(from.emissiveTexture.texCoord, from.emissiveTexture.extensions);
    if (!used.textureAt) used.textureAt = at;
    if (at != *used.textureAt) {
      to.emissionTexture = -1;
      warn(out_.warnings, name + " has an emission texture with coordinates of its own, which is left out");
    }
  }
  if (pbr.metallicRoughnessTexture.index >= 0) {
    warn(out_.warnings, name + " has a metal and roughness texture, of which the mean is taken");
    takeMean(pbr.metallicRoughnessTexture.index, to);
  }
  out_.mesh.materials.push_back(std::move(to));
  return used;
}

GltfTextureAt GltfLook::textureAt(int set, const tinygltf::ExtensionMap& extensions) const {
  GltfTextureAt out{set, glm::mat3(1.0f)};
  const auto* transform = extension(extensions, "KHR_texture_transform");
  if (!transform) return out;
  if (const tinygltf::Value& other = transform->Get("texCoord"); other.IsInt()) out.set = other.Get<int>();
  const glm::vec2 offset = pair(*transform, "offset", glm::vec2(0.0f)),
                  scale = pair(*transform, "scale", glm::vec2(1.0f));
  const float angle = number(*transform, "rotation", 0.0f), c = std::cos(angle), s = std::sin(angle);
  // Scaled first, then turned, then moved; columns.
  out.transform = {
      {c * scale.x, -s * scale.x, 0.0f}, {s * scale.y, c * scale.y, 0.0f}, {offset.x, offset.y, 1.0f}};
  return out;
}

std::optional<TextureImage> GltfLook::load(int texture) {
  const auto& textures = document_.model().textures;
  const int source = texture < static_cast<int>(textures.size()) ? textures[texture].source : -1;
  const auto leftOut = [&](const std::string& why) {
    warn(out_.warnings, "picture " + std::to_string(source) + " is left out: " + why);
    return std::nullopt;
  };
  if (source < 0 || source >= static_cast<int>(document_.pictures().size())) return leftOut("it is missing");
  const Result<std::string> bytes = document_.pictureBytes(document_.pictures()[source]);
  if (!bytes) return leftOut(bytes.error().message);
  Result<TextureImage> image = reader_.read(*bytes);
  if (!image) return leftOut(image.error().message);
  return std::move(*image);
}

int GltfLook::picture(int texture) {
  if (texture < 0) return -1;
  const auto [found, isNew] = pictures_.emplace(texture, -1);
  if (!isNew) return found->second;
  std::optional<TextureImage> image = load(texture);
  if (!image) return -1;
  out_.mesh.images.push_back(std::move(*image));
  return found->second = static_cast<int>(out_.mesh.images.size()) - 1;
}

/// 3.9.2: roughness is green, metalness blue.
void GltfLook::takeMean(int texture, TriangleMaterial& material) {
  const std::optional<TextureImage> image = load(texture);
  if (!image) return;
  double roughness = 0.0, metallic = 0.0;
  for (std::size_t i = 0; i + 3 < image->pixels.size(); i += 4) {
    roughness += image->pixels[i + 1];
    metallic += image->pixels[i + 2];
  }
  const double white = 255.0 * image->width * image->height;
  material.roughness *= static_cast<float>(roughness / white);
  material.metallic *= static_cast<float>(metallic / white);
}

}  // namespace sdf
