#include "sdf/outline/boundary.h"

#include <map>
#include <numbers>
#include <numeric>
#include <optional>
#include <utility>

#include "sdf/outline/meetings.h"

namespace sdf {
namespace {

constexpr double kSamePoint = 1e-10;  // of the size of all

/// A part of an arc between two points of the arrangement.
struct Piece {
  ArcCorner from;
  glm::dvec2 to;
  std::size_t start, end;  // numbers of the points
  Arc arc() const { return Arc::through(from, to); }
};

Piece reversed(const Piece& p) { return {{p.to, -p.from.bulge}, p.from.at, p.end, p.start}; }

/// Points, those that are near each other being one.
class PointSet {
 public:
  /// None is far below `low`, as seen from the size of all.
  PointSet(const glm::dvec2& low, double reach) : low_(low), cell_(4.0 * reach), reach_(reach) {}

  std::size_t numberOf(const glm::dvec2& p) {
    const Cell at{cellOf(p.x - low_.x), cellOf(p.y - low_.y)};
    for (std::int64_t x = at.first - 1; x <= at.first + 1; ++x)
      for (std::int64_t y = at.second - 1; y <= at.second + 1; ++y)
        if (const auto found = inCells_.find({x, y}); found != inCells_.end())
          for (const std::size_t i : found->second)
            if (std::hypot(points_[i].x - p.x, points_[i].y - p.y) <= 2.0 * reach_) return i;
    inCells_[at].push_back(points_.size());
    points_.push_back(p);
    return points_.size() - 1;
  }
  const glm::dvec2& operator[](std::size_t i) const { return points_[i]; }
  std::size_t size() const { return points_.size(); }

 private:
  using Cell = std::pair<std::int64_t, std::int64_t>;
  std::int64_t cellOf(double x) const { return static_cast<std::int64_t>(std::floor(x / cell_)); }

  glm::dvec2 low_;
  double cell_, reach_;
  std::vector<glm::dvec2> points_;
  std::map<Cell, std::vector<std::size_t>> inCells_;
};

/// The arcs of contours, and where they meet others.
struct Arrangement {
  std::vector<Arc> arcs;
  std::vector<std::size_t> next;  // arc on the same contour
  SideTree tree;
  double reach;
  std::vector<std::vector<glm::dvec2>> cuts;  // by arc, its ends among them

  explicit Arrangement(const std::vector<ArcContour>& contours) : arcs(arcsOf(contours)), tree(treeOf(arcs)) {
    const glm::dvec2 size = tree.bounds().hi - tree.bounds().lo;
    reach = kSamePoint * std::max(size.x, size.y);
    for (const ArcContour& c : contours) {
      const std::size_t first = next.size();
      for (std::size_t i = 0; i < c.size(); ++i) next.push_back(first + (i + 1) % c.size());
    }
    cuts.resize(arcs.size());
    for (std::size_t i = 0; i < arcs.size(); ++i) findCuts(i);
  }

 private:
  void findCuts(std::size_t i) {
    Rectangle box = arcs[i].box();
    box.lo -= glm::dvec2(reach), box.hi += glm::dvec2(reach);
    tree.any([&](const Rectangle& other) { return other.meets(box); },
             [&](std::size_t j) {
               if (j > i && arcs[j].box().meets(box)) cutBoth(i, j);
               return false;
             });
  }
  void cutBoth(std::size_t i, std::size_t j) {
    for (const glm::dvec2& p : meetingsOf(arcs[i], arcs[j], reach)) {
      if (joins(i, j, p) || joins(j, i, p)) continue;
      cuts[i].push_back(p);
      cuts[j].push_back(p);
    }
  }
  // Is p where arc i goes over into arc j?
  bool joins(std::size_t i, std::size_t j, const glm::dvec2& p) const {
    return next[i] == j && std::hypot(p.x - arcs[j].from.x, p.y - arcs[j].from.y) <= 4.0 * reach;
  }
};

// The chains of pieces between points where arcs meet, in the direction of their contours.
class ChainMaker {
 public:
  ChainMaker(const Arrangement& all, PointSet& points) : all_(all), points_(points) {}

  std::vector<std::vector<Piece>> run() {
    for (std::size_t first = 0; first < all_.arcs.size();) {
      std::size_t last = first;
      while (all_.next[last] > last) ++last;
      contour(first, last);
      first = last + 1;
    }
    std::erase_if(chains_, [](const auto& chain) { return chain.empty(); });
    return std::move(chains_);
  }

 private:
  void contour(std::size_t first, std::size_t last) {
    const std::size_t before = chains_.size();
    chains_.emplace_back();
    bool isCutAtStart = false;
    for (std::size_t i = first; i <= last; ++i) {
      const bool isCut = pieces(i);
      if (i == first) isCutAtStart = isCut;
    }
    // The last chain goes on with the first one, unless there is a cut between them.
    if (chains_.size() > before + 1 && !isCutAtStart && !endsInCut_) {
      std::vector<Piece>& end = chains_.back();
      end.insert(end.end(), chains_[before].begin(), chains_[before].end());
      std::swap(chains_[before], chains_.back());
      chains_.pop_back();
    }
  }

  // Writes the pieces of an arc; returns whether it begins in a cut.
  bool pieces(std::size_t i) {
    const Arc& arc = all_.arcs[i];
    const glm::dvec2 chord = arc.to - arc.from;
    std::vector<glm::dvec2> cuts = all_.cuts[i];
    std::ranges::sort(cuts, {}, [&](const glm::dvec2& p) { return dotOf(p - arc.from, chord); });
    const std::size_t start = points_.numberOf(arc.from), end = points_.numberOf(arc.to);
    std::size_t at = start;
    bool isCutAtStart = false;
    endsInCut_ = false;
    for (const glm::dvec2& p : cuts) {
      const std::size_t number = points_.numberOf(p);
      piece(arc, at, number);
      at = number;
      isCutAtStart = isCutAtStart || number == start;
      endsInCut_ = endsInCut_ || number == end;
      if (!chains_.back().empty()) chains_.emplace_back();
    }
    piece(arc, at, end);
    return isCutAtStart;
  }

  void piece(const Arc& arc, std::size_t from, std::size_t to) {
    if (from == to) return;
    chains_.back().push_back({arc.part(points_[from], points_[to]), points_[to], from, to});
  }

  const Arrangement& all_;
  PointSet& points_;
  bool endsInCut_ = false;
  std::vector<std::vector<Piece>> chains_;
};

// The chains that have the inside on one side alone, and that on the left. Which it is shows beside the
// longest of a chain's pieces.
std::vector<Piece> borderOf(const Arrangement& all, std::vector<std::vector<Piece>> chains, FillRule rule) {
  const auto isInside = [&](const glm::dvec2& p) {
    const int winding = windingNumber(all.arcs, all.tree, p);
    return rule == FillRule::NonZero ? winding != 0 : winding % 2 != 0;
  };
  std::vector<Piece> border;
  for (std::vector<Piece>& chain : chains) {
    const Arc longest =
        std::ranges::max_element(chain, {}, [](const Piece& p) { return p.arc().size; })->arc();
    const glm::dvec2 middle = longest.middle(), step = longest.normalAt(middle) * (16.0 * all.reach);
    const bool right = isInside(middle + step), left = isInside(middle - step);
    if (left == right) continue;
    if (right)
      for (Piece& p : chain) p = reversed(p);
    border.insert(border.end(), chain.begin(), chain.end());
  }
  return border;
}

// Those that lie on another one are there once.
void dropRepeated(std::vector<Piece>& pieces, double reach) {
  const auto ends = [](const Piece& p) { return std::pair(p.start, p.end); };
  std::ranges::stable_sort(pieces, {}, ends);
  std::vector<Piece> kept;
  for (const Piece& p : pieces) {
    bool isNew = true;
    for (std::size_t k = kept.size(); k-- > 0 && ends(kept[k]) == ends(p);) {
      const glm::dvec2 apart = kept[k].arc().middle() - p.arc().middle();
      isNew = isNew && std::hypot(apart.x, apart.y) > 4.0 * reach;
    }
    if (isNew) kept.push_back(p);
  }
  pieces = std::move(kept);
}

/// Joins pieces to contours, so that the inside is to the left of each corner.
class Joiner {
 public:
  Joiner(const std::vector<Piece>& pieces, std::size_t points) : pieces_(pieces), leaving_(points) {
    for (std::size_t i = 0; i < pieces.size(); ++i) leaving_[pieces[i].start].push_back(i);
    isUsed_.assign(pieces.size(), false);
  }

  std::optional<std::vector<ArcContour>> run() {
    std::vector<ArcContour> contours;
    for (std::size_t first = 0; first < pieces_.size(); ++first) {
      if (isUsed_[first]) continue;
      ArcContour contour;
      std::optional<std::size_t> at = first;
      do {
        isUsed_[*at] = true;
        contour.push_back(pieces_[*at].from);
        if (!(at = after(*at, first))) return {};
      } while (*at != first);
      if (contour.size() > 1) contours.push_back(std::move(contour));
    }
    return contours;
  }

 private:
  // Of the pieces that leave the point, the first one to the right of where this one came from.
  std::optional<std::size_t> after(std::size_t piece, std::size_t first) const {
    const Arc in = pieces_[piece].arc();
    std::optional<std::size_t> best;
    double least = 0.0, bend = 0.0;
    for (const std::size_t i : leaving_[pieces_[piece].end]) {
      if (isUsed_[i] && i != first) continue;
      const Arc out = pieces_[i].arc();
      // To the right from -in: 0 where it comes straight back, and then by their bends.
      double angle = std::atan2(crossOf(out.along, -in.alongTo), dotOf(out.along, -in.alongTo));
      const bool isInside = -out.curvature > in.curvature;
      if (std::abs(angle) < kSameAngle) angle = isInside ? 0.0 : 2.0 * std::numbers::pi;
      if (angle < 0.0) angle += 2.0 * std::numbers::pi;
      const bool isFirst = angle < least - kSameAngle || (angle < least + kSameAngle && out.curvature > bend);
      if (!best || isFirst) best = i, least = angle, bend = out.curvature;
    }
    return best;
  }

  static constexpr double kSameAngle = 1e-7;
  const std::vector<Piece>& pieces_;
  std::vector<std::vector<std::size_t>> leaving_;  // by point
  std::vector<bool> isUsed_;
};

}  // namespace

Result<std::vector<ArcContour>> boundaryOf(const std::vector<ArcContour>& contours, FillRule rule) {
  if (contours.empty()) return contours;
  const Arrangement all(contours);
  PointSet points(all.tree.bounds().lo, all.reach);
  std::vector<std::vector<Piece>> chains = ChainMaker(all, points).run();
  std::vector<Piece> border = borderOf(all, std::move(chains), rule);
  dropRepeated(border, all.reach);
  if (auto joined = Joiner(border, points.size()).run()) return *joined;
  return Error{
      ErrorKind::Scene,
      "curves all but lie on each other where contours overlap; move them apart, unite them before, or "
      "make a stroke a little wider"};
}

}  // namespace sdf
