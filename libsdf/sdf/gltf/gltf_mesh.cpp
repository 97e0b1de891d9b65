#include <algorithm>
#include <cmath>
#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <limits>
#include <span>

#include "sdf/gltf/emission.h"
#include "sdf/gltf/gltf_mesh-inl.h"
#include "sdf/gltf/pbr.h"
#include "sdf/gltf/primitive.h"
#include "sdf/gltf/utf8.h"

namespace sdf {
namespace {

/// 3.7.2.1: 65535 is the restart value of 16-bit indices, so 65,535 vertices are the most.
constexpr std::size_t kMostShortVertices = 65535;

/// A unit vector near `n`; the file must not hold others (3.7.2.1).
glm::vec3 unit(const glm::vec3& n) {
  const glm::dvec3 wide(n);
  const double length = glm::length(wide);
  return length > 0.0 && std::isfinite(length) ? glm::vec3(wide / length) : glm::vec3(0, 1, 0);
}

using ColorValue = glm::vec<4, std::uint16_t>;
using CoordinateValue = glm::vec<2, std::uint16_t>;

/// Linear colour in 16 bits a channel (8 would show bands in the darks), opaque.
ColorValue quantized(const glm::vec3& color) {
  constexpr float kMost = 65535.0f;
  return ColorValue(glm::round(color * kMost), 65535);
}

/// Adds the primitives of one part's mesh and their materials.
class MeshWriter {
 public:
  MeshWriter(GltfModel& model, const ExportPart& part) : model_(model), part_(part), mesh_(part.mesh) {}

  tinygltf::Primitive add(const Primitive& primitive) {
    MeshMaterial material = mesh_.materials[primitive.material];
    BakedEmission baked;
    if (part_.ambient) {
      baked = bakedEmission(mesh_, primitive, *part_.ambient);
      material.emission = baked.peak;
    }
    const PbrMaterial pbr = toMetallicRoughness(material);
    const auto colorOf = [&](std::uint32_t vertex) { return pbr.baseColor(mesh_.colors[vertex]); };
    const std::uint32_t first = primitive.vertices[0];
    const bool plain = std::ranges::all_of(
        primitive.vertices,
        [&, color = quantized(colorOf(first))](std::uint32_t v) { return quantized(colorOf(v)) == color; });

    tinygltf::Primitive out;
    out.mode = TINYGLTF_MODE_TRIANGLES;
    out.indices = addIndices(primitive);
    out.attributes["POSITION"] = addPositions(primitive);
    out.attributes["NORMAL"] =
        addAttribute(primitive, TINYGLTF_COMPONENT_TYPE_FLOAT, TINYGLTF_TYPE_VEC3,
                     [&](std::uint32_t vertex) { return unit(mesh_.normals[vertex]); });
    if (!plain) {
      const int index = addAttribute(primitive, TINYGLTF_COMPONENT_TYPE_UNSIGNED_SHORT, TINYGLTF_TYPE_VEC4,
                                     [&](std::uint32_t vertex) { return quantized(colorOf(vertex)); });
      model_.accessors[index].normalized = true;
      out.attributes["COLOR_0"] = index;
    }
    const int texture = addTexture(baked, out);
    out.material = addMaterial(material.name, pbr, plain ? colorOf(first) : glm::vec3(1.0f), texture);
    return out;
  }

 private:
  /// Adds an element for each vertex of the primitive, made from the mesh's vertex.
  template <class ElementOf>
  int addAttribute(const Primitive& primitive, int componentType, int type, ElementOf elementOf) {
    return model_.addAccessor(primitive.vertices.size(), TINYGLTF_TARGET_ARRAY_BUFFER, componentType, type,
                              [&](std::size_t i) { return elementOf(primitive.vertices[i]); });
  }

  /// Index of the emission's texture, to which the primitive receives coordinates; -1 if it has none.
  int addTexture(const BakedEmission& baked, tinygltf::Primitive& primitive) {
    if (baked.coordinates.empty()) return -1;
    const int index = model_.addAccessor(baked.coordinates.size(), TINYGLTF_TARGET_ARRAY_BUFFER,
                                         TINYGLTF_COMPONENT_TYPE_UNSIGNED_SHORT, TINYGLTF_TYPE_VEC2,
                                         [&](std::size_t i) { return baked.coordinates[i]; });
    model_.accessors[index].normalized = true;
    primitive.attributes["TEXCOORD_0"] = index;
    return addTexture(2, baked.texels);
  }

  int addPositions(const Primitive& primitive) {
    glm::vec3 low(std::numeric_limits<float>::infinity());
    glm::vec3 high = -low;
    const int index =
        addAttribute(primitive, TINYGLTF_COMPONENT_TYPE_FLOAT, TINYGLTF_TYPE_VEC3, [&](std::uint32_t vertex) {
          low = glm::min(low, mesh_.positions[vertex]);
          high = glm::max(high, mesh_.positions[vertex]);
          return mesh_.positions[vertex];
        });
    model_.accessors[index].minValues = numbers(low);
    model_.accessors[index].maxValues = numbers(high);
    return index;
  }

  int addIndices(const Primitive& primitive) {
    const int target = TINYGLTF_TARGET_ELEMENT_ARRAY_BUFFER;
    const std::vector<std::uint32_t>& indices = primitive.indices;
    if (primitive.vertices.size() > kMostShortVertices) {
      return model_.addAccessor(indices.size(), target, TINYGLTF_COMPONENT_TYPE_UNSIGNED_INT,
                                TINYGLTF_TYPE_SCALAR, [&](std::size_t i) { return indices[i]; });
    }
    return model_.addAccessor(indices.size(), target, TINYGLTF_COMPONENT_TYPE_UNSIGNED_SHORT,
                              TINYGLTF_TYPE_SCALAR,
                              [&](std::size_t i) { return static_cast<std::uint16_t>(indices[i]); });
  }

  /// Index of a square texture of these texels, filtered between them and not beyond.
  int addTexture(int side, std::span<const Texel> texels) {
    tinygltf::Sampler sampler;
    sampler.minFilter = sampler.magFilter = TINYGLTF_TEXTURE_FILTER_LINEAR;
    sampler.wrapS = sampler.wrapT = TINYGLTF_TEXTURE_WRAP_CLAMP_TO_EDGE;
    tinygltf::Texture texture;
    texture.sampler = placeOf(std::move(sampler), model_.samplers);
    texture.source = model_.addImage(side, texels);
    return placeOf(std::move(texture), model_.textures);
  }

  /// Index of the material; parts that wear the same one share it.
  int addMaterial(const std::string& name, const PbrMaterial& pbr, const glm::vec3& baseColor,
                  int emissiveTexture) {
    tinygltf::Material material;
    material.name = utf8(name);
    material.pbrMetallicRoughness.baseColorFactor = {baseColor.x, baseColor.y, baseColor.z, 1.0};
    material.pbrMetallicRoughness.metallicFactor = pbr.metallic;
    material.pbrMetallicRoughness.roughnessFactor = pbr.roughness;
    material.emissiveFactor = numbers(pbr.emissiveFactor);
    if (emissiveTexture >= 0) {
      material.emissiveTexture.index = emissiveTexture;
      // VTK 9.1, and with it F3D, looks for other textures only where there is one of the base colour.
      const Texel white[] = {Texel(255)};
      material.pbrMetallicRoughness.baseColorTexture.index = addTexture(1, white);
    }
    if (pbr.emissiveStrength > 1.0f) {
      material.extensions["KHR_materials_emissive_strength"] = tinygltf::Value(tinygltf::Value::Object{
          {"emissiveStrength", tinygltf::Value(static_cast<double>(pbr.emissiveStrength))}});
      model_.useExtension("KHR_materials_emissive_strength");
    }
    return placeOf(std::move(material), model_.materials);
  }

  GltfModel& model_;
  const ExportPart& part_;
  const Mesh& mesh_;
};

int addMesh(GltfModel& model, const ExportPart& part) {
  tinygltf::Mesh mesh;
  mesh.name = utf8(part.name);
  MeshWriter writer(model, part);
  for (const Primitive& primitive : splitByMaterial(part.mesh))
    mesh.primitives.push_back(writer.add(primitive));
  model.meshes.push_back(std::move(mesh));
  return static_cast<int>(model.meshes.size()) - 1;
}

}  // namespace

tinygltf::Node partNode(GltfModel& model, const ExportPart& part) {
  using tinygltf::Value;
  tinygltf::Node node;
  node.name = utf8(part.name);
  Value::Object extras = extrasOf(part.stats);
  if (part.ambient) extras["ambientError"] = Value(static_cast<double>(part.ambient->error));
  node.extras = Value(std::move(extras));
  if (!part.mesh.triangles.empty()) node.mesh = addMesh(model, part);
  return node;
}

std::size_t mostBytesOf(const ExportPart& part) {
  constexpr std::size_t kVertex = 2 * sizeof(glm::vec3) + sizeof(ColorValue) + sizeof(CoordinateValue);
  constexpr std::size_t kTriangle = sizeof(glm::uvec3);
  constexpr std::size_t kPrimitive = 512;  // padding and textures
  const Mesh& mesh = part.mesh;
  return mesh.positions.size() * kVertex + mesh.triangles.size() * kTriangle +
         mesh.materials.size() * kPrimitive;
}

Box boundsOfMeshes(const GltfModel& model) {
  const auto corner = [](const std::vector<double>& v) { return glm::dvec3(v[0], v[1], v[2]); };
  Box all;
  for (const tinygltf::Mesh& mesh : model.meshes)
    for (const tinygltf::Primitive& primitive : mesh.primitives) {
      const tinygltf::Accessor& positions = model.accessors[primitive.attributes.at("POSITION")];
      all = unite(all, Box{corner(positions.minValues), corner(positions.maxValues)});
    }
  return all;
}

}  // namespace sdf
