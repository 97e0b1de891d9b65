#include "viewer/render/mesh_errors.h"

#include <oneapi/tbb/parallel_invoke.h>

#include <algorithm>
#include <atomic>
#include <cmath>
#include <glm/geometric.hpp>
#include <map>
#include <numeric>
#include <span>
#include <utility>

#include "sdf/eval/scalar_reading.h"
#include "sdf/mesh/mesher.h"

namespace sdf::viewer {
namespace {

constexpr double kSteps = 300.0;                // along the diagonal, that points within triangles are apart
constexpr std::size_t kMostPoints = 6'000'000;  // beyond these they are farther apart
constexpr int kMostPieces = 64;                 // that a side is divided into
constexpr std::size_t kLeaf = 128;              // triangles that share one specialised tape

// Points of a triangle by their weights, and the smaller triangles between them.
struct Lattice {
  std::vector<glm::vec3> points;
  std::vector<glm::uvec3> triangles;
};

// The corners and the middle of what is not divided, else the points that divide the sides in so many pieces.
Lattice latticeOf(int pieces) {
  if (pieces == 1)
    return {{{1, 0, 0}, {0, 1, 0}, {0, 0, 1}, glm::vec3(1.0f / 3.0f)}, {{0, 1, 3}, {1, 2, 3}, {2, 0, 3}}};
  Lattice lattice;
  for (int row = 0; row <= pieces; ++row)
    for (int i = 0; i <= row; ++i) {
      const auto at = static_cast<std::uint32_t>(lattice.points.size()),
                 below = at + static_cast<std::uint32_t>(row) + 1;
      lattice.points.push_back(glm::vec3(pieces - row, row - i, i) / static_cast<float>(pieces));
      if (row < pieces) lattice.triangles.emplace_back(at, below, below + 1);
      if (row < pieces && i < row) lattice.triangles.emplace_back(at, below + 1, at + 1);
    }
  return lattice;
}

std::size_t pointsOf(int pieces) {
  return pieces == 1 ? 4 : static_cast<std::size_t>((pieces + 1) * (pieces + 2) / 2);
}

/// Triangles that stand for a shape.
struct Body {
  const Shape& shape;
  const std::vector<glm::vec3>& positions;
  const std::vector<glm::vec3>& normals;  // or none
  const std::vector<glm::uvec3>& triangles;

  glm::vec3 corner(std::size_t triangle, int k) const { return positions[triangles[triangle][k]]; }
  double longestSide(std::size_t t) const {
    double longest = 0.0;
    for (int k = 0; k < 3; ++k)
      longest = std::max(longest, double(glm::distance(corner(t, k), corner(t, (k + 1) % 3))));
    return longest;
  }
};

Box boxOf(const Body& body, std::span<const std::uint32_t> triangles) {
  Box box;
  for (const std::uint32_t t : triangles)
    for (int k = 0; k < 3; ++k) {
      const glm::dvec3 p(body.corner(t, k));
      box = {glm::min(box.min, p), glm::max(box.max, p)};
    }
  return box;
}

/// Measures the points of one body's triangles.
class Measuring {
 public:
  Measuring(const Body& body, double farthest, Progress& progress)
      : body_(body), farthest_(farthest), progress_(progress) {}

  // The points are those from first[t] on, in the lattice of pieces[t].
  void run(const std::vector<std::size_t>& first, std::vector<BufferVertex>& vertices) {
    first_ = first.data();
    vertices_ = vertices.data();
    std::vector<std::uint32_t> all(body_.triangles.size());
    std::iota(all.begin(), all.end(), 0u);
    whole_ = std::make_shared<const Tape>(body_.shape.distance);
    if (!all.empty()) descend(whole_, all);
  }

 private:
  // Halves them until they share a tape, which each half specialises further.
  void descend(TapePtr tape, std::span<std::uint32_t> triangles) {
    if (progress_.stopped()) return;
    const Box box = boxOf(body_, triangles);
    ScalarReading<Interval> workspace;
    std::vector<Decision> decisions;
    evaluate(*tape, box, workspace, decisions);
    if (auto shorter = tape->specialised(decisions.data(), 1)) tape = std::move(shorter);
    if (triangles.size() <= kLeaf) return measure(*tape, triangles);
    const glm::dvec3 size = box.size();
    const int axis = size.x >= size.y && size.x >= size.z ? 0 : size.y >= size.z ? 1 : 2;
    const auto middle = triangles.begin() + static_cast<std::ptrdiff_t>(triangles.size() / 2);
    std::nth_element(triangles.begin(), middle, triangles.end(), [&](std::uint32_t a, std::uint32_t b) {
      return body_.corner(a, 0)[axis] < body_.corner(b, 0)[axis];
    });
    const std::size_t half = triangles.size() / 2;
    oneapi::tbb::parallel_invoke([&] { descend(tape, triangles.first(half)); },
                                 [&] { descend(tape, triangles.subspan(half)); });
  }

  void measure(const Tape& tape, std::span<const std::uint32_t> triangles) {
    for (const std::uint32_t t : triangles)
      for (std::size_t i = first_[t]; i < first_[t + 1]; ++i)
        vertices_[i].distance = static_cast<float>(distance(tape, glm::dvec3(vertices_[i].position)));
    done_ += triangles.size();
    progress_.update(static_cast<double>(done_) / static_cast<double>(body_.triangles.size()));
  }

  // What is no number is as far away as the mesh is wide. Where the slope is far below its bound, as in the
  // middle of a solid, the distance divided by it says nothing.
  double distance(const Tape& tape, const glm::dvec3& p) const {
    constexpr double kDoubtful = 0.5;
    if (body_.shape.claim.kind <= ClaimKind::ExactOutside) return held(evaluate(tape, p));
    const ValueAndGradient f = evaluateGradient(tape, p);
    const double slope = glm::length(f.gradient);
    if (!(slope > 0.0 && slope < kInfinity)) return held(f.value);
    if (slope >= kDoubtful * body_.shape.claim.lipschitz) return held(f.value / slope);
    return held(std::copysign(wayOut(p, f.value, f.gradient / slope), f.value));
  }

  double held(double d) const { return std::isfinite(d) ? d : std::copysign(farthest_, d); }

  // How far it is along the gradient to where the sign changes, by the whole tape, for it leads
  // away from where others hold. There is the surface, which bounds the distance.
  double wayOut(const glm::dvec3& p, double value, const glm::dvec3& up) const {
    constexpr int kReadings = 128;
    const double least = 1e-9 * farthest_;
    double t = 0.0, f = std::abs(value);
    for (int i = 0; i < kReadings && f > least; ++i) {
      t += f / body_.shape.claim.lipschitz;
      const double next = evaluate(*whole_, p - std::copysign(t, value) * up);
      f = value < 0.0 ? -next : next;
    }
    return t;
  }

  const Body& body_;
  double farthest_;
  Progress& progress_;
  TapePtr whole_;
  const std::size_t* first_ = nullptr;
  BufferVertex* vertices_ = nullptr;
  std::atomic<std::size_t> done_{0};
};

int piecesOf(double side, double step) {
  return static_cast<int>(std::clamp(std::ceil(side / step), 1.0, double(kMostPieces)));
}

// How far apart the points are.
double stepFor(const std::vector<Body>& bodies, double diagonal) {
  for (double step = diagonal / kSteps;; step *= 2.0) {
    std::size_t points = 0;
    bool divided = false;
    for (const Body& body : bodies)
      for (std::size_t t = 0; t < body.triangles.size(); ++t) {
        const int pieces = piecesOf(body.longestSide(t), step);
        points += pointsOf(pieces);
        divided = divided || pieces > 1;
      }
    if (points <= kMostPoints || !divided) return step;
  }
}

// Adds the body's points, with their distances, and the triangles between them.
void add(const Body& body, double step, double diagonal, Progress& progress, ShownMesh& shown) {
  std::map<int, Lattice> lattices;
  std::vector<std::size_t> first;
  for (std::size_t t = 0; t < body.triangles.size(); ++t) {
    const int pieces = piecesOf(body.longestSide(t), step);
    if (!lattices.contains(pieces)) lattices[pieces] = latticeOf(pieces);
    const Lattice& lattice = lattices[pieces];
    const auto start = static_cast<std::uint32_t>(shown.vertices.size());
    first.push_back(start);
    for (const glm::vec3& w : lattice.points) {
      BufferVertex& v = shown.vertices.emplace_back();
      v.position = w.x * body.corner(t, 0) + w.y * body.corner(t, 1) + w.z * body.corner(t, 2);
      if (body.normals.empty()) continue;
      const glm::uvec3& corners = body.triangles[t];
      v.normal =
          w.x * body.normals[corners.x] + w.y * body.normals[corners.y] + w.z * body.normals[corners.z];
    }
    for (const glm::uvec3& piece : lattice.triangles) shown.triangles.push_back(piece + start);
  }
  first.push_back(shown.vertices.size());
  Measuring(body, diagonal, progress).run(first, shown.vertices);
}

// The first of 1, 2 and 5 times a power of ten that is not less.
double rounded(double value) {
  const double power = std::pow(10.0, std::floor(std::log10(value)));
  for (const double step : {1.0, 2.0, 5.0})
    if (value <= step * power * (1.0 + 1e-9)) return step * power;
  return 10.0 * power;
}

// A piece's mean distance, and its area.
struct Piece {
  double distance, area;
};

std::vector<Piece> piecesOf(const ShownMesh& shown) {
  std::vector<Piece> pieces;
  for (const glm::uvec3& t : shown.triangles) {
    const BufferVertex &a = shown.vertices[t.x], &b = shown.vertices[t.y], &c = shown.vertices[t.z];
    const glm::dvec3 along(b.position - a.position), across(c.position - a.position);
    pieces.push_back(
        {(double(a.distance) + b.distance + c.distance) / 3.0, 0.5 * glm::length(glm::cross(along, across))});
  }
  return pieces;
}

// What 99 % of the area keeps.
double mostlyWithin(std::vector<Piece> pieces, double area) {
  constexpr double kMost = 0.99;
  std::ranges::sort(pieces, {}, [](const Piece& p) { return std::abs(p.distance); });
  double sum = 0.0;
  for (const Piece& piece : pieces)
    if ((sum += piece.area) >= kMost * area) return std::abs(piece.distance);
  return 0.0;
}

ErrorFigures figuresOf(const ShownMesh& shown, double tolerance, double diagonal) {
  ErrorFigures figures;
  figures.tolerance = tolerance;
  for (const BufferVertex& v : shown.vertices) {
    figures.least = std::min(figures.least, double(v.distance));
    figures.most = std::max(figures.most, double(v.distance));
  }
  const std::vector<Piece> pieces = piecesOf(shown);
  double area = 0.0, squares = 0.0;
  for (const Piece& p : pieces) area += p.area, squares += p.area * p.distance * p.distance;
  figures.rms = area > 0.0 ? std::sqrt(squares / area) : 0.0;
  constexpr double kLeast = 1e-9;  // of the diagonal: what floats of vertices cannot tell apart
  const double within = tolerance > 0.0 ? tolerance : mostlyWithin(pieces, area);
  figures.limit = tolerance > 0.0 ? tolerance : rounded(std::max({within, kLeast * diagonal, 1e-300}));
  constexpr auto kBins = ErrorFigures::kBins;
  figures.histogram.assign(kBins + 2, 0.0);
  for (const Piece& p : pieces) {
    const double share = 0.5 * (p.distance / figures.limit + 1.0);
    const std::size_t bin = share < 0.0   ? 0
                            : share > 1.0 ? kBins + 1
                                          : 1 + std::min(static_cast<std::size_t>(share * kBins), kBins - 1);
    figures.histogram[bin] += p.area / area;
  }
  return figures;
}

Result<MeshErrors> measured(const std::vector<Body>& bodies, double tolerance, Progress& progress) {
  progress.beginStage("measuring");
  MeshErrors errors;
  Box box;
  for (const Body& body : bodies)
    for (const glm::vec3& p : body.positions)
      box = {glm::min(box.min, glm::dvec3(p)), glm::max(box.max, glm::dvec3(p))};
  const double diagonal = box.empty() ? 0.0 : glm::length(box.size()), step = stepFor(bodies, diagonal);
  for (const Body& body : bodies) {
    add(body, step, diagonal, progress, errors.shown);
    errors.figures.triangles += body.triangles.size();
    if (progress.stopped()) return Error{ErrorKind::Interrupted, "interrupted"};
  }
  errors.shown.ranges = {{.first = 0,
                          .count = static_cast<int>(errors.shown.triangles.size()),
                          .look = glm::vec4(1.0f),
                          .glow = glm::vec4(0.0f)}};
  const std::size_t triangles = errors.figures.triangles;
  errors.figures = figuresOf(errors.shown, tolerance, diagonal);
  errors.figures.triangles = triangles;
  return errors;
}

}  // namespace

Result<MeshErrors> measureErrors(const SceneMesh& mesh, Progress& progress) {
  std::vector<Shape> shapes;
  for (const Part& part : mesh.scene.parts)
    shapes.push_back(mesh.scene.bounds ? clipped(part.shape, *mesh.scene.bounds) : part.shape);
  std::vector<Body> bodies;
  for (std::size_t i = 0; i < mesh.parts.size(); ++i) {
    const Mesh& m = mesh.parts[i].mesh;
    bodies.push_back({shapes[i], m.positions, m.normals, m.triangles});
  }
  return measured(bodies, mesh.tolerance, progress);
}

Result<MeshErrors> measureErrors(const TriangleMesh& mesh, const Shape& whole, double tolerance,
                                 Progress& progress) {
  return measured({{whole, mesh.positions, mesh.normals, mesh.triangles}}, tolerance, progress);
}

}  // namespace sdf::viewer
