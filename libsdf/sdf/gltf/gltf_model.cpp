#include <algorithm>
#include <limits>
#include <sstream>
#include <utility>

#include "sdf/base/version.h"
#include "sdf/gltf/glb.h"
#include "sdf/gltf/gltf_model-inl.h"

namespace sdf {
namespace {

/// The length of a .glb is a 32-bit number; the rest is left for the JSON chunk.
constexpr std::uint64_t kMostBinaryBytes = (1ull << 32) - (1ull << 26);
/// tinygltf's numbers in extensions have 31 bits.
constexpr std::uint64_t kMostEncodedBytes = std::numeric_limits<int>::max();

constexpr const char* kCompression = "EXT_meshopt_compression";

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

std::string replaced(const std::string& text, const std::string& from, const std::string& to) {
  std::string out;
  std::size_t begin = 0;
  for (std::size_t at = text.find(from); at != text.npos; at = text.find(from, begin)) {
    out.append(text, begin, at - begin).append(to);
    begin = at + from.size();
  }
  return out.append(text, begin);
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

void GltfModel::requireExtension(const std::string& name) {
  useExtension(name);
  if (std::ranges::find(extensionsRequired, name) == extensionsRequired.end())
    extensionsRequired.push_back(name);
}

int GltfModel::addAccessor(int view, std::size_t count, int componentType, int type, std::size_t byteOffset) {
  tinygltf::Accessor accessor;
  accessor.bufferView = view;
  accessor.byteOffset = byteOffset;
  accessor.componentType = componentType;
  accessor.type = type;
  accessor.count = count;
  accessors.push_back(std::move(accessor));
  return static_cast<int>(accessors.size()) - 1;
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

int GltfModel::addView(const Encoded& encoded, int target) {
  using tinygltf::Value;
  const auto number = [](std::size_t n) { return Value(static_cast<int>(n)); };
  tinygltf::BufferView view;
  view.buffer = 1;  // a placeholder that no file holds
  view.byteOffset = decodedBytes_;
  view.byteLength = encoded.count * encoded.stride;
  view.target = target;
  if (target == TINYGLTF_TARGET_ARRAY_BUFFER) view.byteStride = encoded.stride;
  decodedBytes_ += (view.byteLength + 3) / 4 * 4;
  // tinygltf 2.7 writes a view's extras but not its extensions; json() makes one of the other.
  view.extras = Value(
      Value::Object{{kCompression, Value(Value::Object{{"buffer", Value(0)},
                                                       {"byteOffset", number(bytes().size())},
                                                       {"byteLength", number(encoded.bytes.size())},
                                                       {"byteStride", number(encoded.stride)},
                                                       {"count", number(encoded.count)},
                                                       {"mode", Value(std::string(encoded.mode))},
                                                       {"filter", Value(std::string(encoded.filter))}})}});
  bytes().insert(bytes().end(), encoded.bytes.begin(), encoded.bytes.end());
  bytes().resize((bytes().size() + 3) / 4 * 4);
  requireExtension(kCompression);
  bufferViews.push_back(std::move(view));
  return static_cast<int>(bufferViews.size()) - 1;
}

Status GltfModel::write(std::ostream& out, GltfContainer container) {
  if (bytes().empty()) buffers.clear();
  if (decodedBytes_ > 0 && bytes().size() > kMostEncodedBytes) {
    return Error{ErrorKind::Limits,
                 "the compressed meshes take " + std::to_string(bytes().size() >> 20) +
                     " MiB and a file holds 2047; use larger voxels, or leave the compression out"};
  }
  if (container == GltfContainer::Binary) return writeBinary(out);
  if (decodedBytes_ == 0) {
    constexpr bool kPretty = true, kBinary = false;
    tinygltf::TinyGLTF().WriteGltfSceneToStream(this, out, kPretty, kBinary);
    return okStatus();
  }
  std::string text = json();
  text.insert(text.find("}]", text.find("\"buffers\":[")) + 1, placeholder());
  out << text;
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
  std::string text = json();
  if (!data.empty()) {
    const std::string length = std::to_string(data.size());
    text.insert(text.rfind('}'), ",\"buffers\":[{\"byteLength\":" + length + "}" + placeholder() + "]");
  }
  writeGlb(out, text, data);
  return okStatus();
}

/// The model on one line. No name in it reads as what is replaced here or found later: JSON escapes quotes.
std::string GltfModel::json() {
  std::ostringstream stream;
  constexpr bool kPretty = false, kBinary = false;
  tinygltf::TinyGLTF().WriteGltfSceneToStream(this, stream, kPretty, kBinary);
  const std::string text = std::move(stream).str();
  const std::string name = std::string("{\"") + kCompression + "\":";
  return replaced(text, "\"extras\":" + name, "\"extensions\":" + name);
}

/// What stands in the list of buffers for the one that no file holds; "" where no view is encoded.
std::string GltfModel::placeholder() const {
  if (decodedBytes_ == 0) return "";
  return ",{\"byteLength\":" + std::to_string(decodedBytes_) + ",\"extensions\":{\"" + kCompression +
         "\":{\"fallback\":true}}}";
}

tinygltf::Node placed(const std::string& name, const Placement& placement) {
  tinygltf::Node node;
  node.name = name;
  if (placement.position != glm::dvec3(0.0)) node.translation = numbers(placement.position);
  if (placement.rotation != glm::dquat(1.0, 0.0, 0.0, 0.0)) node.rotation = numbers(placement.rotation);
  return node;
}

}  // namespace sdf
