// OBJ and MTL (Wavefront, Advanced Visualizer Manual, 1991, appendices B1 and B2).
#include <algorithm>
#include <map>
#include <set>

#include "sdf/base/srgb.h"
#include "sdf/meshfile/picture.h"
#include "sdf/meshfile/read_formats.h"
#include "sdf/meshfile/text_scan.h"
#include "sdf/meshfile/triple_map.h"

namespace sdf {
namespace {

constexpr std::uint32_t kNone = ~0u;

class ObjReader {
 public:
  explicit ObjReader(const MeshFile& file) : file_(file) {}

  Result<ReadMesh> read() {
    joinLines();
    if (Status done = readPoints(); !done) return done.error();
    if (hasColors_) read_.mesh.materials[0].color = glm::vec3(1.0f);
    if (Status done = readFaces(); !done) return done.error();
    return std::move(read_);
  }

 private:
  Error wrong(std::size_t line, const std::string& what) const {
    return unreadable(file_.path, "line " + std::to_string(line) + ": " + what);
  }

  /// A line that ends in a backslash goes on in the next.
  void joinLines() {
    text_ = file_.bytes;
    if (file_.bytes.find("\\\n") == std::string::npos && file_.bytes.find("\\\r\n") == std::string::npos)
      return;
    joined_ = file_.bytes;
    for (const std::string_view end : {"\\\n", "\\\r\n"})
      for (std::size_t at = joined_.find(end); at != joined_.npos; at = joined_.find(end, at))
        joined_.replace(at, end.size(), end.size(), ' ');
    text_ = joined_;
  }

  /// Up to `most` numbers up to the end of the line; fewer are an error if they are below `least`.
  Result<std::size_t> numbers(TextScan& text, std::size_t least, std::size_t most, float* out) const {
    std::size_t count = 0;
    for (std::string_view word = text.word(); !word.empty() && count < most; word = text.word()) {
      const std::optional<float> value = numberOf<float>(word);
      if (!value) return wrong(text.line(), inQuotes(word) + " is no number");
      out[count++] = *value;
    }
    if (count < least) {
      return wrong(text.line(),
                   std::to_string(count) + " numbers where there should be " + std::to_string(least));
    }
    return count;
  }

  Status readPoints() {
    for (TextScan text(text_); !text.atEnd(); text.nextLine()) {
      const std::string_view keyword = text.word();
      float n[6];
      if (keyword == "v") {
        const Result<std::size_t> count = numbers(text, 3, 6, n);
        if (!count) return count.error();
        points_.emplace_back(n[0], n[1], n[2]);
        hasColors_ = hasColors_ || *count == 6;
        if (hasColors_) {
          colors_.resize(points_.size() - 1, glm::vec3(1.0f));
          colors_.push_back(*count == 6 ? glm::vec3(linearOf(n[3]), linearOf(n[4]), linearOf(n[5]))
                                        : glm::vec3(1.0f));
        }
      } else if (keyword == "vt") {
        n[1] = 0.0f;
        if (auto count = numbers(text, 1, 3, n); !count) return count.error();
        textureAt_.emplace_back(n[0], 1.0f - n[1]);  // theirs is from the lower left corner
      } else if (keyword == "vn") {
        if (auto count = numbers(text, 3, 3, n); !count) return count.error();
        normals_.emplace_back(n[0], n[1], n[2]);
      }
      if (std::max({points_.size(), textureAt_.size(), normals_.size()}) >= kNone)
        return tooManyTriangles(file_.path);
    }
    return okStatus();
  }

  Status readFaces() {
    std::size_t points = 0, coordinates = 0, normals = 0;  // so far: what indices below 0 count back from
    std::vector<std::uint32_t> corners;
    for (TextScan text(text_); !text.atEnd(); text.nextLine()) {
      const std::string_view keyword = text.word();
      points += keyword == "v";
      coordinates += keyword == "vt";
      normals += keyword == "vn";
      if (keyword == "mtllib" || keyword == "usemtl") {
        TextScan line(text);  // so that text stays on this line
        const std::string_view name = line.restOfLine();
        if (keyword == "mtllib") readLibrary(std::string(name));
        if (keyword == "usemtl") material_ = materialCalled(std::string(name));
      }
      if (keyword != "f") continue;
      corners.clear();
      for (std::string_view word = text.word(); !word.empty(); word = text.word()) {
        std::uint32_t of[3] = {kNone, kNone, kNone};
        const std::size_t soFar[] = {points, coordinates, normals};
        if (Status known = corner(word, text.line(), soFar, of); !known) return known;
        corners.push_back(vertex(of));
      }
      if (corners.size() < 3) return wrong(text.line(), "a face of fewer than 3 corners");
      if (!addPolygon(corners, material_, {"line", text.line()}, read_)) return tooManyTriangles(file_.path);
    }
    return okStatus();
  }

  /// "vertex", "vertex/texture", "vertex//normal" or "vertex/texture/normal", counted from 1, or from -1
  /// back.
  Status corner(std::string_view word, std::size_t line, const std::size_t (&soFar)[3],
                std::uint32_t (&of)[3]) const {
    const std::size_t sizes[] = {points_.size(), textureAt_.size(), normals_.size()};
    static constexpr const char* kWhat[] = {"vertex", "texture coordinate", "normal"};
    std::string_view rest = word;
    for (int k = 0; k < 3; ++k) {
      const std::size_t end = std::min(rest.find('/'), rest.size());
      const std::string_view digits = rest.substr(0, end);
      if (!digits.empty() || k == 0) {
        const std::optional<std::int64_t> index = wholeOf<std::int64_t>(digits);
        if (!index) return wrong(line, inQuotes(word) + " is no corner of a face");
        const std::int64_t place = *index < 0 ? *index + static_cast<std::int64_t>(soFar[k]) : *index - 1;
        if (place < 0 || place >= static_cast<std::int64_t>(sizes[k])) {
          return wrong(line, "the corner " + inQuotes(word) + " names " + kWhat[k] + " " +
                                 std::to_string(*index) + ", and there are " + std::to_string(sizes[k]));
        }
        of[k] = static_cast<std::uint32_t>(place);
      }
      if (end == rest.size()) return okStatus();
      rest.remove_prefix(end + 1);
    }
    return wrong(line, inQuotes(word) + " is no corner of a face");
  }

  std::uint32_t vertex(const std::uint32_t (&of)[3]) {
    TriangleMesh& mesh = read_.mesh;
    const std::uint32_t place = vertices_.insert(of[0], of[1], of[2]);
    if (place < mesh.positions.size()) return place;
    mesh.positions.push_back(points_[of[0]]);
    if (hasColors_) mesh.colors.push_back(of[0] < colors_.size() ? colors_[of[0]] : glm::vec3(1.0f));
    if (!textureAt_.empty()) mesh.textureAt.push_back(of[1] == kNone ? glm::vec2(0.0f) : textureAt_[of[1]]);
    if (!normals_.empty()) mesh.normals.push_back(of[2] == kNone ? glm::vec3(0.0f) : normals_[of[2]]);
    return place;
  }

  // --- materials ---

  std::uint32_t materialCalled(const std::string& name) {
    const auto found = materials_.find(name);
    if (found != materials_.end()) return found->second;
    if (!name.empty()) warn(read_.warnings, "the material " + inQuotes(name) + " is nowhere described");
    return 0;
  }

  void readLibrary(const std::string& name) {
    constexpr std::size_t kMostLibraries = 64;
    if (!libraries_.insert(name).second || libraries_.size() > kMostLibraries) return;
    const Result<MeshFile> library = readBeside(file_.path, name);
    if (!library) return warn(read_.warnings, "materials left out: " + library.error().message);
    TriangleMaterial* material = nullptr;
    for (TextScan text(library->bytes); !text.atEnd();) {
      const std::string_view keyword = text.word();
      const std::string_view rest = text.restOfLine();
      if (keyword == "newmtl") {
        const auto place = static_cast<std::uint32_t>(read_.mesh.materials.size());
        if (!materials_.emplace(rest, place).second) {
          material = nullptr;
          continue;
        }
        material = &read_.mesh.materials.emplace_back();
        material->name = rest;
      } else if (material) {
        describe(*material, keyword, rest);
      }
    }
  }

  void describe(TriangleMaterial& material, std::string_view keyword, std::string_view rest) {
    TextScan words(rest);
    const auto color = [&](glm::vec3& out) {
      glm::vec3 shown;
      for (int k = 0; k < 3; ++k) {
        const std::optional<float> value = numberOf<float>(words.word());
        if (!value) return;
        shown[k] = *value;
      }
      out = {linearOf(shown.x), linearOf(shown.y), linearOf(shown.z)};
    };
    if (keyword == "Kd") color(material.color);
    if (keyword == "Ke") color(material.emission);
    if (keyword == "Pm") material.metallic = numberOf<float>(rest).value_or(material.metallic);
    if (keyword == "Pr") material.roughness = numberOf<float>(rest).value_or(material.roughness);
    if (keyword == "map_Kd") material.colorTexture = picture(rest);
  }

  /// Options stand before the name, each after a dash.
  int picture(std::string_view rest) {
    std::string name(rest.starts_with('-') ? rest.substr(rest.find_last_of(" \t") + 1) : rest);
    std::ranges::replace(name, '\\', '/');
    const auto [found, isNew] = pictures_.emplace(name, -1);
    if (!isNew) return found->second;
    const auto leftOut = [&](const std::string& why) {
      warn(read_.warnings, "the picture " + inQuotes(name) + " is left out: " + why);
      return -1;
    };
    const Result<MeshFile> file = readBeside(file_.path, name);
    if (!file) return leftOut(file.error().message);
    Result<TextureImage> image = pictureReader_.read(file->bytes);
    if (!image) return leftOut(image.error().message);
    read_.mesh.images.push_back(std::move(*image));
    return found->second = static_cast<int>(read_.mesh.images.size()) - 1;
  }

  const MeshFile& file_;
  std::string joined_;
  std::string_view text_;
  std::vector<glm::vec3> points_, colors_, normals_;
  std::vector<glm::vec2> textureAt_;
  bool hasColors_ = false;
  TripleMap vertices_;
  std::uint32_t material_ = 0;
  std::map<std::string, std::uint32_t, std::less<>> materials_;
  std::map<std::string, int> pictures_;
  std::set<std::string> libraries_;
  PictureReader pictureReader_;
  ReadMesh read_;
};

}  // namespace

Result<ReadMesh> readObj(const MeshFile& file) { return ObjReader(file).read(); }

}  // namespace sdf
