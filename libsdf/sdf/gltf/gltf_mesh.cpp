#include "sdf/gltf/gltf_mesh-inl.h"

#include <algorithm>
#include <cmath>
#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <limits>
#include <map>

#include "sdf/base/srgb.h"
#include "sdf/base/utf8.h"
#include "sdf/gltf/emission.h"
#include "sdf/gltf/gltf_manifold-inl.h"
#include "sdf/gltf/gltf_material-inl.h"
#include "sdf/gltf/primitive.h"
#include "sdf/meshfile/meshopt.h"

namespace sdf {
namespace {

using tinygltf::Value;

/// 3.7.2.1: 65535 is the restart value of 16-bit indices, so 65,535 vertices are the most.
constexpr std::size_t kMostShortVertices = 65535;

/// A unit vector near `n`; the file must not hold others (3.7.2.1).
glm::vec3 unit(const glm::vec3& n) {
  const glm::dvec3 wide(n);
  const double length = glm::length(wide);
  return length > 0.0 && std::isfinite(length) ? glm::vec3(wide / length) : glm::vec3(0, 1, 0);
}

/// Red, green and blue, and a fourth number to fill up four bytes.
using ColorValue = glm::vec<4, std::uint16_t>;
using CoordinateValue = glm::vec<2, std::uint16_t>;

/// Linear colour in 16 bits a channel (8 would show bands in the darks).
ColorValue quantized(const glm::vec3& color) {
  constexpr float kMost = 65535.0f;
  return ColorValue(glm::round(color * kMost), 0);
}

using ByteColor = glm::vec<4, std::uint8_t>;

/// The colours in 8 bits a channel if, shown, none is off by more than one step of a byte of sRGB; else
/// nothing.
std::vector<ByteColor> inBytes(const std::vector<ColorValue>& colors) {
  constexpr float kMost = 65535.0f, kMostByte = 255.0f;
  std::vector<ByteColor> bytes;
  for (const ColorValue& color : colors) {
    const glm::vec4 meant = glm::vec4(color) / kMost;
    bytes.emplace_back(glm::round(meant * kMostByte));
    const glm::vec4 kept = glm::vec4(bytes.back()) / kMostByte;
    for (int k = 0; k < 3; ++k)
      if (std::abs(int{srgb(kept[k])} - int{srgb(meant[k])}) > 1) return {};
  }
  return bytes;
}

template <class T>
Encoded encodeAll(const std::vector<T>& elements) {
  return encodeElements(
      {reinterpret_cast<const unsigned char*>(elements.data()), elements.size() * sizeof(T)}, sizeof(T));
}

template <class T>
void append(std::vector<T>& all, const std::vector<T>& more) {
  all.insert(all.end(), more.begin(), more.end());
}

/// Adds the mesh of one part: primitives over one list of vertices and one of indices, as EXT_mesh_manifold
/// asks, and their materials.
class MeshWriter {
 public:
  MeshWriter(GltfModel& model, const ExportPart& part)
      : model_(model), part_(part), mesh_(part.mesh), primitives_(splitByMaterial(mesh_)) {
    for (Primitive& primitive : primitives_) {
      if (part_.grid) orderForEncoding(primitive.indices, primitive.vertices);
      const auto first = static_cast<std::uint32_t>(vertices_.size());
      for (const std::uint32_t i : primitive.indices) indices_.push_back(first + i);
      append(vertices_, primitive.vertices);
    }
  }

  tinygltf::Mesh add() {
    tinygltf::Mesh out;
    out.name = utf8(part_.name);
    addIndices(out);
    const std::map<std::string, int> shape{{"POSITION", addPositions()}, {"NORMAL", addNormals()}};
    for (std::size_t i = 0; i < primitives_.size(); ++i) {
      out.primitives[i].attributes = shape;
      addLook(primitives_[i], out.primitives[i]);
    }
    addVarying(out);
    if (part_.stats.manifold && part_.stats.watertight)
      addManifold(model_, {indexView_, indexType_, indices_.size()}, mergesOf(mesh_, vertices_, indices_),
                  out);
    return out;
  }

 private:
  /// Adds a view with an element for each of the file's vertices, encoded if the part is to be compressed,
  /// and an accessor for it.
  template <class ElementAt, class Encode>
  int addAttribute(int componentType, int type, ElementAt elementAt, Encode encode) {
    const int target = TINYGLTF_TARGET_ARRAY_BUFFER;
    if (!part_.grid)
      return model_.addAccessor(model_.addView(vertices_.size(), target, elementAt), vertices_.size(),
                                componentType, type);
    std::vector<decltype(elementAt(std::size_t{0}))> elements;
    elements.reserve(vertices_.size());
    for (std::size_t i = 0; i < vertices_.size(); ++i) elements.push_back(elementAt(i));
    return model_.addAccessor(model_.addView(encode(elements), target), vertices_.size(), componentType,
                              type);
  }

  int addPositions() {
    glm::vec3 low(std::numeric_limits<float>::infinity());
    glm::vec3 high = -low;
    const auto at = [&](std::size_t i) {
      const glm::vec3 position = mesh_.positions[vertices_[i]];
      low = glm::min(low, position);
      high = glm::max(high, position);
      return position;
    };
    const auto encode = [&](const std::vector<glm::vec3>& points) {
      return encodePoints(points, *part_.grid);
    };
    const int index = addAttribute(TINYGLTF_COMPONENT_TYPE_FLOAT, TINYGLTF_TYPE_VEC3, at, encode);
    model_.accessors[index].minValues = numbers(low);
    model_.accessors[index].maxValues = numbers(high);
    return index;
  }

  int addNormals() {
    const auto at = [&](std::size_t i) { return unit(mesh_.normals[vertices_[i]]); };
    if (!part_.grid)
      return addAttribute(TINYGLTF_COMPONENT_TYPE_FLOAT, TINYGLTF_TYPE_VEC3, at, encodeUnitVectors);
    // Core glTF has normals in floats only.
    model_.requireExtension("KHR_mesh_quantization");
    const int index = addAttribute(TINYGLTF_COMPONENT_TYPE_SHORT, TINYGLTF_TYPE_VEC3, at, encodeUnitVectors);
    model_.accessors[index].normalized = true;
    return index;
  }

  /// Adds a primitive for each of the mesh's, with its share of the indices.
  void addIndices(tinygltf::Mesh& out) {
    const bool isShort = vertices_.size() <= kMostShortVertices;
    const int target = TINYGLTF_TARGET_ELEMENT_ARRAY_BUFFER;
    const auto at = [&](std::size_t i) { return indices_[i]; };
    const auto shortAt = [&](std::size_t i) { return static_cast<std::uint16_t>(indices_[i]); };
    indexType_ = isShort ? TINYGLTF_COMPONENT_TYPE_UNSIGNED_SHORT : TINYGLTF_COMPONENT_TYPE_UNSIGNED_INT;
    if (part_.grid)
      indexView_ = model_.addView(encodeTriangles(indices_, vertices_.size(), indexSize()), target);
    else
      indexView_ = isShort ? model_.addView(indices_.size(), target, shortAt)
                           : model_.addView(indices_.size(), target, at);
    std::size_t first = 0;
    for (const Primitive& primitive : primitives_) {
      tinygltf::Primitive& added = out.primitives.emplace_back();
      added.mode = TINYGLTF_MODE_TRIANGLES;
      added.indices = addIndexAccessor(first, primitive.indices.size());
      first += primitive.indices.size();
    }
  }

  std::size_t indexSize() const { return indexType_ == TINYGLTF_COMPONENT_TYPE_UNSIGNED_SHORT ? 2 : 4; }

  int addIndexAccessor(std::size_t first, std::size_t count) {
    return model_.addAccessor(indexView_, count, indexType_, TINYGLTF_TYPE_SCALAR, first * indexSize());
  }

  /// Gives the primitive its material, and puts what varies over it at the end of `colors_` and
  /// `coordinates_`, where all of their vertices stand one after another.
  void addLook(const Primitive& primitive, tinygltf::Primitive& out) {
    MeshMaterial material = mesh_.materials[primitive.material];
    BakedEmission baked;
    if (part_.ambient) {
      baked = bakedEmission(mesh_, primitive, *part_.ambient);
      material.emission = baked.peak;
    }
    const PbrMaterial pbr = toMetallicRoughness(material);
    std::vector<ColorValue> colors;
    for (const std::uint32_t v : primitive.vertices)
      colors.push_back(quantized(pbr.baseColor(mesh_.colors[v])));
    const bool plain = std::ranges::all_of(colors, [&](const ColorValue& c) { return c == colors[0]; });
    const bool textured = !baked.coordinates.empty();
    out.material = addMaterial(model_, material.name, pbr,
                               plain ? pbr.baseColor(mesh_.colors[primitive.vertices[0]]) : glm::vec3(1.0f),
                               textured ? std::span<const Texel>(baked.texels) : std::span<const Texel>());
    isColored_.push_back(!plain);
    isTextured_.push_back(textured);
    append(colors_, colors);
    baked.coordinates.resize(primitive.vertices.size());
    append(coordinates_, baked.coordinates);
  }

  /// Adds the colours and the texture coordinates, each if one of the primitives has them.
  void addVarying(tinygltf::Mesh& out) {
    const auto addTo = [&](const std::vector<bool>& which, const char* name, int componentType, int type,
                           const auto& values) {
      const int index = addAttribute(
          componentType, type, [&](std::size_t i) { return values[i]; },
          [](const auto& elements) { return encodeAll(elements); });
      model_.accessors[index].normalized = true;
      for (std::size_t i = 0; i < which.size(); ++i)
        if (which[i]) out.primitives[i].attributes[name] = index;
    };
    const auto any = [](const std::vector<bool>& which) {
      return std::ranges::find(which, true) != which.end();
    };
    constexpr int kShort = TINYGLTF_COMPONENT_TYPE_UNSIGNED_SHORT;
    if (any(isColored_)) {
      const std::vector<ByteColor> bytes = part_.grid ? inBytes(colors_) : std::vector<ByteColor>();
      if (bytes.empty())
        addTo(isColored_, "COLOR_0", kShort, TINYGLTF_TYPE_VEC3, colors_);
      else
        addTo(isColored_, "COLOR_0", TINYGLTF_COMPONENT_TYPE_UNSIGNED_BYTE, TINYGLTF_TYPE_VEC3, bytes);
    }
    if (any(isTextured_)) addTo(isTextured_, "TEXCOORD_0", kShort, TINYGLTF_TYPE_VEC2, coordinates_);
  }

  GltfModel& model_;
  const ExportPart& part_;
  const Mesh& mesh_;
  std::vector<Primitive> primitives_;
  std::vector<std::uint32_t> vertices_;  // the primitives' one after another, into the mesh's vertex arrays
  std::vector<std::uint32_t> indices_;   // into vertices_
  int indexType_ = 0, indexView_ = -1;
  std::vector<bool> isColored_, isTextured_;  // by primitive
  std::vector<ColorValue> colors_;
  std::vector<CoordinateValue> coordinates_;
};

}  // namespace

tinygltf::Node partNode(GltfModel& model, const ExportPart& part) {
  tinygltf::Node node;
  node.name = utf8(part.name);
  Value::Object extras = extrasOf(part.stats);
  if (part.ambient) extras["ambientError"] = Value(static_cast<double>(part.ambient->error));
  node.extras = Value(std::move(extras));
  if (part.mesh.triangles.empty()) return node;
  node.mesh = static_cast<int>(model.meshes.size());
  model.meshes.push_back(MeshWriter(model, part).add());
  return node;
}

std::size_t mostBytesOf(const ExportPart& part) {
  constexpr std::size_t kVertex = 2 * sizeof(glm::vec3) + sizeof(ColorValue) + sizeof(CoordinateValue);
  constexpr std::size_t kTriangle = sizeof(glm::uvec3);
  constexpr std::size_t kPrimitive = 512;  // padding and textures
  constexpr std::size_t kCopy = 64;        // a place and a vertex for each of some six corners or fewer
  const Mesh& mesh = part.mesh;
  return mesh.positions.size() * kVertex + mesh.triangles.size() * kTriangle +
         mesh.materials.size() * kPrimitive + mesh.copyOf.size() * kCopy;
}

Box boundsOfMeshes(const GltfModel& model) {
  const auto corner = [](const std::vector<double>& v) { return glm::dvec3(v[0], v[1], v[2]); };
  Box all;
  for (const tinygltf::Mesh& mesh : model.meshes) {
    const tinygltf::Accessor& positions = model.accessors[mesh.primitives[0].attributes.at("POSITION")];
    all = unite(all, Box{corner(positions.minValues), corner(positions.maxValues)});
  }
  return all;
}

}  // namespace sdf
