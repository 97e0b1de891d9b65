#include "sdf/shape/calibrate/corners.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <vector>

#include "sdf/shape/calibrate/cells.h"
#include "sdf/shape/calibrate/forms.h"
#include "sdf/shape/formula.h"
#include "sdf/shape/operand.h"

namespace sdf {

namespace {

constexpr double kModerateCorner = 2.0;  // a slope that is worth the shorter steps
// Cosines of the sharpest edges of curved faces, from the sharpest to the bluntest that is tried: of angles
// of 11, 26 and 46 degrees between the faces.
constexpr std::array<double, 3> kSharpest{0.98, 0.9, 0.7};
// The sine of an angle between normals below which faces count as parallel.
constexpr double kParallel = 1e-6;
// More than a slope for which cells are not refined.
constexpr double kLookFor = 1.5;

// Two or three faces that meet, and the cosines between their normals: of the first and second, the second
// and third, the third and first.
struct Corner {
  std::vector<std::size_t> faces;
  std::vector<Expr> cosines;
  bool flat = true;    // are these the same everywhere?
  bool known = false;  // do the faces' distances tell of it already?
};

// What is bounded of a corner in a cell: if it can be met, and its slope for each of kSharpest.
struct Met {
  bool possible = false;
  std::array<double, kSharpest.size()> slopes{};
};

Expr held(const Expr& cosine, double sharpest) { return isUniform(cosine) ? cosine : max(cosine, -sharpest); }

// Of two faces: outside of both lines the distance to where they meet, else the greater one's.
Expr edgeDistance(const Expr& a, const Expr& b, const Expr& c) {
  const Expr sine = sqrt(max(1.0 - square(c), kParallel * kParallel)), out = max(a, b);
  const Expr past = (min(a, b) - scaled(out, c)) / sine;
  return sqrt(square(max(out, 0.0)) + square(max(past, 0.0))) + min(out, 0.0);
}

// Of the Gram matrix of three normals.
template <class T>
struct Adjugate {
  std::array<T, 3> own, beside;  // the entries (i, i), and (i, i + 1)
  T determinant;
};

// c[i] is the cosine between the normals i and i + 1.
template <class T>
Adjugate<T> adjugateOf(const std::array<T, 3>& c) {
  Adjugate<T> a;
  for (std::size_t i = 0; i < 3; ++i) {
    const std::size_t j = (i + 1) % 3, k = (i + 2) % 3;
    a.own[i] = sub(T(1.0), square(c[j]));
    a.beside[i] = sub(mul(c[j], c[k]), c[i]);
  }
  // Along the first row of the matrix, 1, c[0], c[2].
  a.determinant = add(a.own[0], add(mul(c[0], a.beside[0]), mul(c[2], a.beside[2])));
  return a;
}

// What the adjugate makes of three distances.
template <class T>
std::array<T, 3> weightsOf(const Adjugate<T>& a, const std::array<T, 3>& d) {
  std::array<T, 3> w;
  for (std::size_t i = 0; i < 3; ++i) {
    const std::size_t j = (i + 1) % 3, k = (i + 2) % 3;
    w[i] = add(mul(a.own[i], d[i]), add(mul(a.beside[i], d[j]), mul(a.beside[k], d[k])));
  }
  return w;
}

// In pairs: libstdc++'s hypot of three makes NaN of two infinities.
double steepness(const Sloped& e) {
  return std::hypot(std::hypot(e.d[0].magnitude(), e.d[1].magnitude()), e.d[2].magnitude());
}

class Corners {
 public:
  Corners(std::span<const Face> faces, const Box& region, double reach)
      : faces_(faces), region_(region), reach_(reach) {
    findEdges();
    judge(0);
    findCorners();
    judge(edges_);
  }

  std::optional<Expr> built() const {
    std::vector<Expr> flat, curved;
    double slope = 0.0;
    for (std::size_t i = 0; i < corners_.size(); ++i) {
      const Corner& corner = corners_[i];
      if (!isKept(i) || corner.known) continue;
      slope = std::max(slope, corner.flat ? met_[i].slopes[0] : met_[i].slopes[level_]);
      (corner.flat ? flat : curved).push_back(distanceOf(corner));
    }
    if (flat.empty() && curved.empty()) return {};
    const auto greatest = [](Expr d, const std::vector<Expr>& all) {
      for (const Expr& e : all) d = max(d, e);
      return d;
    };
    Expr d = faces_.front().distance;
    for (const Face& f : faces_) d = max(d, f.distance), slope = std::max(slope, f.slope);
    d = greatest(d, flat);
    if (!curved.empty()) d = max(d, heldWithin(min(greatest(curved[0], curved), reach_), region_));
    return d.claimLipschitz(slope);
  }

 private:
  Expr cosineOf(std::size_t a, std::size_t b) const { return weighted(*faces_[a].normal, *faces_[b].normal); }

  void findEdges() {
    for (std::size_t a = 0; a < faces_.size(); ++a)
      for (std::size_t b = a + 1; b < faces_.size(); ++b)
        if (faces_[a].normal && faces_[b].normal) addCorner({a, b}, {cosineOf(a, b)});
    edges_ = corners_.size();
  }

  // Of faces of which every two have an edge that is kept, or there would be a step at the corner's sides.
  void findCorners() {
    const auto isEdge = [&](std::size_t a, std::size_t b) {
      for (std::size_t i = 0; i < edges_; ++i)
        if (corners_[i].faces == std::vector{a, b}) return isKept(i);
      return false;
    };
    for (std::size_t a = 0; a < faces_.size(); ++a)
      for (std::size_t b = a + 1; b < faces_.size(); ++b)
        for (std::size_t c = b + 1; c < faces_.size() && isEdge(a, b); ++c)
          if (isEdge(b, c) && isEdge(a, c))
            addCorner({a, b, c}, {cosineOf(a, b), cosineOf(b, c), cosineOf(a, c)});
  }

  void addCorner(std::vector<std::size_t> faces, std::vector<Expr> cosines) {
    Corner corner{std::move(faces), std::move(cosines)};
    const int solid = faces_[corner.faces[0]].solid;
    corner.known = solid >= 0;
    for (const std::size_t f : corner.faces) corner.known = corner.known && faces_[f].solid == solid;
    for (const Expr& c : corner.cosines) {
      corner.flat = corner.flat && isUniform(c);
      if (c.range().isPoint() && 1.0 - std::abs(c.range().lo) < 0.5 * kParallel * kParallel) return;
    }
    if (corner.flat || region_.finite()) corners_.push_back(std::move(corner));
  }

  // Bounds what there is to know over cells of the region of the corners from this one on.
  void judge(std::size_t from) {
    met_.resize(corners_.size());
    const std::span<const Corner> corners = std::span(corners_).subspan(from);
    const std::span<Met> met = std::span(met_).subspan(from);
    if (corners.empty()) return;
    if (!region_.finite()) {
      std::ranges::fill(met, Met{true, {1.0, 1.0, 1.0}});
      return;
    }
    std::vector<Expr> roots;
    for (const Face& f : faces_) roots.push_back(f.distance);
    for (const Corner& c : corners) roots.insert(roots.end(), c.cosines.begin(), c.cosines.end());
    SlopedReading reading(roots);
    // What is flat needs fewer.
    const std::size_t most = std::ranges::all_of(corners, &Corner::flat) ? 250 : 800;
    const std::size_t mostCells = affordableCells(60000, reading.size(), most);
    constexpr std::size_t kEntries = kSharpest.size() + 1;
    const auto slopesOf = [&](const Box& box) {
      reading.run(box);
      std::vector<double> all;
      double worst = 0.0;
      std::size_t cosine = faces_.size();
      for (const Corner& c : corners) {
        const Met m = metIn(c, reading, cosine);
        cosine += c.cosines.size();
        all.push_back(m.possible ? 1.0 : 0.0);
        all.insert(all.end(), m.slopes.begin(), m.slopes.end());
        // Whether a flat edge is met at all is worth some cells, too.
        if (!c.known) worst = std::max(worst, c.flat && m.possible ? kLookFor : m.slopes.back());
      }
      all.push_back(worst);
      return all;
    };
    for (const Cell& cell : refined(region_, region_.longestSide(), mostCells, slopesOf))
      for (std::size_t i = 0; i < corners.size(); ++i) {
        met[i].possible = met[i].possible || cell.slopes[i * kEntries] > 0.0;
        for (std::size_t k = 0; k < kSharpest.size(); ++k)
          met[i].slopes[k] = std::max(met[i].slopes[k], cell.slopes[i * kEntries + 1 + k]);
      }
    if (from > 0) return;
    const auto isModerate = [&](std::size_t level) {
      return std::ranges::all_of(met, [&](const Met& m) { return m.slopes[level] <= kModerateCorner; });
    };
    while (level_ + 1 < kSharpest.size() && !isModerate(level_)) ++level_;
  }

  Met metIn(const Corner& corner, const SlopedReading& reading, std::size_t cosine) const {
    Interval greatest(-kInfinity);
    for (std::size_t i = 0; i < faces_.size(); ++i) greatest = max(greatest, reading[i].v);
    Met met;
    if (!greatest.nan && (greatest.lo > reach_ || greatest.hi < 0.0)) return met;
    for (std::size_t k = 0; k < kSharpest.size(); ++k)
      if (const auto slope = slopeIn(corner, reading, cosine, kSharpest[k]))
        met.possible = true, met.slopes[k] = *slope;
    return met;
  }

  // A bound of the corner's slope in a cell, or nothing where it is not met. At fixed cosines the gradient is
  // the sum of l_i n_i with l = G^-1 d / F, of length 1 at most for faces without error. F changes with a
  // cosine by F l_i l_j, of which l_i is at most the root of G^-1's entry, and of two faces l_i l_j at most
  // 1 / (2 (1 + c)).
  std::optional<double> slopeIn(const Corner& corner, const SlopedReading& reading, std::size_t cosine,
                                double sharpest) const {
    std::array<Interval, 3> d, c;
    std::array<double, 3> turn{};
    double steepest = 1.0;
    for (std::size_t i = 0; i < corner.faces.size(); ++i) {
      // Where one is beyond the reach the corner is, too.
      d[i] = min(reading[corner.faces[i]].v, Interval(reach_));
      steepest = std::max(steepest, faces_[corner.faces[i]].slope);
    }
    for (std::size_t i = 0; i < corner.cosines.size(); ++i) {
      const Sloped& read = reading[cosine + i];
      c[i] = min(read.v, Interval(1.0));
      if (!isUniform(corner.cosines[i])) c[i] = max(c[i], Interval(-sharpest));
      if (!isUniform(corner.cosines[i])) turn[i] = steepness(read);
    }
    const bool exact = isOneLipschitz(steepest);
    if (corner.faces.size() == 2) {
      if (sub(d[0], mul(c[0], d[1])).hi <= 0.0 || sub(d[1], mul(c[0], d[0])).hi <= 0.0) return {};
      const double along = exact ? 1.0 : steepest * std::sqrt(2.0 / (1.0 + c[0].lo));
      return along + (turn[0] == 0.0 ? 0.0 : reach_ * turn[0] / (2.0 * (1.0 + c[0].lo)));
    }
    const Adjugate<Interval> a = adjugateOf(c);
    for (const Interval& w : weightsOf(a, d))
      if (w.hi <= 0.0) return {};
    double along = 1.0, turning = 0.0;
    const bool turns = turn[0] + turn[1] + turn[2] > 0.0;
    if (!exact || turns) {
      if (!(a.determinant.lo > 0.0)) return kInfinity;
      std::array<double, 3> most{};
      for (std::size_t i = 0; i < 3; ++i) most[i] = std::sqrt(farthest(a.own[i]) / a.determinant.lo);
      if (!exact) along = steepest * (most[0] + most[1] + most[2]);
      for (std::size_t i = 0; i < 3; ++i)
        if (turn[i] > 0.0) turning += reach_ * turn[i] * most[i] * most[(i + 1) % 3];
    }
    return along + turning;
  }

  // Is it met, and no steeper than it is worth?
  bool isKept(std::size_t i) const {
    const Corner& corner = corners_[i];
    const double slope = met_[i].slopes[corner.flat ? 0 : level_];
    return met_[i].possible && (corner.known || slope <= 2.0 * kModerateCorner);
  }

  Expr distanceOf(const Corner& corner) const {
    std::array<Expr, 3> d, c;
    for (std::size_t i = 0; i < corner.faces.size(); ++i) d[i] = faces_[corner.faces[i]].distance;
    for (std::size_t i = 0; i < corner.cosines.size(); ++i) c[i] = held(corner.cosines[i], kSharpest[level_]);
    if (corner.faces.size() == 2) return edgeDistance(d[0], d[1], c[0]);
    const Adjugate<Expr> a = adjugateOf(c);
    const std::array<Expr, 3> w = weightsOf(a, d);
    const Expr square = (d[0] * w[0] + d[1] * w[1] + d[2] * w[2]) / a.determinant;
    return select(less(0.0, min(w[0], min(w[1], w[2]))), sqrt(max(square, 0.0)), d[0]);
  }

  std::span<const Face> faces_;
  Box region_;
  double reach_;
  std::vector<Corner> corners_;  // edges first
  std::size_t edges_ = 0;
  std::vector<Met> met_;
  std::size_t level_ = 0;  // of kSharpest, for the edges of curved faces
};

}  // namespace

std::optional<Expr> aroundCorners(std::span<const Face> faces, const Box& region, double reach) {
  return Corners(faces, region, reach).built();
}

}  // namespace sdf
