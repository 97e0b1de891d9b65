// PLY (Turk 1994, The PLY Polygon File Format), text and binary of either byte order.
#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <cstring>
#include <iomanip>
#include <limits>
#include <sstream>

#include "sdf/base/srgb.h"
#include "sdf/meshfile/read_formats.h"
#include "sdf/meshfile/text_scan.h"

namespace sdf {
namespace {

enum class PlyType { None, Int8, Uint8, Int16, Uint16, Int32, Uint32, Float, Double };

// clang-format off
constexpr struct { std::string_view name; PlyType type; } kTypes[] = {
    {"char", PlyType::Int8},     {"int8", PlyType::Int8},      {"uchar", PlyType::Uint8},   {"uint8", PlyType::Uint8},
    {"short", PlyType::Int16},   {"int16", PlyType::Int16},    {"ushort", PlyType::Uint16}, {"uint16", PlyType::Uint16},
    {"int", PlyType::Int32},     {"int32", PlyType::Int32},    {"uint", PlyType::Uint32},   {"uint32", PlyType::Uint32},
    {"float", PlyType::Float},   {"float32", PlyType::Float},  {"double", PlyType::Double}, {"float64", PlyType::Double}};
constexpr std::size_t kSizes[] = {0, 1, 1, 2, 2, 4, 4, 4, 8};
// clang-format on

PlyType typeOf(std::string_view name) {
  for (const auto& one : kTypes)
    if (one.name == name) return one.type;
  return PlyType::None;
}
std::size_t sizeOf(PlyType type) { return kSizes[static_cast<int>(type)]; }

/// What the values of a property are for, by its place here.
constexpr std::array<std::string_view, 9> kRoles{"x", "y", "z", "nx", "ny", "nz", "red", "green", "blue"};
constexpr std::size_t kNormalColumn = 3, kColorColumn = 6;

struct PlyProperty {
  std::string name;
  PlyType type = PlyType::None;
  PlyType length = PlyType::None;  ///< of a list's length; None: one value
};

struct PlyElement {
  std::string name;
  std::size_t count = 0;
  std::vector<PlyProperty> properties;

  /// The least that one takes in the file: text has a digit and a blank a value.
  std::size_t leastBytes(bool isText) const {
    std::size_t bytes = 0;
    for (const PlyProperty& p : properties)
      bytes += isText ? 2 : sizeOf(p.length == PlyType::None ? p.type : p.length);
    return bytes;
  }
};

/// The values of a file's body, one after the other.
class PlyValues {
 public:
  PlyValues(std::string_view body, bool isText, bool swapped)
      : body_(body), text_(body), isText_(isText), swapped_(swapped) {}

  /// The next value; once there is none, ok() is false and all are 0.
  double next(PlyType type) {
    if (isText_) return textual();
    switch (type) {
      case PlyType::Int8:
        return binary<std::int8_t>();
      case PlyType::Uint8:
        return binary<std::uint8_t>();
      case PlyType::Int16:
        return binary<std::int16_t>();
      case PlyType::Uint16:
        return binary<std::uint16_t>();
      case PlyType::Int32:
        return binary<std::int32_t>();
      case PlyType::Uint32:
        return binary<std::uint32_t>();
      case PlyType::Float:
        return binary<float>();
      case PlyType::Double:
        return binary<double>();
      case PlyType::None:
        break;
    }
    return 0.0;
  }
  bool ok() const { return ok_; }
  /// A word in the place of a number; empty if the values just end.
  const std::string& wrongWord() const { return wrongWord_; }
  std::size_t bytesLeft() const { return body_.size() - (isText_ ? text_.position() : at_); }

 private:
  double textual() {
    const std::string_view word = text_.wordAnywhere();
    const std::optional<double> value = numberOf<double>(word);
    if (!value && ok_) wrongWord_ = word;
    ok_ = ok_ && value;
    return value.value_or(0.0);
  }
  template <class T>
  double binary() {
    if (body_.size() - at_ < sizeof(T)) {
      ok_ = false;
      at_ = body_.size();
      return 0.0;
    }
    std::array<char, sizeof(T)> bytes;
    std::memcpy(bytes.data(), body_.data() + at_, sizeof(T));
    at_ += sizeof(T);
    if (swapped_) std::ranges::reverse(bytes);
    return static_cast<double>(std::bit_cast<T>(bytes));
  }

  std::string_view body_;
  TextScan text_;
  std::size_t at_ = 0;
  bool isText_, swapped_, ok_ = true;
  std::string wrongWord_;
};

class PlyReader {
 public:
  explicit PlyReader(const MeshFile& file) : file_(file) {}

  Result<ReadMesh> read() {
    if (Status head = readHeader(); !head) return head.error();
    PlyValues values(std::string_view(file_.bytes).substr(bodyAt_), format_ == "ascii",
                     format_ == "binary_big_endian");
    for (const PlyElement& element : elements_) {
      if (element.properties.empty()) continue;
      if (element.count > values.bytesLeft() / element.leastBytes(format_ == "ascii") + 1)
        return cutOff(element);
      Status done = element.name == "vertex" ? readVertices(element, values) : readFaces(element, values);
      if (!done) return done.error();
      if (element.name == "face") break;
    }
    return std::move(read_);
  }

 private:
  Error cutOff(const PlyElement& element) const {
    return unreadable(file_.path, "it is cut off: " + std::to_string(element.count) + " elements " +
                                      inQuotes(element.name) + " are promised, and fewer are there");
  }
  Error noVertex(double index) const {
    std::ostringstream message;
    message << std::setprecision(10) << "a face names vertex " << index << ", and there are "
            << read_.mesh.positions.size() << ", numbered from 0";
    return unreadable(file_.path, message.str());
  }

  Status readHeader() {
    TextScan text(file_.bytes);
    if (text.restOfLine() != "ply")
      return unreadable(file_.path, "it is no PLY: it does not begin with 'ply'");
    while (!text.atEnd()) {
      const std::size_t line = text.line();
      const std::string_view keyword = text.word();
      bool known = keyword == "comment" || keyword == "obj_info" || keyword.empty();
      if (keyword == "format") {
        format_ = text.word();
        known = format_ == "ascii" || format_ == "binary_little_endian" || format_ == "binary_big_endian";
      } else if (keyword == "element") {
        const std::string_view name = text.word();
        const std::optional<std::size_t> count = wholeOf<std::size_t>(text.word());
        elements_.push_back({std::string(name), count.value_or(0), {}});
        known = count.has_value();
      } else if (keyword == "property") {
        known = readProperty(text);
      } else if (keyword == "end_header") {
        text.nextLine();
        bodyAt_ = text.position();
        if (format_.empty()) return unreadable(file_.path, "its header names no format");
        return okStatus();
      }
      if (!known) {
        return unreadable(file_.path, "line " + std::to_string(line) + ": " + inQuotes(keyword) +
                                          " is not as in a PLY's header");
      }
      text.nextLine();
    }
    return unreadable(file_.path, "it is cut off: its header does not end");
  }

  bool readProperty(TextScan& text) {
    if (elements_.empty()) return false;
    PlyProperty property;
    std::string_view type = text.word();
    if (type == "list") {
      property.length = typeOf(text.word());
      if (property.length == PlyType::None) return false;
      type = text.word();
    }
    property.type = typeOf(type);
    property.name = text.word();
    elements_.back().properties.push_back(property);
    return property.type != PlyType::None;
  }

  /// The length of a list that the file can hold; none where it cannot.
  std::optional<std::size_t> length(const PlyProperty& list, PlyValues& values) const {
    const double count = values.next(list.length);
    if (!(count >= 0.0) || count > static_cast<double>(values.bytesLeft())) return std::nullopt;
    return static_cast<std::size_t>(count);
  }

  Error broken(const PlyElement& element, std::size_t at, const PlyValues& values) const {
    if (values.wrongWord().empty()) return cutOff(element);
    return unreadable(file_.path, inQuotes(values.wrongWord()) + " is no number, in " +
                                      inQuotes(element.name) + " " + std::to_string(at));
  }

  Status readVertices(const PlyElement& element, PlyValues& values) {
    std::array<int, kRoles.size()> propertyOf;
    std::ranges::fill(propertyOf, -1);
    std::vector<int> roles;
    for (const PlyProperty& p : element.properties) {
      const auto found = std::ranges::find(kRoles, p.name);
      const bool isRole = found != kRoles.end() && p.length == PlyType::None;
      roles.push_back(isRole ? static_cast<int>(found - kRoles.begin()) : -1);
      if (isRole) propertyOf[roles.back()] = static_cast<int>(roles.size()) - 1;
    }
    const auto has = [&](std::size_t role) {
      return std::all_of(&propertyOf[role], &propertyOf[role] + 3, [](int p) { return p >= 0; });
    };
    if (!has(0)) return unreadable(file_.path, "its vertices have no x, y and z");
    if (element.count > std::numeric_limits<std::uint32_t>::max()) return tooManyTriangles(file_.path);
    TriangleMesh& mesh = read_.mesh;
    mesh.positions.reserve(element.count);
    if (has(kColorColumn)) mesh.materials[0].color = glm::vec3(1.0f);
    for (std::size_t v = 0; v < element.count; ++v) {
      std::array<float, kRoles.size()> of{};
      for (std::size_t i = 0; i < roles.size(); ++i) {
        const PlyProperty& p = element.properties[i];
        if (p.length != PlyType::None) {
          if (!skipList(p, values)) return cutOff(element);
          continue;
        }
        const double value = values.next(p.type);
        if (roles[i] >= 0) of[roles[i]] = static_cast<float>(value);
      }
      if (!values.ok()) return broken(element, v, values);
      mesh.positions.emplace_back(of[0], of[1], of[2]);
      if (has(kNormalColumn)) mesh.normals.emplace_back(of[3], of[4], of[5]);
      if (has(kColorColumn)) {
        glm::vec3 color;
        for (int k = 0; k < 3; ++k)
          color[k] =
              linearOf(of[kColorColumn + k] / white(element.properties[propertyOf[kColorColumn + k]].type));
        mesh.colors.push_back(color);
      }
    }
    return okStatus();
  }

  static float white(PlyType type) {
    const bool whole = type != PlyType::Float && type != PlyType::Double;
    return whole ? (sizeOf(type) == 1 ? 255.0f : 65535.0f) : 1.0f;
  }

  bool skipList(const PlyProperty& list, PlyValues& values) const {
    const std::optional<std::size_t> count = length(list, values);
    for (std::size_t i = 0; count && i < *count && values.ok(); ++i) values.next(list.type);
    return count && values.ok();
  }

  /// Faces, or any other elements, of which nothing is kept.
  Status readFaces(const PlyElement& element, PlyValues& values) {
    std::vector<std::uint32_t> corners;
    const auto vertices = static_cast<double>(read_.mesh.positions.size());
    for (std::size_t f = 0; f < element.count; ++f) {
      for (const PlyProperty& p : element.properties) {
        const bool isFace =
            element.name == "face" && (p.name == "vertex_indices" || p.name == "vertex_index");
        if (p.length == PlyType::None) {
          values.next(p.type);
        } else if (!isFace) {
          if (!skipList(p, values)) return broken(element, f, values);
        } else {
          const std::optional<std::size_t> count = length(p, values);
          if (!count) return broken(element, f, values);
          corners.clear();
          for (std::size_t i = 0; i < *count && values.ok(); ++i) {
            const double index = values.next(p.type);
            if (!(index >= 0.0 && index < vertices) || index != std::floor(index)) return noVertex(index);
            corners.push_back(static_cast<std::uint32_t>(index));
          }
          if (!addPolygon(corners, 0, {"face", f}, read_)) return tooManyTriangles(file_.path);
        }
        if (!values.ok()) return broken(element, f, values);
      }
    }
    return okStatus();
  }

  const MeshFile& file_;
  std::string_view format_;
  std::vector<PlyElement> elements_;
  std::size_t bodyAt_ = 0;
  ReadMesh read_;
};

}  // namespace

Result<ReadMesh> readPly(const MeshFile& file) { return PlyReader(file).read(); }

}  // namespace sdf
