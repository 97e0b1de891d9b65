// STL (3D Systems, StereoLithography Interface Specification, 1989), binary and text.
#include <algorithm>
#include <bit>
#include <cstring>

#include "sdf/meshfile/read_formats.h"
#include "sdf/meshfile/text_scan.h"
#include "sdf/meshfile/triple_map.h"

namespace sdf {
namespace {

constexpr std::size_t kHeader = 84, kTriangle = 50, kNormalBytes = 12;

bool isWord(std::string_view word, std::string_view lower) {
  return std::ranges::equal(word, lower,
                            [](char c, char l) { return (c >= 'A' && c <= 'Z' ? c + 32 : c) == l; });
}

class StlReader {
 public:
  explicit StlReader(const MeshFile& file) : file_(file) {}

  Result<ReadMesh> read() {
    Status done = isBinary() ? readBinary() : readText();
    if (!done) return done.error();
    read_.mesh.materialOf.assign(read_.mesh.triangles.size(), 0);
    return std::move(read_);
  }

 private:
  std::size_t promised() const {
    std::uint32_t count = 0;
    std::memcpy(&count, file_.bytes.data() + kHeader - sizeof count, sizeof count);
    return count;
  }

  // Headers of binary files may begin with "solid", too.
  bool isBinary() const {
    const std::string_view bytes = file_.bytes;
    if (bytes.size() >= kHeader && bytes.size() == kHeader + promised() * kTriangle) return true;
    TextScan text(bytes);
    if (!isWord(text.wordAnywhere(), "solid")) return true;
    text.nextLine();
    const std::string_view next = text.wordAnywhere();
    return !isWord(next, "facet") && !isWord(next, "endsolid");
  }

  Status readBinary() {
    if (file_.bytes.size() < kHeader)
      return unreadable(file_.path, "it is no STL: neither text nor as long as a binary one's header");
    const std::size_t held = (file_.bytes.size() - kHeader) / kTriangle;
    if (promised() > held) {
      return unreadable(file_.path, "it is cut off, or no STL: " + std::to_string(promised()) +
                                        " triangles are promised, and " + std::to_string(held) +
                                        " are there");
    }
    if (promised() > kMostReadTriangles) return tooManyTriangles(file_.path);
    read_.mesh.triangles.reserve(promised());
    for (std::size_t i = 0; i < promised(); ++i) {
      glm::vec3 corners[3];
      std::memcpy(corners, file_.bytes.data() + kHeader + i * kTriangle + kNormalBytes, sizeof corners);
      read_.mesh.triangles.push_back({vertex(corners[0]), vertex(corners[1]), vertex(corners[2])});
    }
    return okStatus();
  }

  Status readText() {
    TextScan text(file_.bytes);
    bool inSolid = false, inFacet = false;
    std::vector<std::uint32_t> corners;
    const auto wrong = [&](const std::string& what) {
      return unreadable(file_.path, "line " + std::to_string(text.line()) + ": " + what);
    };
    for (std::string_view word = text.wordAnywhere(); !word.empty(); word = text.wordAnywhere()) {
      if (isWord(word, "solid") || isWord(word, "endsolid")) {
        inSolid = isWord(word, "solid");
        text.nextLine();  // names are any words
      } else if (isWord(word, "facet")) {
        inFacet = true;
        text.nextLine();  // its normal follows from the corners
      } else if (isWord(word, "outer")) {
        text.word();
        corners.clear();
      } else if (isWord(word, "vertex")) {
        glm::vec3 p;
        for (int k = 0; k < 3; ++k) {
          const std::string_view number = text.word();
          const std::optional<float> value = numberOf<float>(number);
          if (!value) return wrong(inQuotes(number) + " is no coordinate");
          p[k] = *value;
        }
        corners.push_back(vertex(p));
      } else if (isWord(word, "endloop")) {
        if (corners.size() != 3) return wrong("a facet of " + std::to_string(corners.size()) + " corners");
        if (!addPolygon(corners, 0, {"line", text.line()}, read_)) return tooManyTriangles(file_.path);
      } else if (isWord(word, "endfacet")) {
        inFacet = false;
      } else {
        return wrong(inQuotes(word) + " is no word of an STL");
      }
    }
    if (inFacet) return unreadable(file_.path, "it is cut off within a facet");
    if (inSolid) warn(read_.warnings, "its solid does not end, so it may be cut off");
    return okStatus();
  }

  std::uint32_t vertex(glm::vec3 p) {
    p += 0.0f;  // -0 and 0 are one place
    const auto bits = [](float v) { return std::bit_cast<std::uint32_t>(v); };
    const std::uint32_t place = vertices_.insert(bits(p.x), bits(p.y), bits(p.z));
    if (place == read_.mesh.positions.size()) read_.mesh.positions.push_back(p);
    return place;
  }

  const MeshFile& file_;
  ReadMesh read_;
  TripleMap vertices_;
};

}  // namespace

Result<ReadMesh> readStl(const MeshFile& file) { return StlReader(file).read(); }

}  // namespace sdf
