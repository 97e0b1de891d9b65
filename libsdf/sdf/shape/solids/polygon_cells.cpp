#include "sdf/shape/solids/polygon_cells.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <numeric>
#include <utility>
#include <vector>

#include "sdf/base/parallel.h"

namespace sdf {
namespace {

// Chosen by measuring frames: longer lists cost more than a step down.
constexpr std::size_t kLongList = 8;    // sides, where a cell is to be divided
constexpr std::size_t kManySides = 64;  // before they are looked at closely: the list will be long
constexpr double kCellsAlong = 64.0;    // the longest side of all
constexpr double kAround = 0.5;         // of the polygon's longest side, around it
constexpr int kParts = 4;               // of a cell, along each axis
constexpr int kMostLevels = 6;
constexpr std::size_t kMostCells = 200'000;
constexpr int kRow = 256;  // texels along the texture's first two axes

using Texel = std::array<float, 4>;

Texel texelOf(double x, double y, double z, double w) {
  return {static_cast<float>(x), static_cast<float>(y), static_cast<float>(z), static_cast<float>(w)};
}

/// A square.
struct Cell {
  glm::dvec2 lo;
  double side;

  glm::dvec2 at(double x, double y) const { return lo + side * glm::dvec2(x, y); }
  Rectangle box() const { return {lo, at(1.0, 1.0)}; }
  Cell part(int x, int y) const {
    const double s = side / kParts;
    return {lo + s * glm::dvec2(x, y), s};
  }
};

/// What a cell holds.
struct Content {
  std::vector<std::uint32_t> sides{};
  bool isFar = false;  // no side is nearer than the cell's own side
  bool isPatch = false;
  double error = 0.0;  // of the patch
  std::array<Texel, 3> patch{};

  bool isGood(double patchError) const { return isPatch ? error <= patchError : sides.size() <= kLongList; }
};

// Does a segment pass through a box? By where it lies along the axes, and then across itself.
bool passes(const Arc& s, const Rectangle& box) {
  if (!s.box().meets(box)) return false;
  const glm::dvec2 middle = 0.5 * (box.lo + box.hi), half = 0.5 * (box.hi - box.lo);
  const double reach = std::abs(s.along.y) * half.x + std::abs(s.along.x) * half.y;
  return std::abs(s.placeOf(middle).out) <= reach;
}

std::array<glm::dvec2, 4> cornersOf(const Rectangle& box) {
  return {box.lo, {box.hi.x, box.lo.y}, {box.lo.x, box.hi.y}, box.hi};
}

/// What all distances between a side and the points of a box are at least, and at most, squared.
struct Bounds {
  double least, most;
};

// The least is at a corner of the box or an end of the segment, unless they meet. The greatest is at a
// corner, for the distance to a segment is convex.
Bounds segmentBounds(const Arc& s, const Rectangle& box) {
  double most = 0.0, least = std::min(box.squaredTo({s.from, s.from}), box.squaredTo({s.to, s.to}));
  for (const glm::dvec2& corner : cornersOf(box)) {
    const double squared = s.placeOf(corner).squared();
    least = std::min(least, squared), most = std::max(most, squared);
  }
  return {passes(s, box) ? 0.0 : least, most};
}

// An arc is no farther from its chord than its sagitta; and nowhere in the box is it nearer or farther than
// from its middle by more than half the diagonal.
Bounds boundsOf(const PolygonSide& s, const Rectangle& box) {
  if (s.curvature == 0.0) return segmentBounds(s, box);
  const Bounds chord = segmentBounds(Arc::through({s.from, 0.0}, s.to), box);
  const glm::dvec2 middle = 0.5 * (box.lo + box.hi), half = 0.5 * (box.hi - box.lo);
  const double far = std::sqrt(s.placeOf(middle).squared()), reach = std::hypot(half.x, half.y);
  const double least = std::max({0.0, far - reach, std::sqrt(chord.least) - s.sagitta()});
  const double most = std::min(far + reach, std::sqrt(chord.most) + s.sagitta());
  return {least * least, most * most};
}

// The sides that may be nearest to a point of the box, one of which is `near`; more than `limit` may be any.
std::vector<std::uint32_t> sidesFor(const PolygonDistance& distance, const Rectangle& box, std::uint32_t near,
                                    std::size_t limit) {
  constexpr double kSlack = 1.0 + 1e-6;  // of floats that come to lie beside the box
  const std::vector<PolygonSide>& sides = distance.sides();
  double most = boundsOf(sides[near], box).most;
  const auto mayBeNearest = [&](const Rectangle& other) { return box.squaredTo(other) <= kSlack * most; };
  std::vector<std::uint32_t> found;
  std::vector<double> least;
  distance.tree().any(mayBeNearest, [&](std::size_t i) {
    const Bounds bounds = boundsOf(sides[i], box);
    if (bounds.least > kSlack * most) return false;
    found.push_back(static_cast<std::uint32_t>(i));
    least.push_back(bounds.least);
    most = std::min(most, bounds.most);
    return found.size() > limit;
  });
  std::vector<std::uint32_t> nearest;
  for (std::size_t i = 0; i < found.size(); ++i)
    if (least[i] <= kSlack * most) nearest.push_back(found[i]);
  return nearest;
}

// Hermite's polynomials over [0, 1] of the values and of the slopes at both ends.
struct Hermite {
  explicit Hermite(double t)
      : value{1.0 - t * t * (3.0 - 2.0 * t), t * t * (3.0 - 2.0 * t)},
        slope{t * (1.0 - t) * (1.0 - t), t * t * (t - 1.0)} {}
  double value[2], slope[2];
};

double patchAt(const std::array<Texel, 3>& patch, const glm::dvec2& at) {
  const Hermite x(at.x), y(at.y);
  double sum = 0.0;
  for (int i = 0; i < 4; ++i) {
    const int u = i & 1, v = i >> 1;
    sum += patch[0][i] * x.value[u] * y.value[v] + patch[1][i] * x.slope[u] * y.value[v] +
           patch[2][i] * x.value[u] * y.slope[v];
  }
  return sum;
}

void setPatch(const PolygonDistance& distance, const Cell& cell, std::uint32_t near, Content& out) {
  out.isPatch = true;
  for (int i = 0; i < 4; ++i) {
    const PolygonDistance::Read read = distance.read(cell.at(i & 1, i >> 1), near);
    out.patch[0][i] = static_cast<float>(read.distance);
    out.patch[1][i] = static_cast<float>(cell.side * read.gradient.x);
    out.patch[2][i] = static_cast<float>(cell.side * read.gradient.y);
  }
  constexpr int kProbes = 4;  // along each axis
  for (int i = 0; i < kProbes * kProbes; ++i) {
    const glm::dvec2 at((i % kProbes + 0.5) / kProbes, (i / kProbes + 0.5) / kProbes);
    const double exact = distance.read(cell.at(at.x, at.y), near).distance;
    out.error = std::max(out.error, std::abs(patchAt(out.patch, at) - exact));
  }
}

Content contentOf(const PolygonDistance& distance, const Cell& cell) {
  const PolygonDistance::Read middle = distance.read(cell.at(0.5, 0.5));
  Content out;
  out.isFar = std::abs(middle.distance) > 2.0 * cell.side;
  out.sides = sidesFor(distance, cell.box(), middle.side, kManySides);
  if (out.isFar && out.sides.size() > kLongList) setPatch(distance, cell, middle.side, out);
  return out;
}

/// Divides cells level by level and writes down what they hold.
class CellWriter {
 public:
  CellWriter(const PolygonDistance& distance, PolygonCells& out) : distance_(distance), out_(out) {}

  void run() {
    const Rectangle& box = distance_.bounds();
    const glm::dvec2 size = box.hi - box.lo;
    const double longest = std::max(size.x, size.y), margin = kAround * longest;
    const double side = (longest + 2.0 * margin) / kCellsAlong;
    patchError_ = PolygonCells::kPatchError * longest;
    const auto countOf = [&](double along) {
      return static_cast<int>(std::ceil((along + 2.0 * margin) / side));
    };
    const int columns = countOf(size.x), rows = countOf(size.y);
    // As floats say where the cells begin.
    const Texel head = texelOf(box.lo.x - margin, box.lo.y - margin, 1.0 / side, side);
    texels_ = {head, texelOf(columns, rows, 0.0, 0.0)};
    const double cellSide = 1.0 / head[2];
    std::vector<Wanted> wanted;
    for (int i = 0; i < columns * rows; ++i)
      wanted.push_back(
          {{glm::dvec2(head[0], head[1]) + cellSide * glm::dvec2(i % columns, i / columns), cellSide},
           texels_.size() + static_cast<std::size_t>(i)});
    texels_.resize(texels_.size() + wanted.size());
    for (int level = 1; !wanted.empty(); ++level) wanted = fill(wanted, level);
    finish();
  }

 private:
  /// A cell, and the texel that is to say what it holds.
  struct Wanted {
    Cell cell;
    std::size_t texel;
  };

  // Returns the parts of those cells that are to be divided.
  std::vector<Wanted> fill(const std::vector<Wanted>& cells, int level) {
    std::vector<Content> contents(cells.size());
    inParallel(cells.size(), [&](std::size_t i) { contents[i] = contentOf(distance_, cells[i].cell); });
    count_ += cells.size();
    std::vector<Wanted> parts;
    for (const std::size_t i : byNeed(contents)) {
      const bool hasRoom = count_ + parts.size() + kParts * kParts <= kMostCells && level < kMostLevels;
      if (!contents[i].isGood(patchError_) && hasRoom)
        divide(cells[i], parts);
      else
        write(cells[i], contents[i]);
    }
    return parts;
  }

  // If there may not be room for the parts of all, those near the polygon first, and of them long lists.
  std::vector<std::size_t> byNeed(const std::vector<Content>& contents) const {
    std::vector<std::size_t> order(contents.size());
    std::iota(order.begin(), order.end(), std::size_t{0});
    if (count_ + contents.size() * kParts * kParts > kMostCells)
      std::stable_sort(order.begin(), order.end(), [&](std::size_t a, std::size_t b) {
        const Content &x = contents[a], &y = contents[b];
        return x.isFar != y.isFar ? y.isFar : x.sides.size() > y.sides.size();
      });
    return order;
  }

  void divide(const Wanted& whole, std::vector<Wanted>& parts) {
    const std::size_t first = texels_.size();
    texels_[whole.texel] = texelOf(static_cast<double>(first), 0.0, 0.0, 0.0);
    texels_.resize(first + kParts * kParts);
    for (int i = 0; i < kParts * kParts; ++i)
      parts.push_back({whole.cell.part(i % kParts, i / kParts), first + static_cast<std::size_t>(i)});
  }

  void write(const Wanted& wanted, const Content& content) {
    const auto first = static_cast<double>(texels_.size());
    if (content.isPatch) {
      ++out_.patches;
      texels_[wanted.texel] = texelOf(first, -1.0, 0.0, 0.0);
      texels_.insert(texels_.end(), content.patch.begin(), content.patch.end());
      return;
    }
    std::vector<std::uint32_t> sides = content.sides;
    if (sides.size() > kLongList)  // it may not be all of them
      sides = sidesFor(distance_, wanted.cell.box(), sides[0], distance_.sides().size());
    ++out_.lists;
    out_.longest = std::max(out_.longest, static_cast<int>(sides.size()));
    texels_[wanted.texel] = texelOf(first, static_cast<double>(sides.size()), 0.0, 0.0);
    for (const std::uint32_t i : sides) {
      const PolygonSide& s = distance_.sides()[i];
      texels_.push_back(texelOf(s.from.x, s.from.y, s.along.x, s.along.y));
      if (distance_.hasArcs()) {
        texels_.push_back(texelOf(s.to.x, s.to.y, s.alongTo.x, s.alongTo.y));
        texels_.push_back(texelOf(-s.atFrom, s.atTo, s.curvature, 0.0));
      } else {
        texels_.push_back(texelOf(s.size, -s.atFrom, s.atTo, 0.0));
      }
    }
  }

  void finish() {
    const auto count = static_cast<int>(texels_.size());
    const int rows = (count + kRow - 1) / kRow;
    PayloadVolume& volume = out_.volume;
    volume.size = {kRow, std::min(rows, kRow), (rows + kRow - 1) / kRow};
    volume.values.assign(4 * static_cast<std::size_t>(kRow) * volume.size.y * volume.size.z, 0.0f);
    for (std::size_t i = 0; i < texels_.size(); ++i)
      std::copy(texels_[i].begin(), texels_[i].end(), &volume.values[4 * i]);
  }

  const PolygonDistance& distance_;
  PolygonCells& out_;
  double patchError_ = 0.0;
  std::size_t count_ = 0;  // cells
  std::vector<Texel> texels_;
};

}  // namespace

PolygonCells::PolygonCells(const PolygonDistance& distance) { CellWriter(distance, *this).run(); }

namespace {

// Of the sides in a list, which are segments: each has two texels.
constexpr const char* kNearestSegment = R"(vec3 NAMENearest(vec2 p, int first, int count) {
  float least = 3e38, turn = 0.0;
  vec2 along = vec2(1.0, 0.0), place = vec2(0.0);
  for (int i = 0; i < count; ++i) {
    vec4 line = NAMETexel(first + 2 * i), ends = NAMETexel(first + 2 * i + 1);
    vec2 r = p - line.xy;
    float t = dot(r, line.zw);
    vec2 at = vec2(r.x * line.w - r.y * line.z, t - clamp(t, 0.0, ends.x));
    float squared = dot(at, at);
    if (squared < least) {
      least = squared;
      place = at;
      along = line.zw;
      turn = at.y < 0.0 ? ends.y : ends.z;
    }
  }
  vec2 normal = vec2(along.y, -along.x);
  if (place.y == 0.0) return vec3(place.x, normal);
  float far = (place.x + turn * place.y > 0.0 ? 1.0 : -1.0) * sqrt(least);
  return vec3(far, (place.x * normal + place.y * along) / far);
}
)";

// Of arcs, which have three; of a segment the circle's equation leaves the distance to its line.
constexpr const char* kNearestArc = R"(vec3 NAMENearest(vec2 p, int first, int count) {
  float least = 3e38, turn = 0.0;
  vec2 along = vec2(1.0, 0.0), place = vec2(0.0), radius = vec2(1.0, 0.0);
  for (int i = 0; i < count; ++i) {
    vec4 start = NAMETexel(first + 3 * i), end = NAMETexel(first + 3 * i + 1);
    vec3 more = NAMETexel(first + 3 * i + 2).xyz;
    vec2 r = p - start.xy, q = p - end.xy, towards = vec2(1.0, 0.0);
    vec2 at = vec2(r.x * start.w - r.y * start.z, dot(r, start.zw));
    float past = dot(q, end.zw);
    bool isAtEnd = past > 0.0 && (at.y >= 0.0 || dot(q, q) < dot(r, r));
    if (isAtEnd) {
      at = vec2(q.x * end.w - q.y * end.z, past);
    } else if (at.y >= 0.0) {
      towards = vec2(1.0 + more.z * at.x, more.z * at.y);
      at = vec2((more.z * dot(r, r) + 2.0 * at.x) / (1.0 + length(towards)), 0.0);
    }
    float squared = dot(at, at);
    if (squared < least) {
      least = squared;
      place = at;
      along = isAtEnd ? end.zw : start.zw;
      radius = towards;
      turn = at.y < 0.0 ? more.x : more.y;
    }
  }
  vec2 normal = vec2(along.y, -along.x);
  if (place.y == 0.0) return vec3(place.x, (radius.x * normal + radius.y * along) / max(length(radius), 1e-30));
  float far = (place.x + turn * place.y > 0.0 ? 1.0 : -1.0) * sqrt(least);
  return vec3(far, (place.x * normal + place.y * along) / far);
}
)";

}  // namespace

// A cell's texel names the first texel of what it holds, and then how many sides: 0 where it is divided, -1
// where it has a patch.
std::string PolygonCells::glsl(const std::string& name, bool hasArcs) {
  std::string text = R"(
uniform sampler3D NAMECells;
vec4 NAMETexel(int i) { return texelFetch(NAMECells, ivec3(i & 255, (i >> 8) & 255, i >> 16), 0); }

NEAREST
vec3 NAMEPatch(vec2 t, int first, float side) {
  vec4 f = NAMETexel(first), fx = NAMETexel(first + 1), fy = NAMETexel(first + 2);
  vec2 s = 1.0 - t, v = t * t * (3.0 - 2.0 * t), u = 1.0 - v, a = t * s * s, b = -t * t * s;
  vec2 dv = 6.0 * t * s, da = s * (1.0 - 3.0 * t), db = t * (3.0 * t - 2.0);
  vec4 x = vec4(u.x, v.x, u.x, v.x), y = vec4(u.y, u.y, v.y, v.y);
  vec4 mx = vec4(a.x, b.x, a.x, b.x), my = vec4(a.y, a.y, b.y, b.y);
  vec4 dx = dv.x * vec4(-1.0, 1.0, -1.0, 1.0), dy = dv.y * vec4(-1.0, -1.0, 1.0, 1.0);
  vec4 dmx = vec4(da.x, db.x, da.x, db.x), dmy = vec4(da.y, da.y, db.y, db.y);
  return vec3(dot(f, x * y) + dot(fx, mx * y) + dot(fy, x * my),
              (dot(f, dx * y) + dot(fx, dmx * y) + dot(fy, dx * my)) / side,
              (dot(f, x * dy) + dot(fx, mx * dy) + dot(fy, x * dmy)) / side);
}

vec3 NAMERead(vec2 p) {
  vec4 head = NAMETexel(0);
  vec2 size = NAMETexel(1).xy, q = (p - head.xy) * head.z, c = clamp(q, vec2(0.0), size);
  vec2 low = min(floor(c), size - 1.0), at = c - low, gap = (q - c) * head.w;
  float side = head.w;
  vec4 cell = NAMETexel(2 + int(low.y * size.x + low.x));
  for (int level = 1; level < LEVELS && cell.y == 0.0; ++level) {
    vec2 part = min(floor(PARTS * at), PARTS - 1.0);
    at = PARTS * at - part;
    side /= PARTS;
    cell = NAMETexel(int(cell.x + PARTS * part.y + part.x));
  }
  vec3 f = cell.y > 0.0 ? NAMENearest(p - gap, int(cell.x), int(cell.y)) : NAMEPatch(at, int(cell.x), side);
  if (gap == vec2(0.0)) return f;
  float far = sqrt(f.x * f.x + dot(gap, gap));
  return vec3(far, (f.x * f.yz * vec2(equal(gap, vec2(0.0))) + gap) / far);
}

float NAME(vec3 p) { return NAMERead(p.xy).x; }
vec3 NAMESlopes(vec3 p) { return vec3(NAMERead(p.xy).yz, 0.0); }
)";
  const std::pair<std::string, std::string> words[] = {{"NEAREST", hasArcs ? kNearestArc : kNearestSegment},
                                                       {"NAME", name},
                                                       {"LEVELS", std::to_string(kMostLevels)},
                                                       {"PARTS", std::to_string(kParts) + ".0"}};
  for (const auto& [word, with] : words)
    for (std::size_t at; (at = text.find(word)) != std::string::npos;) text.replace(at, word.size(), with);
  return text;
}

}  // namespace sdf
