// glTF's containers, JSON and buffers.
#include <algorithm>
#include <cstring>
#include <limits>
#include <nlohmann/json.hpp>

#include "sdf/base/file.h"
#include "sdf/meshfile/gltf_document-inl.h"
#include "sdf/meshfile/meshopt.h"

namespace sdf {
namespace {

using Json = nlohmann::json;

constexpr std::string_view kCompression = "EXT_meshopt_compression";
/// What a file may require of its reader: that it knows them, or that they do not matter to a mesh.
constexpr std::string_view kUnderstood[] = {kCompression, "KHR_lights_punctual",
                                            "KHR_materials_emissive_strength", "KHR_mesh_quantization",
                                            "KHR_texture_transform"};

/// tinygltf goes into extensions and extras by recursion.
constexpr int kDeepestNesting = 64;
struct NestedTooDeep {};

std::uint32_t word(std::string_view bytes, std::size_t at) {
  std::uint32_t value = 0;
  std::memcpy(&value, bytes.data() + at, sizeof value);
  return value;
}

/// The list of that name; empty where there is none.
const Json& listIn(const Json& object, const char* name) {
  static const Json none = Json::array();
  const auto found = object.find(name);
  return found != object.end() && found->is_array() ? *found : none;
}

std::string textIn(const Json& object, const char* name) {
  const auto found = object.find(name);
  return found != object.end() && found->is_string() ? found->get<std::string>() : "";
}

std::optional<std::size_t> sizeIn(const Json& object, const char* name) {
  const auto found = object.find(name);
  if (found == object.end() || !found->is_number_unsigned()) return std::nullopt;
  return found->get<std::size_t>();
}

/// RFC 3986, 2.1: "%20" for a blank.
std::string unescaped(const std::string& uri) {
  const auto digit = [](char c) {
    if (c >= '0' && c <= '9') return c - '0';
    c = static_cast<char>(c | 0x20);
    return c >= 'a' && c <= 'f' ? c - 'a' + 10 : -1;
  };
  std::string out;
  for (std::size_t i = 0; i < uri.size(); ++i) {
    const bool escape =
        uri[i] == '%' && i + 2 < uri.size() && digit(uri[i + 1]) >= 0 && digit(uri[i + 2]) >= 0;
    out += escape ? static_cast<char>(16 * digit(uri[i + 1]) + digit(uri[i + 2])) : uri[i];
    i += escape ? 2 : 0;
  }
  return out;
}

/// The bytes that a URI stands for: its own, or another file's.
Result<std::string> bytesAt(const MeshFile& file, const std::string& uri) {
  if (uri.starts_with("data:")) {
    std::vector<unsigned char> bytes;
    std::string kind;
    if (!tinygltf::DecodeDataURI(&bytes, kind, uri, 0, false))
      return unreadable(file.path, "it has data of an unknown kind: " + inQuotes(uri));
    return std::string(bytes.begin(), bytes.end());
  }
  Result<MeshFile> other = readBeside(file.path, unescaped(uri));
  if (!other) return other.error();
  return std::move(other->bytes);
}

}  // namespace

/// Fills a document, from the outside in.
class GltfOpener {
 public:
  explicit GltfOpener(const MeshFile& file) : file_(file) { out_.file_ = &file; }

  Result<GltfDocument> open() {
    for (Status (GltfOpener::*step)() :
         {&GltfOpener::openContainer, &GltfOpener::parse, &GltfOpener::checkDemands, &GltfOpener::openBuffers,
          &GltfOpener::handOver})
      if (Status done = (this->*step)(); !done) return done.error();
    return std::move(out_);
  }

 private:
  Error bad(const std::string& what) const { return unreadable(file_.path, what); }

  /// 4.4: a header, a chunk of JSON and perhaps one of data.
  Status openContainer() {
    constexpr std::uint32_t kJsonChunk = 0x4E4F534A, kBinaryChunk = 0x004E4942;
    constexpr std::size_t kHeader = 12, kChunkHeader = 8;
    std::string_view bytes = file_.bytes;
    json_ = bytes;
    if (!bytes.starts_with("glTF")) {
      return lowerExtension(file_.path) == ".glb"
                 ? Status(bad("it is no binary glTF: it does not begin with 'glTF'"))
                 : okStatus();
    }
    const auto cutOff = [&](std::size_t length) {
      return bad("it is cut off: " + std::to_string(bytes.size()) + " of its " + std::to_string(length) +
                 " bytes are there");
    };
    if (bytes.size() < kHeader + kChunkHeader) return cutOff(kHeader + kChunkHeader);
    if (word(bytes, 4) != 2)
      return bad("it is glTF " + std::to_string(word(bytes, 4)) + ", and only 2 is read");
    if (word(bytes, 8) > bytes.size()) return cutOff(word(bytes, 8));
    bytes = bytes.substr(0, std::max<std::size_t>(word(bytes, 8), kHeader));
    for (std::size_t at = kHeader, chunk = 0; at + kChunkHeader <= bytes.size(); ++chunk) {
      const std::size_t length = word(bytes, at), kind = word(bytes, at + 4);
      at += kChunkHeader;
      if (length > bytes.size() - at) return cutOff(at + length);
      if (chunk == 0 && kind != kJsonChunk) return bad("its first chunk is not JSON");
      if (chunk == 0) json_ = bytes.substr(at, length);
      if (chunk == 1 && kind == kBinaryChunk) binary_ = bytes.substr(at, length);
      at += length;
    }
    return okStatus();
  }

  Status parse() {
    const Json::parser_callback_t shallow = [](int depth, Json::parse_event_t, Json&) {
      if (depth > kDeepestNesting) throw NestedTooDeep();
      return true;
    };
    try {
      root_ = Json::parse(json_, shallow);
    } catch (const Json::parse_error& error) {
      return bad("its JSON is broken at byte " + std::to_string(error.byte));
    } catch (const Json::exception&) {
      return bad("its JSON is broken");
    } catch (const NestedTooDeep&) {
      return bad("its JSON is nested too deep");
    }
    if (!root_.is_object()) return bad("its JSON is no object");
    return okStatus();
  }

  Status checkDemands() {
    const auto asset = root_.find("asset");
    const std::string version = asset != root_.end() && asset->is_object() ? textIn(*asset, "version") : "";
    if (version.empty()) return bad("it is no glTF: it names no version");
    if (!version.starts_with("2")) return bad("it is glTF " + inQuotes(version) + ", and only 2 is read");
    for (const Json& name : listIn(root_, "extensionsRequired")) {
      const std::string required = name.is_string() ? name.get<std::string>() : "";
      if (std::ranges::find(kUnderstood, required) == std::end(kUnderstood))
        return bad("it requires " + inQuotes(required) + ", which is unknown here; export it without");
    }
    if (!listIn(root_, "animations").empty()) out_.warnings_.emplace_back("its animations are left out");
    if (!listIn(root_, "skins").empty())
      out_.warnings_.emplace_back("its skins are left out: what they bend is read at rest");
    return okStatus();
  }

  Status openBuffers() {
    std::map<std::string, std::string_view> files;  // by URI: buffers may share one
    const Json& buffers = listIn(root_, "buffers");
    for (std::size_t i = 0; i < buffers.size(); ++i) {
      const std::string name = "its buffer " + std::to_string(i);
      const std::optional<std::size_t> length =
          buffers[i].is_object() ? sizeIn(buffers[i], "byteLength") : std::nullopt;
      if (!length) return bad(name + " has no length");
      const std::string uri = textIn(buffers[i], "uri");
      std::optional<std::string_view> data;
      if (i == 0 && uri.empty()) data = binary_;
      if (!uri.empty()) {
        const auto [held, isNew] = files.emplace(uri, std::string_view());
        if (isNew) {
          Result<std::string> bytes = bytesAt(file_, uri);
          if (!bytes) return bytes.error();
          held->second = out_.held_.emplace_back(std::move(*bytes));
        }
        data = held->second;
      }
      if (data && data->size() < *length) {
        return bad(name + " is cut off: " + std::to_string(data->size()) + " of " + std::to_string(*length) +
                   " bytes are there");
      }
      out_.buffers_.push_back(data ? std::optional(data->substr(0, *length)) : std::nullopt);
      out_.decodable_ += data ? kMostExpansion * (data->size() + 1) : 0;
    }
    return okStatus();
  }

  /// tinygltf gets no more than a mesh needs, and nothing that it would read or decode.
  Status handOver() {
    for (const Json& image : listIn(root_, "images")) {
      GltfPicture picture;
      if (image.is_object()) {
        picture.uri = textIn(image, "uri");
        const std::optional<std::size_t> view = sizeIn(image, "bufferView");
        if (view && *view < std::numeric_limits<int>::max()) picture.view = static_cast<int>(*view);
      }
      out_.pictures_.push_back(std::move(picture));
    }
    for (const char* unused : {"animations", "buffers", "cameras", "extensions", "extras", "images", "skins"})
      root_.erase(unused);
    const std::string text = root_.dump(-1, ' ', false, Json::error_handler_t::replace);
    if (text.size() > std::numeric_limits<unsigned>::max()) return bad("its JSON is too long");
    std::string error, warning;
    constexpr unsigned kAnySections = 0;
    tinygltf::TinyGLTF loader;
    const bool loaded = loader.LoadASCIIFromString(&out_.model_, &error, &warning, text.data(),
                                                   static_cast<unsigned>(text.size()), "", kAnySections);
    if (!loaded || !error.empty())
      return bad("it is no valid glTF: " + onOneLine(error.substr(0, error.find('\n'))));
    return okStatus();
  }

 public:
  /// The codec's headers tell of 16 bytes with 2 bits at best.
  static constexpr std::size_t kMostExpansion = 100;

 private:
  const MeshFile& file_;
  std::string_view json_;
  std::optional<std::string_view> binary_;
  Json root_;
  GltfDocument out_;
};

Result<GltfDocument> GltfDocument::open(const MeshFile& file) { return GltfOpener(file).open(); }

Result<std::string_view> GltfDocument::piece(int buffer, std::size_t offset, std::size_t length,
                                             int view) const {
  const auto bad = [&](const std::string& what) {
    return unreadable(file_->path, "its buffer view " + std::to_string(view) + what);
  };
  if (buffer < 0 || buffer >= static_cast<int>(buffers_.size())) return bad(" is of no buffer");
  const std::optional<std::string_view>& bytes = buffers_[buffer];
  if (!bytes) return bad(" is of buffer " + std::to_string(buffer) + ", which is missing");
  if (offset > bytes->size() || length > bytes->size() - offset) return bad(" reaches beyond its buffer");
  return bytes->substr(offset, length);
}

Result<std::string_view> GltfDocument::view(int index) {
  if (index < 0 || index >= static_cast<int>(model_.bufferViews.size()))
    return unreadable(file_->path, "it has no buffer view " + std::to_string(index));
  const tinygltf::BufferView& view = model_.bufferViews[index];
  const auto encoding = view.extensions.find(std::string(kCompression));
  if (encoding != view.extensions.end()) return decoded(index, encoding->second);
  return piece(view.buffer, view.byteOffset, view.byteLength, index);
}

Result<std::string_view> GltfDocument::decoded(int index, const tinygltf::Value& encoding) {
  if (const auto found = views_.find(index); found != views_.end()) return found->second;
  const auto number = [&](const char* name) -> std::size_t {
    const tinygltf::Value& value = encoding.IsObject() ? encoding.Get(name) : encoding;
    const double v = value.IsNumber() ? value.GetNumberAsDouble() : 0.0;
    return v >= 0.0 && v < 1e15 ? static_cast<std::size_t>(v) : 0;
  };
  const auto text = [&](const char* name) {
    const tinygltf::Value& value = encoding.IsObject() ? encoding.Get(name) : encoding;
    return value.IsString() ? value.Get<std::string>() : std::string();
  };
  const auto bad = [&] {
    return unreadable(file_->path,
                      "its buffer view " + std::to_string(index) + ", which is compressed, is broken");
  };
  const std::string mode = text("mode"), filter = text("filter");
  const std::size_t count = number("count"), stride = number("byteStride"), length = number("byteLength");
  const auto buffer = static_cast<int>(std::min<std::size_t>(number("buffer"), buffers_.size()));
  const Result<std::string_view> bytes = piece(buffer, number("byteOffset"), length, index);
  if (!bytes) return bytes.error();
  if (stride == 0 || stride > 256 || count > decodable_ / stride) return bad();
  decodable_ -= count * stride;
  Encoded encoded{mode, filter, count, stride, {bytes->begin(), bytes->end()}};
  const std::optional<std::vector<unsigned char>> elements = decode(encoded);
  if (!elements) return bad();
  return views_[index] = held_.emplace_back(elements->begin(), elements->end());
}

Result<std::string> GltfDocument::pictureBytes(const GltfPicture& picture) {
  if (!picture.uri.empty()) return bytesAt(*file_, picture.uri);
  const Result<std::string_view> bytes = view(picture.view);
  if (!bytes) return bytes.error();
  return std::string(*bytes);
}

}  // namespace sdf
