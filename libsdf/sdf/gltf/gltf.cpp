// glTF 2.0 through tinygltf. Khronos, glTF 2.0 Specification (2021), section numbers below.
#include <tiny_gltf.h>

#include <algorithm>
#include <bit>
#include <cmath>
#include <cstring>
#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <limits>
#include <optional>
#include <sstream>
#include <utility>

#include "sdf/base/version.h"
#include "sdf/gltf/formats.h"
#include "sdf/gltf/pbr.h"
#include "sdf/gltf/primitive.h"
#include "sdf/gltf/view.h"

namespace sdf {
namespace {

using tinygltf::Value;

/// 3.7.2.1: 65535 is the restart value of 16-bit indices, so 65,535 vertices are the most.
constexpr std::size_t kMostShortVertices = 65535;
/// The length of a .glb is a 32-bit number; the rest is left for the JSON chunk.
constexpr std::uint64_t kMostBinaryBytes = (1ull << 32) - (1ull << 26);

/// JSON is UTF-8 (RFC 8259): bytes of a name that are not become U+FFFD.
std::string utf8(const std::string& text) {
  // Unicode, table 3-7: no over-long forms, no surrogates, nothing above U+10FFFF.
  constexpr std::uint32_t kLeast[] = {0, 0, 0x80, 0x800, 0x10000};  // by length
  std::string out;
  for (std::size_t i = 0; i < text.size();) {
    const auto at = [&](std::size_t k) { return static_cast<unsigned char>(text[i + k]); };
    const int ones = std::countl_one(at(0));
    const std::size_t length = ones == 0 ? 1 : ones;
    bool valid = ones != 1 && ones <= 4 && i + length <= text.size();
    std::uint32_t code = ones == 0 ? at(0) : at(0) & (0x7F >> ones);
    for (std::size_t k = 1; valid && k < length; ++k) {
      valid = (at(k) & 0xC0) == 0x80;
      code = code << 6 | (at(k) & 0x3F);
    }
    valid = valid && code >= kLeast[length] && code <= 0x10FFFF && (code < 0xD800 || code > 0xDFFF);
    out += valid ? text.substr(i, length) : "\xEF\xBF\xBD";
    i += valid ? length : 1;
  }
  return out;
}

Value extrasOf(const MeshStats& stats) {
  return Value(Value::Object{
      {"voxelSize", Value(stats.voxelSize)},
      {"rmsDistance", Value(stats.rmsDistance)},
      {"maxDistance", Value(stats.maxDistance)},
      {"watertight", Value(stats.watertight)},
      {"manifold", Value(stats.manifold)},
      {"unresolved", Value(static_cast<double>(stats.unresolved))},
  });
}

std::vector<double> numbers(const glm::dvec3& v) { return {v.x, v.y, v.z}; }
std::vector<double> numbers(const glm::dquat& q) { return {q.x, q.y, q.z, q.w}; }

/// A unit vector near `n`; the file must not hold others (3.7.2.1).
glm::vec3 unit(const glm::vec3& n) {
  const glm::dvec3 wide(n);
  const double length = glm::length(wide);
  return length > 0.0 && std::isfinite(length) ? glm::vec3(wide / length) : glm::vec3(0, 1, 0);
}

using ColorValue = glm::vec<4, std::uint16_t>;

/// Linear colour in 16 bits a channel (8 would show bands in the darks), opaque.
ColorValue quantized(const glm::vec3& color) {
  constexpr float kMost = 65535.0f;
  return ColorValue(glm::round(color * kMost), 65535);
}

static_assert(std::endian::native == std::endian::little,
              "glTF's numbers are little-endian, and written as they are");

// 4.4: the .glb of a JSON chunk and, unless there is no data, a BIN chunk.
constexpr std::uint32_t kMagic = 0x46546C67, kVersion = 2;
constexpr std::uint32_t kJsonChunk = 0x4E4F534A, kBinaryChunk = 0x004E4942;
constexpr std::uint32_t kHeader = 12, kChunkHeader = 8;

void put(std::ostream& out, std::uint32_t value) {
  out.write(reinterpret_cast<const char*>(&value), sizeof value);
}

std::uint32_t padded(std::size_t size) { return static_cast<std::uint32_t>((size + 3) / 4 * 4); }

void putChunk(std::ostream& out, std::uint32_t kind, const char* bytes, std::size_t size, char filler) {
  put(out, padded(size));
  put(out, kind);
  out.write(bytes, static_cast<std::streamsize>(size));
  for (std::size_t i = size; i < padded(size); ++i) out.put(filler);
}

void writeGlb(std::ostream& out, std::string_view json, const std::vector<unsigned char>& data) {
  const std::uint32_t binary = data.empty() ? 0 : kChunkHeader + padded(data.size());
  put(out, kMagic);
  put(out, kVersion);
  put(out, kHeader + kChunkHeader + padded(json.size()) + binary);
  putChunk(out, kJsonChunk, json.data(), json.size(), ' ');
  if (!data.empty())
    putChunk(out, kBinaryChunk, reinterpret_cast<const char*>(data.data()), data.size(), '\0');
}

class GltfBuilder {
 public:
  explicit GltfBuilder(const Scene& scene) : scene_(scene) {
    model_.asset.version = "2.0";
    model_.asset.generator = std::string("libsdf ") + version();
    model_.buffers.emplace_back();
    model_.scenes.emplace_back();
    model_.defaultScene = 0;
  }

  void addPart(const ExportPart& part) {
    tinygltf::Node node;
    node.name = utf8(part.name);
    node.extras = extrasOf(part.stats);
    if (!part.mesh.triangles.empty()) {
      tinygltf::Mesh mesh;
      mesh.name = node.name;
      const std::vector<Primitive> primitives = splitByMaterial(part.mesh);
      reserveFor(primitives);
      for (const Primitive& primitive : primitives) {
        mesh.primitives.push_back(addPrimitive(part.mesh, primitive));
      }
      node.mesh = static_cast<int>(model_.meshes.size());
      model_.meshes.push_back(std::move(mesh));
    }
    addNode(std::move(node));
  }

  void addCamera() {
    const std::optional<ViewCamera> view = viewCamera(scene_);
    if (!view) return;
    tinygltf::Camera camera;
    camera.type = "perspective";
    camera.name = "camera";
    camera.perspective.yfov = view->verticalFov;
    camera.perspective.znear = view->near;
    camera.perspective.zfar = view->far;
    model_.cameras.push_back(std::move(camera));
    tinygltf::Node node = placed("camera", view->placement);
    node.camera = 0;
    // A mirrored picture is no rigid placement; whoever can show it finds the wish here.
    if (scene_.camera.mirrored) node.extras = Value(Value::Object{{"mirrored", Value(true)}});
    addNode(std::move(node));
  }

  void addLights() {
    const glm::dvec3 centre = low_.x <= high_.x ? glm::dvec3(low_ + high_) * 0.5 : glm::dvec3(0.0);
    for (const ViewLight& view : viewLights(scene_, centre)) {
      const int index = static_cast<int>(model_.lights.size());
      const std::string name = "light " + std::to_string(index + 1);
      tinygltf::Light light;
      light.name = name;
      light.type = view.kind == Light::Kind::Point ? "point" : "directional";
      light.color = numbers(view.color);
      light.intensity = view.intensity;
      model_.lights.push_back(std::move(light));
      tinygltf::Node node = placed(name, view.placement);
      node.extensions["KHR_lights_punctual"] = Value(Value::Object{{"light", Value(index)}});
      addNode(std::move(node));
    }
  }

  void setExtras(const MeshStats& stats) { model_.asset.extras = extrasOf(stats); }

  /// Writes what was built, which is gone then.
  Status write(std::ostream& out, GltfContainer container) {
    if (bytes().empty()) model_.buffers.clear();
    if (container == GltfContainer::Binary) return writeBinary(out);
    constexpr bool kPretty = true, kBinary = false;
    tinygltf::TinyGLTF().WriteGltfSceneToStream(&model_, out, kPretty, kBinary);
    return okStatus();
  }

 private:
  std::vector<unsigned char>& bytes() { return model_.buffers[0].data; }

  /// tinygltf's own binary writer copies all data once more, so it writes the JSON alone, without the buffer.
  Status writeBinary(std::ostream& out) {
    const std::vector<tinygltf::Buffer> buffers = std::exchange(model_.buffers, {});
    const std::vector<unsigned char> none;
    const std::vector<unsigned char>& data = buffers.empty() ? none : buffers[0].data;
    if (data.size() > kMostBinaryBytes) {
      return Error{ErrorKind::Limits,
                   "the meshes take " + std::to_string(data.size() >> 20) +
                       " MiB and a .glb holds 4096; use larger voxels, or write .gltf or .ply"};
    }
    std::ostringstream text;
    constexpr bool kPretty = false, kBinary = false;
    tinygltf::TinyGLTF().WriteGltfSceneToStream(&model_, text, kPretty, kBinary);
    std::string json = std::move(text).str();
    if (!data.empty()) {
      json.insert(json.rfind('}'), ",\"buffers\":[{\"byteLength\":" + std::to_string(data.size()) + "}]");
    }
    writeGlb(out, json, data);
    return okStatus();
  }

  void addNode(tinygltf::Node node) {
    model_.scenes[0].nodes.push_back(static_cast<int>(model_.nodes.size()));
    model_.nodes.push_back(std::move(node));
  }

  static tinygltf::Node placed(const std::string& name, const Placement& placement) {
    tinygltf::Node node;
    node.name = name;
    if (placement.position != glm::dvec3(0.0)) node.translation = numbers(placement.position);
    if (placement.rotation != glm::dquat(1.0, 0.0, 0.0, 0.0)) node.rotation = numbers(placement.rotation);
    return node;
  }

  void useExtension(const std::string& name) {
    std::vector<std::string>& used = model_.extensionsUsed;
    if (std::ranges::find(used, name) == used.end()) used.push_back(name);
  }

  /// Makes room for all that a part's primitives will add, so that the data is never moved.
  void reserveFor(const std::vector<Primitive>& primitives) {
    std::size_t size = bytes().size();
    for (const Primitive& primitive : primitives) {
      const std::size_t perIndex = primitive.vertices.size() > kMostShortVertices ? 4 : 2;
      const std::size_t perVertex = 2 * sizeof(glm::vec3) + sizeof(ColorValue);
      constexpr std::size_t kPadding = 4;
      size += primitive.indices.size() * perIndex + primitive.vertices.size() * perVertex + kPadding;
    }
    bytes().reserve(size);
  }

  /// Appends elementAt(0) … elementAt(count - 1) and returns the index of an accessor for them. Their sizes
  /// are multiples of four except for 16-bit indices, so the next view is aligned by padding.
  template <class ElementAt>
  int addAccessor(std::size_t count, int target, int componentType, int type, ElementAt elementAt) {
    using Element = decltype(elementAt(0));
    std::vector<unsigned char>& data = bytes();
    tinygltf::BufferView view;
    view.buffer = 0;
    view.byteOffset = data.size();
    view.byteLength = count * sizeof(Element);
    view.target = target;
    data.resize((data.size() + view.byteLength + 3) / 4 * 4);
    for (std::size_t i = 0; i < count; ++i) {
      const Element element = elementAt(i);
      std::memcpy(data.data() + view.byteOffset + i * sizeof(Element), &element, sizeof(Element));
    }

    tinygltf::Accessor accessor;
    accessor.bufferView = static_cast<int>(model_.bufferViews.size());
    accessor.componentType = componentType;
    accessor.type = type;
    accessor.count = count;
    model_.bufferViews.push_back(std::move(view));
    model_.accessors.push_back(std::move(accessor));
    return static_cast<int>(model_.accessors.size()) - 1;
  }

  /// The same with an element for each vertex of the primitive, made from the mesh's vertex.
  template <class ElementOf>
  int addAttribute(const Primitive& primitive, int componentType, int type, ElementOf elementOf) {
    return addAccessor(primitive.vertices.size(), TINYGLTF_TARGET_ARRAY_BUFFER, componentType, type,
                       [&](std::size_t i) { return elementOf(primitive.vertices[i]); });
  }

  int addPositions(const Mesh& mesh, const Primitive& primitive) {
    glm::vec3 low(std::numeric_limits<float>::infinity());
    glm::vec3 high = -low;
    const int index =
        addAttribute(primitive, TINYGLTF_COMPONENT_TYPE_FLOAT, TINYGLTF_TYPE_VEC3, [&](std::uint32_t vertex) {
          low = glm::min(low, mesh.positions[vertex]);
          high = glm::max(high, mesh.positions[vertex]);
          return mesh.positions[vertex];
        });
    low_ = glm::min(low_, low);
    high_ = glm::max(high_, high);
    model_.accessors[index].minValues = numbers(low);
    model_.accessors[index].maxValues = numbers(high);
    return index;
  }

  int addIndices(const Primitive& primitive) {
    const int target = TINYGLTF_TARGET_ELEMENT_ARRAY_BUFFER;
    const std::vector<std::uint32_t>& indices = primitive.indices;
    if (primitive.vertices.size() > kMostShortVertices) {
      return addAccessor(indices.size(), target, TINYGLTF_COMPONENT_TYPE_UNSIGNED_INT, TINYGLTF_TYPE_SCALAR,
                         [&](std::size_t i) { return indices[i]; });
    }
    return addAccessor(indices.size(), target, TINYGLTF_COMPONENT_TYPE_UNSIGNED_SHORT, TINYGLTF_TYPE_SCALAR,
                       [&](std::size_t i) { return static_cast<std::uint16_t>(indices[i]); });
  }

  tinygltf::Primitive addPrimitive(const Mesh& mesh, const Primitive& primitive) {
    const MeshMaterial& material = mesh.materials[primitive.material];
    const PbrMaterial pbr = toMetallicRoughness(material);
    const auto colorOf = [&](std::uint32_t vertex) { return pbr.baseColor(mesh.colors[vertex]); };
    const std::uint32_t first = primitive.vertices[0];
    const bool plain = std::ranges::all_of(
        primitive.vertices,
        [&, color = quantized(colorOf(first))](std::uint32_t v) { return quantized(colorOf(v)) == color; });

    tinygltf::Primitive out;
    out.mode = TINYGLTF_MODE_TRIANGLES;
    out.indices = addIndices(primitive);
    out.attributes["POSITION"] = addPositions(mesh, primitive);
    out.attributes["NORMAL"] = addAttribute(primitive, TINYGLTF_COMPONENT_TYPE_FLOAT, TINYGLTF_TYPE_VEC3,
                                            [&](std::uint32_t vertex) { return unit(mesh.normals[vertex]); });
    if (!plain) {
      const int index = addAttribute(primitive, TINYGLTF_COMPONENT_TYPE_UNSIGNED_SHORT, TINYGLTF_TYPE_VEC4,
                                     [&](std::uint32_t vertex) { return quantized(colorOf(vertex)); });
      model_.accessors[index].normalized = true;
      out.attributes["COLOR_0"] = index;
    }
    out.material = addMaterial(material.name, pbr, plain ? colorOf(first) : glm::vec3(1.0f));
    return out;
  }

  /// Index of the material; parts that wear the same one share it.
  int addMaterial(const std::string& name, const PbrMaterial& pbr, const glm::vec3& baseColor) {
    tinygltf::Material material;
    material.name = utf8(name);
    material.pbrMetallicRoughness.baseColorFactor = {baseColor.x, baseColor.y, baseColor.z, 1.0};
    material.pbrMetallicRoughness.metallicFactor = pbr.metallic;
    material.pbrMetallicRoughness.roughnessFactor = pbr.roughness;
    material.emissiveFactor = numbers(pbr.emissiveFactor);
    if (pbr.emissiveStrength > 1.0f) {
      material.extensions["KHR_materials_emissive_strength"] =
          Value(Value::Object{{"emissiveStrength", Value(static_cast<double>(pbr.emissiveStrength))}});
      useExtension("KHR_materials_emissive_strength");
    }
    const auto found = std::ranges::find(model_.materials, material);
    if (found != model_.materials.end()) return static_cast<int>(found - model_.materials.begin());
    model_.materials.push_back(std::move(material));
    return static_cast<int>(model_.materials.size()) - 1;
  }

  const Scene& scene_;
  tinygltf::Model model_;
  glm::vec3 low_{std::numeric_limits<float>::infinity()};
  glm::vec3 high_{-std::numeric_limits<float>::infinity()};
};

}  // namespace

Status encodeGltf(std::ostream& out, GltfContainer container, const Scene& scene,
                  const std::vector<ExportPart>& parts) {
  GltfBuilder builder(scene);
  for (const ExportPart& part : parts) builder.addPart(part);
  builder.addCamera();
  builder.addLights();
  builder.setExtras(combined(parts));
  return builder.write(out, container);
}

}  // namespace sdf
