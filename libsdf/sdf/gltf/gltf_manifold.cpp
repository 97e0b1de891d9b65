#include "sdf/gltf/gltf_manifold-inl.h"

#include <utility>

namespace sdf {
namespace {

using tinygltf::Value;

constexpr int kNoTarget = 0;

/// Index of a view of these numbers, in as many bits as the component type has.
int addNumbers(GltfModel& model, const std::vector<std::uint32_t>& numbers, int componentType) {
  if (componentType == TINYGLTF_COMPONENT_TYPE_UNSIGNED_INT)
    return model.addView(numbers.size(), kNoTarget, [&](std::size_t i) { return numbers[i]; });
  return model.addView(numbers.size(), kNoTarget,
                       [&](std::size_t i) { return static_cast<std::uint16_t>(numbers[i]); });
}

/// Index of an accessor of all indices.
int accessorOfAll(GltfModel& model, const IndexView& indices, const Merges& merges,
                  const tinygltf::Mesh& mesh) {
  if (mesh.primitives.size() == 1 && merges.places.empty()) return mesh.primitives[0].indices;
  return model.addAccessor(indices.view, indices.count, indices.componentType, TINYGLTF_TYPE_SCALAR);
}

/// Overlays the accessor with the merges, and names them once more as accessors of their own.
void merge(GltfModel& model, int accessor, const Merges& merges, Value::Object& extension) {
  constexpr int kPlaceType = TINYGLTF_COMPONENT_TYPE_UNSIGNED_INT;
  const std::size_t count = merges.places.size();
  const int vertexType = model.accessors[accessor].componentType;
  const int places = addNumbers(model, merges.places, kPlaceType);
  const int vertices = addNumbers(model, merges.vertices, vertexType);
  auto& sparse = model.accessors[accessor].sparse;
  sparse.isSparse = true;
  sparse.count = static_cast<int>(count);
  sparse.indices.bufferView = places;
  sparse.indices.byteOffset = 0;
  sparse.indices.componentType = kPlaceType;
  sparse.values.bufferView = vertices;
  sparse.values.byteOffset = 0;
  extension["mergeIndices"] = Value(model.addAccessor(places, count, kPlaceType, TINYGLTF_TYPE_SCALAR));
  extension["mergeValues"] = Value(model.addAccessor(vertices, count, vertexType, TINYGLTF_TYPE_SCALAR));
}

}  // namespace

void addManifold(GltfModel& model, const IndexView& indices, const Merges& merges, tinygltf::Mesh& mesh) {
  Value::Object extension;
  const int all = accessorOfAll(model, indices, merges, mesh);
  if (!merges.places.empty()) merge(model, all, merges, extension);
  const int positions = mesh.primitives[0].attributes.at("POSITION");
  extension["manifoldPrimitive"] =
      Value(Value::Object{{"mode", Value(TINYGLTF_MODE_TRIANGLES)},
                          {"indices", Value(all)},
                          {"attributes", Value(Value::Object{{"POSITION", Value(positions)}})}});
  mesh.extensions["EXT_mesh_manifold"] = Value(std::move(extension));
  model.useExtension("EXT_mesh_manifold");
}

}  // namespace sdf
