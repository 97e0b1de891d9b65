// What accessors stand for.
#include <algorithm>
#include <cstring>
#include <limits>

#include "sdf/meshfile/gltf_document-inl.h"

namespace sdf {
namespace {

std::size_t sizeOf(int componentType) {
  switch (componentType) {
    case TINYGLTF_COMPONENT_TYPE_BYTE:
    case TINYGLTF_COMPONENT_TYPE_UNSIGNED_BYTE:
      return 1;
    case TINYGLTF_COMPONENT_TYPE_SHORT:
    case TINYGLTF_COMPONENT_TYPE_UNSIGNED_SHORT:
      return 2;
    case TINYGLTF_COMPONENT_TYPE_UNSIGNED_INT:
    case TINYGLTF_COMPONENT_TYPE_FLOAT:
      return 4;
    default:
      return 0;  // glTF has no others
  }
}

int componentsOf(int type) {
  switch (type) {
    case TINYGLTF_TYPE_SCALAR:
      return 1;
    case TINYGLTF_TYPE_VEC2:
      return 2;
    case TINYGLTF_TYPE_VEC3:
      return 3;
    case TINYGLTF_TYPE_VEC4:
      return 4;
    default:
      return 0;  // vertices have no matrices
  }
}

template <class T>
T stored(const char* at) {
  T value;
  std::memcpy(&value, at, sizeof value);
  return value;
}

/// 3.11: whole numbers as shares of the largest, from -1 on.
template <class T>
float component(const char* at, bool normalized) {
  const auto value = static_cast<float>(stored<T>(at));
  return normalized ? std::max(value / static_cast<float>(std::numeric_limits<T>::max()), -1.0f) : value;
}

float component(const char* at, int type, bool normalized) {
  switch (type) {
    case TINYGLTF_COMPONENT_TYPE_BYTE:
      return component<std::int8_t>(at, normalized);
    case TINYGLTF_COMPONENT_TYPE_UNSIGNED_BYTE:
      return component<std::uint8_t>(at, normalized);
    case TINYGLTF_COMPONENT_TYPE_SHORT:
      return component<std::int16_t>(at, normalized);
    case TINYGLTF_COMPONENT_TYPE_UNSIGNED_SHORT:
      return component<std::uint16_t>(at, normalized);
    case TINYGLTF_COMPONENT_TYPE_UNSIGNED_INT:
      return component<std::uint32_t>(at, normalized);
    default:
      return stored<float>(at);
  }
}

std::uint32_t whole(const char* at, int type) {
  switch (type) {
    case TINYGLTF_COMPONENT_TYPE_UNSIGNED_BYTE:
      return stored<std::uint8_t>(at);
    case TINYGLTF_COMPONENT_TYPE_UNSIGNED_SHORT:
      return stored<std::uint16_t>(at);
    default:
      return stored<std::uint32_t>(at);
  }
}

bool isUnsignedType(int type) {
  return type == TINYGLTF_COMPONENT_TYPE_UNSIGNED_BYTE || type == TINYGLTF_COMPONENT_TYPE_UNSIGNED_SHORT ||
         type == TINYGLTF_COMPONENT_TYPE_UNSIGNED_INT;
}

/// Do elements of this size, a stride apart, lie in so many bytes?
bool fit(std::size_t count, std::size_t size, std::size_t stride, std::size_t offset, std::size_t bytes) {
  if (count == 0) return true;
  return offset <= bytes && size <= bytes - offset && count - 1 <= (bytes - offset - size) / stride;
}

}  // namespace

Result<GltfElements> GltfElements::open(GltfDocument& document, int accessor) {
  const tinygltf::Model& model = document.model();
  const auto bad = [&](const std::string& what) {
    return unreadable(document.file().path, "its accessor " + std::to_string(accessor) + what);
  };
  if (accessor < 0 || accessor >= static_cast<int>(model.accessors.size())) return bad(" is missing");
  const tinygltf::Accessor& from = model.accessors[accessor];
  GltfElements out;
  out.componentType_ = from.componentType;
  out.components_ = componentsOf(from.type);
  out.size_ = sizeOf(from.componentType) * out.components_;
  out.normalized_ = from.normalized;
  out.count_ = from.count;
  if (out.size_ == 0) return bad(" is of a type that no vertex has");
  if (out.count_ >= std::numeric_limits<std::uint32_t>::max()) return bad(" is too long");
  if (from.bufferView >= 0) {
    const Result<std::string_view> view = document.view(from.bufferView);
    if (!view) return view.error();
    const std::size_t stride = model.bufferViews[from.bufferView].byteStride;
    out.stride_ = stride != 0 ? stride : out.size_;
    if (!fit(out.count_, out.size_, out.stride_, from.byteOffset, view->size()))
      return bad(" reaches beyond its buffer view");
    out.data_ = view->data() + from.byteOffset;
  } else if (out.count_ > document.file().bytes.size()) {
    return bad(" is too long for what is stored of it");
  }
  if (!from.sparse.isSparse) return out;

  // 3.6.2.3
  const auto& sparse = from.sparse;
  const Result<std::string_view> indices = document.view(sparse.indices.bufferView),
                                 values = document.view(sparse.values.bufferView);
  if (!indices) return indices.error();
  if (!values) return values.error();
  const std::size_t indexSize = sizeOf(sparse.indices.componentType);
  const auto count = static_cast<std::size_t>(std::max(sparse.count, 0));
  const auto indexOffset = static_cast<std::size_t>(std::max(sparse.indices.byteOffset, 0)),
             valueOffset = static_cast<std::size_t>(std::max(sparse.values.byteOffset, 0));
  if (!isUnsignedType(sparse.indices.componentType) ||
      !fit(count, indexSize, indexSize, indexOffset, indices->size()) ||
      !fit(count, out.size_, out.size_, valueOffset, values->size()))
    return bad(" is sparse, and reaches beyond its buffer views");
  for (std::size_t i = 0; i < count; ++i) {
    out.replaced_.push_back(
        whole(indices->data() + indexOffset + i * indexSize, sparse.indices.componentType));
    if (out.replaced_[i] >= out.count_ || (i > 0 && out.replaced_[i] <= out.replaced_[i - 1]))
      return bad(" is sparse, and its indices do not rise");
  }
  out.replacements_ = values->data() + valueOffset;
  return out;
}

bool GltfElements::isUnsigned() const { return isUnsignedType(componentType_); }

const char* GltfElements::bytesOf(std::size_t i) const {
  if (!replaced_.empty()) {
    const auto found = std::ranges::lower_bound(replaced_, i);
    if (found != replaced_.end() && *found == i)
      return replacements_ + static_cast<std::size_t>(found - replaced_.begin()) * size_;
  }
  return data_ ? data_ + i * stride_ : nullptr;
}

glm::vec4 GltfElements::at(std::size_t i) const {
  glm::vec4 out(0.0f);
  const char* bytes = bytesOf(i);
  const std::size_t size = size_ / components_;
  for (int k = 0; bytes && k < components_; ++k)
    out[k] = component(bytes + k * size, componentType_, normalized_);
  return out;
}

std::uint32_t GltfElements::index(std::size_t i) const {
  const char* bytes = bytesOf(i);
  return bytes ? whole(bytes, componentType_) : 0;
}

}  // namespace sdf
