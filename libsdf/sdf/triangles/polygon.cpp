// Ears are cut off (Meisters 1975, Polygons Have Ears), the shortest first. One that is blocked by another
// corner waits until that corner blocks nothing any more.
#include "sdf/triangles/polygon.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <glm/geometric.hpp>
#include <queue>
#include <utility>

#include "sdf/triangles/orientation.h"
#include "sdf/triangles/point_tree.h"

namespace sdf {
namespace {

constexpr std::uint32_t kNone = ~0u;

/// A corner that is off the diagonal by no more than what rounds coordinates is on a straight side, most
/// likely. Its triangle would face anywhere, so it counts as if its diagonal were so much longer: rather than
/// on, for a finely divided circle has such corners only.
constexpr double kThin = 32.0;

/// The order in which corners are cut off.
enum class Rank : std::uint8_t {
  Nothing,   ///< an edge and back, or an edge of no length: nothing is cut off
  Plain,     ///< an ear
  Touching,  ///< another corner lies on the diagonal
};

bool hasArea(const glm::uvec3& t, const std::vector<glm::vec3>& points) {
  const glm::dvec3 a(points[t.x]);
  return glm::cross(glm::dvec3(points[t.y]) - a, glm::dvec3(points[t.z]) - a) != glm::dvec3(0.0);
}

class PolygonCutter {
 public:
  PolygonCutter(const std::vector<glm::vec3>& points, std::span<const std::uint32_t> polygon,
                std::vector<glm::uvec3>& triangles)
      : points_(points),
        polygon_(polygon),
        triangles_(triangles),
        count_(static_cast<std::uint32_t>(polygon.size())),
        left_(count_),
        before_(count_),
        after_(count_),
        age_(count_, 0),
        waiting_(count_, kNone),
        flat_(flattened()),
        blockers_(flat_) {
    for (std::uint32_t i = 0; i < count_; ++i) {
      before_[i] = i > 0 ? i - 1 : count_ - 1;
      after_[i] = i + 1 < count_ ? i + 1 : 0;
    }
  }

  bool cut() {
    offerAll();
    cutEars();
    // A corner that touches others may be free without having been told.
    for (std::uint32_t last = left_ + 1; left_ > 3 && left_ < last && retries_-- > 0;) {
      last = left_;
      offerAll();
      cutEars();
    }
    if (left_ > 3) cutAnyhow();
    emit(first_);
    return !turned_;
  }

 private:
  struct Corner {
    Rank rank;
    float diagonal;  // longer for what is thin
    std::uint32_t point, place, age;
    bool operator>(const Corner& other) const {
      if (rank != other.rank) return rank > other.rank;
      if (diagonal != other.diagonal) return diagonal > other.diagonal;
      return point != other.point ? point > other.point : place > other.place;
    }
  };
  struct Waiting {
    std::uint32_t place, age, next;
  };

  const glm::vec3& at(std::uint32_t i) const { return points_[polygon_[i]]; }

  /// Twice its area's vector (Newell's).
  glm::dvec3 normal() const {
    glm::dvec3 sum(0.0);
    const glm::dvec3 origin(at(0));
    for (std::uint32_t i = 1; i + 1 < count_; ++i)
      sum += glm::cross(glm::dvec3(at(i)) - origin, glm::dvec3(at(i + 1)) - origin);
    return sum;
  }

  /// The corners without one of their coordinates, which rounds nothing, so that they run counter-clockwise.
  /// Of axes that are about as near to the normal always the same one is taken.
  std::vector<glm::vec2> flattened() {
    const glm::dvec3 n = normal();
    balanced_ = n == glm::dvec3(0.0);
    const glm::dvec3 near = glm::abs(n) * glm::dvec3(1.0, 1.05, 1.1);
    const int axis = near.z >= near.x && near.z >= near.y ? 2 : near.y >= near.x ? 1 : 0;
    const int u = (axis + (n[axis] < 0.0 ? 2 : 1)) % 3, v = 3 - axis - u;
    std::vector<glm::vec2> flat;
    flat.reserve(count_);
    float farthest = 0.0f;
    const auto finite = [](float c) { return std::isfinite(c) ? c : 0.0f; };  // NaN has no order
    for (std::uint32_t i = 0; i < count_; ++i) {
      flat.emplace_back(finite(at(i)[u]), finite(at(i)[v]));
      for (int k = 0; k < 3; ++k) farthest = std::max(farthest, std::abs(at(i)[k]));
    }
    rounding_ = 1e-6 * static_cast<double>(farthest);
    return flat;
  }

  void offerAll() {
    for (std::uint32_t i = first_, rest = left_; rest > 0; --rest, i = after_[i]) offer(i);
  }

  /// Looks anew at a corner whose neighbours changed, and at those that it blocked.
  void offer(std::uint32_t i) {
    ++age_[i];
    const int side = orientation(flat_[before_[i]], flat_[i], flat_[after_[i]]);
    blockers_.set(i, side <= 0);
    if (side > 0) wake(i);
    if (side > 0 || isNothing(i)) push(i, side > 0 ? Rank::Plain : Rank::Nothing);
  }

  bool isNothing(std::uint32_t i) const {
    const glm::vec3 &a = at(before_[i]), &b = at(after_[i]);
    return a == b || a == at(i) || b == at(i);
  }

  void push(std::uint32_t i, Rank rank) {
    const glm::dvec3 corner(at(i)), a(at(before_[i])), b(at(after_[i]));
    double diagonal = glm::distance(a, b);
    if (glm::length(glm::cross(a - corner, b - corner)) <= rounding_ * diagonal) diagonal *= kThin;
    corners_.push(
        {rank, std::isfinite(diagonal) ? static_cast<float>(diagonal) : 0.0f, polygon_[i], i, age_[i]});
  }

  void wake(std::uint32_t blocker) {
    for (std::uint32_t w = std::exchange(waiting_[blocker], kNone); w != kNone;) {
      const Waiting one = waits_[w];
      waits_[w].next = std::exchange(freeWait_, w);
      if (one.age == age_[one.place]) push(one.place, Rank::Plain);
      w = one.next;
    }
  }

  void waitFor(std::uint32_t blocker, const Corner& corner) {
    std::uint32_t w = freeWait_;
    if (w == kNone) {
      w = static_cast<std::uint32_t>(waits_.size());
      waits_.emplace_back();
    } else {
      freeWait_ = waits_[w].next;
    }
    waits_[w] = {corner.place, corner.age, std::exchange(waiting_[blocker], w)};
  }

  void cutEars() {
    while (left_ > 3 && !corners_.empty()) {
      const Corner corner = corners_.top();
      corners_.pop();
      if (corner.age != age_[corner.place]) continue;
      if (corner.rank == Rank::Nothing) {
        cutOff(corner.place);
        continue;
      }
      const Block block = blockOf(corner.place);
      if (block.by != kNone)
        waitFor(block.by, corner);
      else if (block.touched && corner.rank != Rank::Touching)
        push(corner.place, Rank::Touching);
      else
        cutOff(corner.place);
    }
  }

  /// A corner that keeps another one from being cut off, or else whether the diagonal touches one.
  struct Block {
    std::uint32_t by = kNone;
    bool touched = false;
  };
  Block blockOf(std::uint32_t i) const {
    const std::uint32_t a = before_[i], b = after_[i];
    const std::array<glm::vec2, 3> ear{flat_[a], flat_[i], flat_[b]};
    Block block;
    blockers_.anyNear(ear, [&](std::uint32_t other) {
      if (other == a || other == b) return false;
      std::array<int, 3> sides;
      for (std::size_t k = 0; k < 3; ++k) {
        sides[k] = orientation(ear[k], ear[(k + 1) % 3], flat_[other]);
        if (sides[k] < 0) return false;
      }
      if (enters(before_[other], ear, sides) || enters(after_[other], ear, sides)) block.by = other;
      block.touched = block.touched || sides[2] == 0;
      return block.by != kNone;
    });
    return block;
  }

  /// Does the way to that corner, from a point of the triangle, lead into its inside? `sides` are 0 for
  /// the triangle's sides that the point lies on.
  bool enters(std::uint32_t to, const std::array<glm::vec2, 3>& ear, const std::array<int, 3>& sides) const {
    for (std::size_t k = 0; k < 3; ++k)
      if (sides[k] == 0 && orientation(ear[k], ear[(k + 1) % 3], flat_[to]) <= 0) return false;
    return true;
  }

  void emit(std::uint32_t i) {
    const std::uint32_t a = before_[i], b = after_[i];
    triangles_.emplace_back(polygon_[a], polygon_[i], polygon_[b]);
    turned_ = turned_ || orientation(flat_[a], flat_[i], flat_[b]) < 0 ||
              (balanced_ && hasArea(triangles_.back(), points_));
  }

  void remove(std::uint32_t i) {
    emit(i);
    const std::uint32_t a = before_[i], b = after_[i];
    age_[i] = 0;
    after_[a] = b;
    before_[b] = a;
    first_ = a;
    --left_;
  }

  void cutOff(std::uint32_t i) {
    remove(i);
    blockers_.set(i, false);
    wake(i);
    if (left_ > 3) offer(before_[i]), offer(after_[i]);
  }

  /// The corners that are left, by their diagonals alone.
  void cutAnyhow() {
    const auto offerPlainly = [&](std::uint32_t i) { ++age_[i], push(i, Rank::Plain); };
    for (std::uint32_t i = first_, rest = left_; rest > 0; --rest, i = after_[i]) offerPlainly(i);
    while (left_ > 3) {
      const Corner corner = corners_.top();
      corners_.pop();
      if (corner.age != age_[corner.place]) continue;
      remove(corner.place);
      offerPlainly(before_[corner.place]), offerPlainly(after_[corner.place]);
    }
  }

  const std::vector<glm::vec3>& points_;
  std::span<const std::uint32_t> polygon_;
  std::vector<glm::uvec3>& triangles_;
  std::uint32_t count_, left_, first_ = 0;           // first_ is one of those that are left
  std::vector<std::uint32_t> before_, after_, age_;  // by corner; age 0: it is cut off
  std::vector<std::uint32_t> waiting_;               // by corner: the first that waits for it, in waits_
  std::vector<Waiting> waits_;
  std::uint32_t freeWait_ = kNone;
  double rounding_ = 0.0;
  bool balanced_ = false;  // as much of the polygon faces one way as the other
  std::vector<glm::vec2> flat_;
  PointTree blockers_;  // corners of half a turn or more
  std::priority_queue<Corner, std::vector<Corner>, std::greater<>> corners_;
  int retries_ = 16;
  bool turned_ = false;  // some triangle is
};

/// Four corners, cut along the shorter diagonal unless that leaves next to nothing of a triangle, or less; of
/// diagonals about as long along that with the first point by its coordinates.
bool cutQuad(const std::vector<glm::vec3>& points, std::span<const std::uint32_t> q,
             std::vector<glm::uvec3>& triangles) {
  std::array<glm::dvec3, 4> p;
  for (std::size_t k = 0; k < 4; ++k) p[k] = glm::dvec3(points[q[k]]);
  const glm::dvec3 normal = glm::cross(p[2] - p[0], p[3] - p[1]);
  // By a diagonal's first corner: the less of its triangles, seen along the normal.
  const auto least = [&](std::size_t k) {
    const glm::dvec3 diagonal = p[k + 2] - p[k];
    return std::min(glm::dot(normal, glm::cross(p[k + 1] - p[k], diagonal)),
                    glm::dot(normal, glm::cross(diagonal, p[(k + 3) % 4] - p[k])));
  };
  const std::array<double, 2> lengths{glm::distance(p[0], p[2]), glm::distance(p[1], p[3])},
      leasts{least(0), least(1)};
  const auto comesBefore = [](const glm::dvec3& a, const glm::dvec3& b) {
    return a.x != b.x ? a.x < b.x : a.y != b.y ? a.y < b.y : a.z < b.z;
  };
  constexpr double kAsLong = 1.0 + 1e-5, kNextToNothing = 1e-3;
  std::size_t k = std::ranges::min_element(p, comesBefore) - p.begin();
  k %= 2;
  if (lengths[k] > kAsLong * lengths[1 - k]) k = 1 - k;
  if (leasts[k] < kNextToNothing * leasts[1 - k]) k = 1 - k;
  triangles.emplace_back(q[k], q[k + 1], q[k + 2]);
  triangles.emplace_back(q[k], q[k + 2], q[(k + 3) % 4]);
  if (normal == glm::dvec3(0.0)) return !hasArea(triangles.back(), points);
  return !(leasts[k] < 0.0);
}

}  // namespace

bool cutPolygon(const std::vector<glm::vec3>& points, std::span<const std::uint32_t> polygon,
                std::vector<glm::uvec3>& triangles) {
  if (polygon.size() < 3) return true;
  if (polygon.size() == 4) return cutQuad(points, polygon, triangles);
  if (polygon.size() > 4) return PolygonCutter(points, polygon, triangles).cut();
  triangles.emplace_back(polygon[0], polygon[1], polygon[2]);
  return true;
}

}  // namespace sdf
