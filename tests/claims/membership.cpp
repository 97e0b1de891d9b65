// What the operators mean for sets of points, written without the library.
#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <map>
#include <memory>
#include <numbers>

#include "claims/tree.h"
#include "sdf/eval/scalar_reading.h"

namespace sdf::test {

namespace {

using Known = std::optional<bool>;
using Meaning = Membership (*)(const Tree&);
constexpr double kDegree = std::numbers::pi / 180.0;

Known negated(Known a) { return a ? Known(!*a) : a; }
Known either(Known a, Known b) {
  if ((a && *a) || (b && *b)) return true;
  return a && b ? Known(false) : std::nullopt;
}
Known both(Known a, Known b) { return negated(either(negated(a), negated(b))); }
Known differ(Known a, Known b) { return a && b ? Known(*a != *b) : std::nullopt; }

double number(const Tree& t, int i) { return std::get<double>(t.terms[i]); }
glm::dvec3 vector(const Tree& t, int i) { return std::get<glm::dvec3>(t.terms[i]); }
bool given(const Tree& t, int i) { return t.terms[i].index() != 0; }
const Tree& operand(const Tree& t) { return std::get<std::vector<Tree>>(t.terms[0]).front(); }

glm::dvec3 turned(const glm::dvec3& p, int axis, double angle) {
  const int u = (axis + 1) % 3, v = (axis + 2) % 3;
  const double c = std::cos(angle), s = std::sin(angle);
  glm::dvec3 q = p;
  q[u] = c * p[u] - s * p[v];
  q[v] = s * p[u] + c * p[v];
  return q;
}

// The sign of the call's own distance, but for where a step of this share of the coordinates may change it:
// far above the rounding of coordinates, far below what sampling would miss.
Membership itself(const Tree& t) {
  constexpr double kUndecided = 1e-9;
  const double unsure = kUndecided + exactnessOf(t);
  return [tape = std::make_shared<const Tape>(shapeOf(t).distance), unsure](const glm::dvec3& p) -> Known {
    const double f = evaluate(*tape, p);
    return std::abs(f) <= unsure * std::max(1.0, glm::length(p)) ? Known() : Known(f < 0.0);
  };
}

// The operand, looked up where `back` says.
template <class Back>
Membership lookedUp(const Tree& t, Back back) {
  return [inside = membershipOf(operand(t)), back](const glm::dvec3& p) { return inside(back(p)); };
}

template <Known (*kJoin)(Known, Known)>
Membership joined(const Tree& t) {
  if (given(t, 1)) return itself(t);  // smooth
  std::vector<Membership> all;
  for (const Tree& o : std::get<std::vector<Tree>>(t.terms[0])) all.push_back(membershipOf(o));
  return [all](const glm::dvec3& p) {
    Known inside = all[0](p);
    for (std::size_t i = 1; i < all.size(); ++i) inside = kJoin(inside, all[i](p));
    return inside;
  };
}

Known without(Known a, Known b) { return both(a, negated(b)); }

Membership elongated(const Tree& t) {
  return lookedUp(t, [h = vector(t, 1)](const glm::dvec3& p) { return p - glm::clamp(p, -h, h); });
}
Membership extruded(const Tree& t) {
  return [inside = membershipOf(operand(t)), h = number(t, 1)](const glm::dvec3& p) {
    return both(inside(p), std::abs(p.z) <= h);
  };
}
Membership revolved(const Tree& t) {
  const double offset = given(t, 1) ? number(t, 1) : 0.0;
  const double half = given(t, 2) ? 0.5 * number(t, 2) * kDegree : std::numbers::pi;
  const Membership whole = lookedUp(
      t, [offset](const glm::dvec3& p) { return glm::dvec3(std::hypot(p.x, p.z) - offset, p.y, 0.0); });
  return
      [whole, half](const glm::dvec3& p) { return both(whole(p), std::abs(std::atan2(p.z, p.x)) <= half); };
}
Membership twisted(const Tree& t) {
  return lookedUp(t,
                  [rate = number(t, 1) * kDegree](const glm::dvec3& p) { return turned(p, 1, -rate * p.y); });
}
Membership bent(const Tree& t) {
  const double k = number(t, 1) * kDegree;
  if (k == 0.0) return membershipOf(operand(t));
  return lookedUp(t, [k](const glm::dvec3& p) {
    const double up = 1.0 / k - p.y;
    return glm::dvec3(std::atan2(p.x * k, up * k) / k, 1.0 / k - std::copysign(std::hypot(p.x, up), k), p.z);
  });
}
Membership tapered(const Tree& t) {
  return [inside = membershipOf(operand(t)), rate = number(t, 1)](const glm::dvec3& p) {
    const double factor = 1.0 + rate * p.y;
    return factor > 0.0 ? inside({p.x / factor, p.y, p.z / factor}) : Known(false);
  };
}
Membership translated(const Tree& t) {
  return lookedUp(t, [by = vector(t, 1)](const glm::dvec3& p) { return p - by; });
}
Membership rotated(const Tree& t) {
  return lookedUp(t, [a = vector(t, 1) * kDegree](const glm::dvec3& p) {
    return turned(turned(turned(p, 2, -a.z), 1, -a.y), 0, -a.x);
  });
}
Membership rotatedAbout(const Tree& t) {
  return lookedUp(t, [n = glm::normalize(vector(t, 1)), a = -number(t, 2) * kDegree](const glm::dvec3& p) {
    return p * std::cos(a) + glm::cross(n, p) * std::sin(a) + n * (glm::dot(n, p) * (1.0 - std::cos(a)));
  });
}
Membership scaled(const Tree& t) {
  const glm::dvec3 by = vector(t, 1);
  const bool flat = shapeOf(operand(t)).dimension == 2;
  return lookedUp(t, [by, flat](const glm::dvec3& p) {
    return glm::dvec3(p.x / by.x, p.y / by.y, flat ? p.z : p.z / by.z);
  });
}
Membership mirrored(const Tree& t) {
  glm::dvec3 n(0.0);
  n[given(t, 1) ? std::get<int>(t.terms[1]) : 0] = 1.0;
  if (given(t, 2)) n = glm::normalize(vector(t, 2));
  return [inside = membershipOf(operand(t)), n](const glm::dvec3& p) {
    return either(inside(p), inside(p - n * (2.0 * glm::dot(n, p))));
  };
}
Membership polarRepeated(const Tree& t) {
  return [inside = membershipOf(operand(t)), count = std::get<int>(t.terms[1])](const glm::dvec3& p) {
    Known any = false;
    for (int i = 0; i < count; ++i)
      any = either(any, inside(turned(p, 1, 2.0 * std::numbers::pi * i / count)));
    return any;
  };
}

// The places along one axis at which a copy may hold the coordinate x.
struct Places {
  double cell;
  std::optional<double> count;  // none: endless
  double lo, hi;                // of the shape

  std::vector<double> at(double x) const {
    if (cell == 0.0 || count == 1.0) return {0.0};
    const double first = count ? -0.5 * (*count - 1.0) : std::floor((x - hi) / cell);
    const double last = count ? -first : std::ceil((x - lo) / cell);
    std::vector<double> places;
    for (double i = first; i <= last; ++i) places.push_back(i * cell);
    return places;
  }
};

Membership gridRepeated(const Tree& t) {
  const Shape shape = shapeOf(operand(t));
  std::vector<Places> axes;
  for (int i = 0; i < 3; ++i) {
    const std::optional<double> count = given(t, 2) ? std::optional(vector(t, 2)[i]) : std::nullopt;
    const double cell = i < shape.dimension ? vector(t, 1)[i] : 0.0;
    axes.push_back({cell, count, shape.bounds.min[i], shape.bounds.max[i]});
  }
  return [inside = membershipOf(operand(t)), axes](const glm::dvec3& p) {
    Known any = false;
    for (const double x : axes[0].at(p.x))
      for (const double y : axes[1].at(p.y))
        for (const double z : axes[2].at(p.z)) any = either(any, inside(p - glm::dvec3(x, y, z)));
    return any;
  };
}

const std::map<std::string, Meaning>& meanings() {
  static const std::map<std::string, Meaning> table{{"union", joined<either>},
                                                    {"intersection", joined<both>},
                                                    {"difference", joined<without>},
                                                    {"xor", joined<differ>},
                                                    {"elongate", elongated},
                                                    {"extrude", extruded},
                                                    {"revolve", revolved},
                                                    {"twist", twisted},
                                                    {"bend", bent},
                                                    {"taper", tapered},
                                                    {"translate", translated},
                                                    {"rotate", rotated},
                                                    {"rotate_about", rotatedAbout},
                                                    {"scale", scaled},
                                                    {"mirror", mirrored},
                                                    {"polar_repeat", polarRepeated},
                                                    {"repeat_grid", gridRepeated}};
  return table;
}

}  // namespace

Membership membershipOf(const Tree& tree) {
  const auto meaning = meanings().find(tree.entry->name);
  return meaning == meanings().end() ? itself(tree) : meaning->second(tree);
}

}  // namespace sdf::test
