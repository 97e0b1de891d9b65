#include <algorithm>
#include <sstream>
#include <utility>

#include "sdf/base/version.h"
#include "sdf/gltf/glb.h"
#include "sdf/gltf/gltf_model-inl.h"

namespace sdf {
namespace {

/// The length of a .glb is a 32-bit number; the rest is left for the JSON chunk.
constexpr std::uint64_t kMostBinaryBytes = (1ull << 32) - (1ull << 26);

/// tinygltf hands out its encoder's bytes as a data URI only.
std::vector<unsigned char> png(int side, std::span<const Texel> texels) {
  tinygltf::Image image;
  image.width = image.height = side;
  image.component = 3;
  image.bits = 8;
  image.pixel_type = TINYGLTF_COMPONENT_TYPE_UNSIGNED_BYTE;
  for (const Texel& texel : texels) image.image.insert(image.image.end(), {texel.x, texel.y, texel.z});
  const std::string folder, name = "texels.png";
  std::string uri, kind;
  std::vector<unsigned char> bytes;
  constexpr bool kEmbedded = true;
  tinygltf::WriteImageData(&folder, &name, &image, kEmbedded, &uri, nullptr);
  tinygltf::DecodeDataURI(&bytes, kind, uri, 0, false);
  return bytes;
}

}  // namespace

tinygltf::Value::Object extrasOf(const MeshStats& stats) {
  using tinygltf::Value;
  tinygltf::Value::Object extras{
      {"voxelSize", Value(stats.voxelSize)},     {"rmsDistance", Value(stats.rmsDistance)},
      {"maxDistance", Value(stats.maxDistance)}, {"watertight", Value(stats.watertight)},
      {"manifold", Value(stats.manifold)},       {"unresolved", Value(static_cast<double>(stats.unresolved))},
  };
  if (stats.provenDistance > 0.0) extras["provenDistance"] = Value(stats.provenDistance);
  return extras;
}

GltfModel::GltfModel() {
  asset.version = "2.0";
  asset.generator = std::string("libsdf ") + version();
  buffers.emplace_back();
  scenes.emplace_back();
  defaultScene = 0;
}

int GltfModel::addNode(tinygltf::Node node) {
  scenes[0].nodes.push_back(static_cast<int>(nodes.size()));
  nodes.push_back(std::move(node));
  return scenes[0].nodes.back();
}

int GltfModel::addNode(tinygltf::Node node, int parent) {
  const int index = static_cast<int>(nodes.size());
  nodes[parent].children.push_back(index);
  nodes.push_back(std::move(node));
  return index;
}

void GltfModel::useExtension(const std::string& name) {
  if (std::ranges::find(extensionsUsed, name) == extensionsUsed.end()) extensionsUsed.push_back(name);
}

int GltfModel::addImage(int side, std::span<const Texel> texels) {
  const std::vector<unsigned char> picture = png(side, texels);
  const int place = placeOf(picture, pictures_);
  if (place < static_cast<int>(images.size())) return place;
  tinygltf::BufferView view;
  view.buffer = 0;
  view.byteOffset = bytes().size();
  view.byteLength = picture.size();
  bytes().insert(bytes().end(), picture.begin(), picture.end());
  bytes().resize((bytes().size() + 3) / 4 * 4);
  tinygltf::Image image;
  image.bufferView = static_cast<int>(bufferViews.size());
  image.mimeType = "image/png";
  bufferViews.push_back(std::move(view));
  images.push_back(std::move(image));
  return place;
}

Status GltfModel::write(std::ostream& out, GltfContainer container) {
  if (bytes().empty()) buffers.clear();
  if (container == GltfContainer::Binary) return writeBinary(out);
  constexpr bool kPretty = true, kBinary = false;
  tinygltf::TinyGLTF().WriteGltfSceneToStream(this, out, kPretty, kBinary);
  return okStatus();
}

/// tinygltf's own binary writer copies all data once more, so it writes the JSON alone, without the buffer.
Status GltfModel::writeBinary(std::ostream& out) {
  const std::vector<tinygltf::Buffer> all = std::exchange(buffers, {});
  const std::vector<unsigned char> none;
  const std::vector<unsigned char>& data = all.empty() ? none : all[0].data;
  if (data.size() > kMostBinaryBytes) {
    return Error{ErrorKind::Limits,
                 "the meshes take " + std::to_string(data.size() >> 20) +
                     " MiB and a .glb holds 4096; use larger voxels, or write .gltf or .ply"};
  }
  std::ostringstream text;
  constexpr bool kPretty = false, kBinary = false;
  tinygltf::TinyGLTF().WriteGltfSceneToStream(this, text, kPretty, kBinary);
  std::string json = std::move(text).str();
  if (!data.empty())
    json.insert(json.rfind('}'), ",\"buffers\":[{\"byteLength\":" + std::to_string(data.size()) + "}]");
  writeGlb(out, json, data);
  return okStatus();
}

tinygltf::Node placed(const std::string& name, const Placement& placement) {
  tinygltf::Node node;
  node.name = name;
  if (placement.position != glm::dvec3(0.0)) node.translation = numbers(placement.position);
  if (placement.rotation != glm::dquat(1.0, 0.0, 0.0, 0.0)) node.rotation = numbers(placement.rotation);
  return node;
}

}  // namespace sdf
