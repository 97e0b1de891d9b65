#include "offset_cases.h"

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <optional>
#include <random>
#include <sstream>

#include "operator_blends.h"
#include "sdf/eval/scalar_reading.h"
#include "sdf/shape/operators/operators.h"
#include "sdf/shape/solids/solids.h"

namespace sdf::accuracy {
namespace {

constexpr double kLittle = 0.05, kMuch = 0.25;  // of the smallest half size
constexpr int kLines = 120, kPairs = 150, kPlacesInBounds = 200, kStepsAlong = 24;
constexpr unsigned kSeed = 5;
// Lines that meet the expected surface at a glancing angle, and those that meet next to nothing but the other
// solid's, measure something else.
constexpr double kLeastMove = 0.005, kLeastSlope = 0.4, kAround = 0.15, kLeastShare = 0.1;

// Numbers that a scene file can give as they are.
double tidy(double v) { return std::round(1e4 * v) / 1e4; }
glm::dvec3 tidy(const glm::dvec3& v) { return {tidy(v.x), tidy(v.y), tidy(v.z)}; }

Vec3E vector(const glm::dvec3& v) { return Vec3E(v.x, v.y, v.z); }

template <class... Parts>
std::string joined(const Parts&... parts) {
  std::ostringstream text;
  text.precision(9);
  (text << ... << parts);
  return text.str();
}
std::string shown(const glm::dvec3& p) { return joined("(", p.x, ", ", p.y, ", ", p.z, ")"); }
std::string arguments(const glm::dvec3& p) { return joined(p.x, ", ", p.y, ", ", p.z); }

// The solid that others are joined with: its distance in closed form, too.
struct Other {
  std::string text;
  Shape shape;
  std::function<double(const glm::dvec3&)> distance;
};

Other ballAt(glm::dvec3 at, double radius) {
  return {joined("sphere(", radius, "):translate(", arguments(at), ")"),
          translate(sphere(radius), vector(at)),
          [=](const glm::dvec3& p) { return glm::distance(p, at) - radius; }};
}

Other ringAt(glm::dvec3 at, double major, double minor) {
  return {joined("torus(", major, ", ", minor, "):translate(", arguments(at), ")"),
          translate(torus(major, minor), vector(at)), [=](const glm::dvec3& p) {
            const glm::dvec3 q = p - at;
            return std::hypot(std::hypot(q.x, q.z) - major, q.y) - minor;
          }};
}

Other blockAt(glm::dvec3 at, glm::dvec3 half) {
  return {joined("box(", arguments(half), "):translate(", arguments(at), ")"),
          translate(box(vector(half)), vector(at)), [=](const glm::dvec3& p) {
            const glm::dvec3 q = glm::abs(p - at) - half;
            return glm::length(glm::max(q, 0.0)) + std::min(std::max({q.x, q.y, q.z}), 0.0);
          }};
}

double quadraticBound(double a, double b, double k) { return kSmooths[0].lower(a, b, k); }
double chamfered(double a, double b, double k) { return kSmooths[3].lower(a, b, k); }

void addRound(const DeformedSolid& s, double r, std::vector<OffsetCase>& cases) {
  cases.push_back({"round", joined(s.text(), ":round(", r, ")"), round(s.shape(), r), r,
                   [=](double d, const glm::dvec3&) { return d - r; }});
}

void addShell(const DeformedSolid& s, double r, std::vector<OffsetCase>& cases) {
  cases.push_back({"shell", joined(s.text(), ":shell(", 2.0 * r, ")"), shell(s.shape(), 2.0 * r), r,
                   [=](double d, const glm::dvec3&) { return std::abs(d) - r; }});
}

void addElongate(const DeformedSolid& s, double r, std::vector<OffsetCase>& cases) {
  const glm::dvec3 half(0.0, 0.25, 0.0);
  cases.push_back({"elongate", joined(s.text(), ":elongate(", "{", arguments(half), "}):round(", r, ")"),
                   round(elongate(s.shape(), vector(half)), r), r,
                   [=](double d, const glm::dvec3&) { return d - r; }, half});
}

void addJoins(const DeformedSolid& s, double k, std::vector<OffsetCase>& cases) {
  const glm::dvec3 at = tidy(s.roomiest().at);
  const Other ball = ballAt(at, tidy(0.5 * s.half())),
              ring = ringAt(at, tidy(0.5 * s.half()), tidy(0.25 * s.half()));
  cases.push_back({"smooth union", joined("union({", s.text(), ", ", ball.text, "}, ", k, ")"),
                   unite(s.shape(), ball.shape, Blend::quadratic(k)), k,
                   [=](double d, const glm::dvec3& p) { return quadraticBound(d, ball.distance(p), k); }});
  cases.push_back({"smooth union, torus", joined("union({", s.text(), ", ", ring.text, "}, ", k, ")"),
                   unite(s.shape(), ring.shape, Blend::quadratic(k)), k,
                   [=](double d, const glm::dvec3& p) { return quadraticBound(d, ring.distance(p), k); }});
  cases.push_back({"chamfer union", joined("union({", s.text(), ", ", ball.text, "}, ", k, ", \"chamfer\")"),
                   unite(s.shape(), ball.shape, Blend::chamfer(k)), k,
                   [=](double d, const glm::dvec3& p) { return chamfered(d, ball.distance(p), k); }});
  cases.push_back({"smooth difference", joined("difference({", s.text(), ", ", ball.text, "}, ", k, ")"),
                   subtract(s.shape(), ball.shape, Blend::quadratic(k)), k,
                   [=](double d, const glm::dvec3& p) { return -quadraticBound(-d, ball.distance(p), k); }});
}

void addCavity(const DeformedSolid& s, double r, std::vector<OffsetCase>& cases) {
  const Other block = blockAt(tidy(s.box().centre()), tidy(0.5 * s.box().size() + 2.0 * s.half()));
  cases.push_back({"difference of a rounded one", joined(block.text, " - ", s.text(), ":round(", r, ")"),
                   subtract(block.shape, round(s.shape(), r)), r,
                   [=](double d, const glm::dvec3& p) { return std::max(block.distance(p), r - d); }});
}

void addMorph(const DeformedSolid& s, double t, std::vector<OffsetCase>& cases) {
  const DeformedSolid::Sample& from = s.roomiest();
  const Other ball = ballAt(tidy(from.at - s.half() * from.normal), tidy(1.5 * s.half()));
  cases.push_back({"morph", joined("morph(", s.text(), ", ", ball.text, ", ", t, ")"),
                   morph(s.shape(), ball.shape, t), t * s.half(),
                   [=](double d, const glm::dvec3& p) { return (1.0 - t) * d + t * ball.distance(p); }});
}

using Reading = std::function<double(double)>;  // of the way along a line

// The first change of sign on the way from 0 to `most`, in steps; absent where there is none.
std::optional<double> crossing(const Reading& f, double most, int steps) {
  const bool inside = f(0.0) < 0.0;
  double before = 0.0;
  for (int i = 1; i <= steps; ++i) {
    double now = most * i / steps;
    if ((f(now) < 0.0) == inside) {
      before = now;
      continue;
    }
    for (int k = 0; k < 30; ++k) {
      const double middle = 0.5 * (before + now);
      ((f(middle) < 0.0) == inside ? before : now) = middle;
    }
    return 0.5 * (before + now);
  }
  return std::nullopt;
}

class Measurement {
 public:
  Measurement(const DeformedSolid& solid, const OffsetCase& c)
      : solid_(solid), case_(c), tape_(c.shape.distance), random_(kSeed) {}

  OffsetFigures take(double slack) {
    int lines = 0;
    for (const DeformedSolid::Sample& s : solid_.samples()) {
      if (lines >= kLines) break;
      if (s.room < 1.5 * case_.amount || !isPulledWhole(s)) continue;
      for (const double way : {1.0, -1.0}) lines += tryLine(s, way);
    }
    std::ranges::sort(found_.errors);
    for (int i = 0; i < kPairs; ++i) tryPair(solid_.samples()[i], i % 3 == 0);
    tryPlaces(slack);
    return std::move(found_);
  }

 private:
  // Where the surface has moved to as the solid was pulled apart.
  glm::dvec3 pulled(const glm::dvec3& p) const { return p + glm::sign(p) * case_.pulled; }
  // All of the line is on one side of the cuts.
  bool isPulledWhole(const DeformedSolid::Sample& s) const {
    for (int i = 0; i < 3; ++i)
      if (case_.pulled[i] > 0.0 && std::abs(s.at[i]) < s.room) return false;
    return true;
  }

  double value(const glm::dvec3& p) const { return evaluate(tape_, p); }

  bool tryLine(const DeformedSolid::Sample& s, double way) {
    const glm::dvec3 from = pulled(s.at), along = way * s.normal;
    const double clear = s.room / 1.5;
    const Reading truth = [&](double t) { return case_.truth(way * t, from + t * along); };
    const Reading library = [&](double t) { return value(from + t * along); };
    // Next to nothing moves there, as far from a junction.
    if (std::abs(truth(0.0)) < kLeastMove * case_.amount) return false;
    const std::optional<double> expected = crossing(truth, clear, kStepsAlong);
    if (!expected || !dependsOnDistance(from + *expected * along, way * *expected)) return false;
    const double around = kAround * case_.amount, sign = truth(0.0) < 0.0 ? 1.0 : -1.0;
    if (sign * truth(*expected + around) < kLeastSlope * around ||
        sign * truth(*expected - around) > -kLeastSlope * around)
      return false;
    const double scale = std::max(case_.amount, *expected), most = *expected + 3.0 * scale;
    const bool rightAtFirst = (library(0.0) < 0.0) == (truth(0.0) < 0.0);
    const std::optional<double> found =
        rightAtFirst ? crossing(library, most, 2 * kStepsAlong) : std::optional(0.0);
    const double error = std::abs(found.value_or(most) - *expected) / scale;
    if (found_.errors.empty() || error > *std::ranges::max_element(found_.errors))
      found_.worst = joined("from ", shown(from), " along ", shown(along), " the surface is at ", *expected,
                            ", found ", found ? "at " : "nowhere up to ", found.value_or(most));
    found_.errors.push_back(error);
    return true;
  }

  // The other solid's distance alone says nothing.
  bool dependsOnDistance(const glm::dvec3& p, double d) const {
    constexpr double kStep = 1e-6;
    return std::abs(case_.truth(d + kStep, p) - case_.truth(d - kStep, p)) > kLeastShare * 2.0 * kStep;
  }

  // Halves a segment along the surface or any way, keeping the steeper half: what is torn in it is closed in
  // upon.
  void tryPair(const DeformedSolid::Sample& s, bool across) {
    std::uniform_real_distribution<> share(-1.0, 1.0);
    const double shortest = 1e-4 * solid_.size();
    const glm::dvec3 any(share(random_), share(random_), share(random_));
    const glm::dvec3 aside = glm::normalize(across ? any : glm::cross(s.normal, any));
    glm::dvec3 a = pulled(s.at) + 1.5 * case_.amount * share(random_) * s.normal;
    glm::dvec3 b = a + 0.3 * solid_.half() * aside;
    double atA = value(a), atB = value(b);
    for (double step = glm::distance(a, b); step > 0.5 * shortest; step *= 0.5) {
      const double slope = std::abs(atA - atB) / step;
      if (slope > found_.steepest) {
        found_.steepest = slope;
        found_.steep = joined("from ", atA, " at ", shown(a), " to ", atB, " at ", shown(b));
      }
      const glm::dvec3 middle = 0.5 * (a + b);
      const double atMiddle = value(middle);
      if (std::abs(atA - atMiddle) >= std::abs(atB - atMiddle))
        b = middle, atB = atMiddle;
      else
        a = middle, atA = atMiddle;
    }
  }

  void tryPlaces(double slack) {
    for (const DeformedSolid::Place& place : solid_.places()) tryPlace(pulled(place.at), place, slack);
    const Box& b = case_.shape.bounds;
    if (!b.finite()) return;
    for (int i = 0; i < kPlacesInBounds; ++i) {
      glm::dvec3 p;
      for (int k = 0; k < 3; ++k) p[k] = std::uniform_real_distribution<>(b.min[k], b.max[k])(random_);
      tryPlace(p, solid_.place(p - glm::clamp(p, -case_.pulled, case_.pulled)), slack);
    }
  }

  // The least share of the true distance that a first-order distance has. Let A be the inverse of the
  // map's Jacobian: from a point v off the source's edge, value over slope is |v|^2 / |A^T v|, and the true
  // distance at most |A^-1 v|. Of singular values that differ by the factor u, |v|^2 is at least
  // 2u / (u^2 + 1) times that product (Wielandt's inequality).
  double leastAtEdges() const {
    const double u = solid_.unevenness();
    return 2.0 * u / (u * u + 1.0);
  }

  void tryPlace(const glm::dvec3& p, const DeformedSolid::Place& place, double slack) {
    // The nearest point of the surface is within 1.5 amounts of an edge.
    const bool atEdge =
        place.toEdge * place.toEdge < place.distance * place.distance + 2.25 * case_.amount * case_.amount;
    const double d = place.distance, chord = solid_.chord();
    const double far = d / (1.0 - slack),
                 near = d * std::min(1.0 / (1.0 + slack), atEdge ? leastAtEdges() : 1.0);
    const double most = std::max(far, near) + chord, least = std::min(far, near) - chord;
    const double a = case_.truth(most, p), b = case_.truth(least, p), f = value(p);
    const Box& bounds = case_.shape.bounds;
    const bool outOfBounds = f <= 0.0 && !bounds.contains(Box{p, p});
    const bool missing = std::max(a, b) < 0.0 && !(f < 0.0), stray = std::min(a, b) > 0.0 && !(f > 0.0);
    if (!outOfBounds && !missing && !stray) return;
    if (found_.strays++ == 0)
      found_.stray = joined("at ", shown(p), " f = ", f, ", expected ", case_.truth(d, p),
                            outOfBounds ? ", which is out of bounds" : "");
  }

  const DeformedSolid& solid_;
  const OffsetCase& case_;
  Tape tape_;
  std::mt19937 random_;
  OffsetFigures found_;
};

}  // namespace

std::vector<OffsetCase> offsetCases(const DeformedSolid& s) {
  std::vector<OffsetCase> cases;
  for (const double share : {kLittle, kMuch}) {
    const double amount = tidy(share * s.half());
    addRound(s, amount, cases);
    addShell(s, amount, cases);
    addElongate(s, amount, cases);
    addJoins(s, amount, cases);
    addCavity(s, amount, cases);
    addMorph(s, share, cases);
  }
  return cases;
}

void OffsetFigures::add(const OffsetFigures& more) {
  if (errors.empty() || (!more.errors.empty() && more.errors.back() > errors.back())) worst = more.worst;
  errors.insert(errors.end(), more.errors.begin(), more.errors.end());
  std::ranges::sort(errors);
  if (strays == 0) stray = more.stray;
  strays += more.strays;
  if (more.steepest > steepest) steep = more.steep;
  steepest = std::max(steepest, more.steepest);
}

double OffsetFigures::share(double part) const {
  if (errors.empty()) return kInfinity;
  return errors[static_cast<std::size_t>(std::ceil(part * (errors.size() - 1)))];
}

OffsetFigures measured(const DeformedSolid& solid, const OffsetCase& c, double slack) {
  return Measurement(solid, c).take(slack);
}

std::vector<OffsetRow> offsetRows(const Deformation& deformation, std::size_t parts) {
  std::vector<OffsetRow> rows;
  for (std::size_t i = 0; i < std::min(parts, deformedParts().size()); ++i) {
    const Part part = deformedParts()[i].make();
    const DeformedSolid solid(part, deformation.of(part), kOffsetSeed);
    for (const OffsetCase& c : offsetCases(solid)) {
      auto row = std::ranges::find(rows, c.name, &OffsetRow::name);
      if (row == rows.end()) row = rows.insert(rows.end(), {deformation.name, c.name, {}});
      row->found.add(measured(solid, c, kOffsetSlack));
    }
  }
  return rows;
}

}  // namespace sdf::accuracy
