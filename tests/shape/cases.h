// The shapes that the claim tests run over: every solid and flat entry at its defaults and at other
// arguments, some of them extreme.
#pragma once
#include <glm/geometric.hpp>
#include <map>
#include <ostream>
#include <random>
#include <string>
#include <vector>

#include "sdf/shape/catalog.h"
#include "support/evaluate.h"

namespace sdf::test {

struct ShapeCase {
  std::string name;
  Shape shape;
};
inline void PrintTo(const ShapeCase& c, std::ostream* out) { *out << c.name; }

inline Argument number(double v) { return Expr(v); }
inline Argument vector(double x, double y, double z = 0.0) { return Vec3E{x, y, z}; }

/// Arguments beyond the defaults, by entry.
inline const std::map<std::string, std::vector<std::vector<Argument>>>& otherArguments() {
  using Points = std::vector<glm::dvec2>;
  const Points square{{0, 0}, {1, 0}, {1, 1}, {0, 1}};
  const Points comb{{0, 0}, {3, 0}, {3, 2}, {2, 2}, {2, 1}, {1.5, 0.2}, {1, 1}, {1, 2}, {0, 2}};
  const Points clockwise{{0, 0}, {0.3, 1.2}, {0.15, 0.4}, {1, 1}, {1, 0}, {0.5, 0.1}};
  const Points collinear{{0, 0}, {1, 0}, {2, 0}, {2, 1}, {1, 1}, {0, 1}, {0, 0}};
  static const std::map<std::string, std::vector<std::vector<Argument>>> table{
      {"sphere", {{number(0.01)}, {number(40)}}},
      {"ellipsoid",
       {{vector(1, 1, 1)},
        {vector(0.05, 1, 0.05)},
        {vector(1, 0.03, 1)},
        {vector(0.01, 0.5, 1)},
        {vector(1, 0.7, 0.7001)}}},
      {"ellipsoid_bound", {{vector(0.05, 1, 0.05)}, {vector(2, 0.1, 1)}}},
      {"torus", {{number(0.5), number(0.8)}, {number(2), number(0.01)}, {number(1), number(1)}}},
      {"capped_torus",
       {{number(30), number(1), number(0.2)},
        {number(180), number(1), number(0.3)},
        {number(170), number(1), number(0.3)},
        {number(90), number(0.4), number(0.5)}}},
      {"link", {{number(0), number(1), number(0.2)}, {number(2), number(0.3), number(0.4)}}},
      {"capsule",
       {{vector(1, 2, 3), vector(-1, 0, 0.5), number(0.2)},
        {vector(1, 1, 1), vector(1, 1, 1), number(0.5)},
        {vector(-1, 0, 0), vector(1, 0, 0), number(3)}}},
      {"spring",
       {{number(0.5), number(3), number(1.5), number(0.2), 0},
        {number(1), number(0.05), number(2), number(0.01), 1},
        {number(1), number(0.15), number(2), number(0.1), 0}}},
      {"solid_angle",
       {{number(90), number(1)},
        {number(140), number(0.7)},
        {number(10), number(2)},
        {number(178), number(1)}}},
      {"cut_sphere", {{number(1), number(0.9)}, {number(1), number(-0.6)}, {number(3), number(-2.95)}}},
      {"box", {{vector(0.01, 2, 0.5)}, {vector(5, 5, 0.1)}}},
      {"round_box", {{vector(1, 2, 0.5), number(0)}, {vector(1, 1, 0.4), number(0.4)}}},
      {"box_frame", {{vector(1, 2, 0.5), number(0.5)}, {vector(1, 0.6, 2), number(0.02)}}},
      {"plane", {{vector(1, 2, -3), number(0.5)}, {vector(-4, 0, 0), number(-1)}}},
      {"octahedron", {{number(0.1)}, {number(7)}}},
      {"tetrahedron", {{number(0.1)}, {number(7)}}},
      {"pyramid", {{number(2), number(0.1)}, {number(0.1), number(2)}}},
      {"cylinder", {{number(0.1), number(3)}, {number(3), number(0.1)}}},
      {"infinite_cylinder", {{number(0.1)}, {number(3)}}},
      {"cone", {{number(0.1), number(3)}, {number(3), number(0.1)}}},
      {"capped_cone",
       {{number(0.2), number(1.5), number(0.3)},
        {number(0), number(1), number(1)},
        {number(1), number(1), number(0.5)}}},
      {"round_cone",
       {{number(0.1), number(0.5), number(0.25)},
        {number(1), number(0.05), number(0.48)},
        {number(1), number(1), number(1)}}},
      {"hex_prism", {{number(0.2), number(2)}, {number(3), number(0.05)}}},
      {"tri_prism", {{number(0.2), number(2)}, {number(3), number(0.05)}}},
      {"thread",
       {{number(3), number(0.5), number(2), 3, number(0.05), 1},
        {number(0.8), number(0.125), number(0.3), 1, number(-0.02), 0}}},
      {"strut_lattice",
       {{1, number(2), number(0.2)},
        {2, number(2), number(0.05)},
        {3, number(2), number(0.1)},
        {0, number(2), number(0.6)}}},
      {"gyroid", {{number(0.3), number(0.01)}, {number(5), number(1.2)}}},
      {"schwarz_p", {{number(0.3), number(0.01)}, {number(5), number(1.2)}}},
      {"schwarz_d", {{number(2), number(0.05)}, {number(5), number(1.2)}}},
      {"iwp", {{number(2), number(0.3)}, {number(5), number(1.2)}}},
      {"neovius", {{number(2), number(0.5)}, {number(5), number(1.2)}}},
      {"lidinoid", {{number(2), number(0.2)}, {number(5), number(0.8)}}},
      {"fischer_koch_s", {{number(2), number(0.25)}, {number(5), number(0.9)}}},
      {"circle", {{number(0.01)}, {number(40)}}},
      {"ellipse", {{vector(0.02, 1)}, {vector(2, 2)}, {vector(3, 2.9)}}},
      {"ring", {{number(1), number(1.9)}, {number(3), number(0.01)}}},
      {"arc",
       {{number(30), number(1), number(0.4)},
        {number(180), number(1), number(0.3)},
        {number(170), number(1), number(0.6)}}},
      {"rectangle", {{vector(0.01, 2)}, {vector(5, 5)}}},
      {"rounded_rectangle", {{vector(1, 2), number(0)}, {vector(1, 0.4), number(0.4)}}},
      {"trapezoid",
       {{number(0.2), number(1.5), number(0.3)},
        {number(0), number(1), number(1)},
        {number(1), number(0), number(0.05)}}},
      {"segment", {{vector(1, 2), vector(-1, 0), number(0.2)}, {vector(1, 1), vector(1, 1), number(0.5)}}},
      {"regular_polygon",
       {{3, number(1)}, {4, number(2)}, {5, number(0.3)}, {7, number(1)}, {12, number(1)}, {101, number(4)}}},
      {"polygon", {{square}, {comb}, {clockwise}, {collinear}}},
      {"star",
       {{3, number(1), number(0.2)},
        {4, number(2), number(0.1)},
        {6, number(1), number(0.95)},
        {9, number(1), number(0.6)}}},
  };
  return table;
}

/// The numbers in a default such as "{1, 0.5}".
inline std::vector<double> numbersIn(const std::string& text) {
  std::vector<double> numbers;
  for (std::size_t at = text.find_first_of("-.0123456789"); at != std::string::npos;
       at = text.find_first_of("-.0123456789", at)) {
    std::size_t used = 0;
    numbers.push_back(std::stod(text.substr(at), &used));
    at += used;
  }
  return numbers;
}

inline bool isPrimitive(const CatalogEntry& e) { return e.group == Group::Solid || e.group == Group::Flat; }

inline std::vector<ShapeCase> primitiveCases() {
  std::vector<ShapeCase> cases;
  for (const CatalogEntry& e : catalog()) {
    if (!isPrimitive(e)) continue;
    cases.push_back({e.name, build(e, {})});
    const auto others = otherArguments().find(e.name);
    if (others == otherArguments().end()) continue;
    for (std::size_t i = 0; i < others->second.size(); ++i)
      cases.push_back({e.name + " #" + std::to_string(i + 1), build(e, others->second[i])});
  }
  return cases;
}

/// Where a shape is sampled: its bounds with as much again on every side; 3 units where it has none.
inline Box sampleRegion(const Shape& s) {
  constexpr double kUnbounded = 3.0;
  Box region = s.bounds;
  for (int i = 0; i < 3; ++i) {
    if (region.min[i] == -kInfinity) region.min[i] = std::min(-kUnbounded, region.max[i] - kUnbounded);
    if (region.max[i] == kInfinity) region.max[i] = std::max(kUnbounded, region.min[i] + kUnbounded);
  }
  return region.grown(0.5 * region.longestSide());
}

/// Points in a box, by seed. One in four has a coordinate or two at 0, where symmetric shapes have their
/// creases.
class Sampler {
 public:
  Sampler(const Box& region, unsigned seed) : region_(region), random_(seed) {}

  glm::dvec3 anywhere() {
    const glm::dvec3 t{unit_(random_), unit_(random_), unit_(random_)};
    return region_.min + t * (region_.max - region_.min);
  }
  glm::dvec3 orOnAnAxis() {
    glm::dvec3 p = anywhere();
    for (int i = 0; i < 3; ++i)
      if (unit_(random_) < 0.1) p[i] = 0.0;
    return p;
  }
  /// A point up to `reach` away.
  glm::dvec3 near(const glm::dvec3& p, double reach) {
    const glm::dvec3 t{unit_(random_), unit_(random_), unit_(random_)};
    return p + (2.0 * t - 1.0) * (reach / std::sqrt(3.0));
  }
  double uniform() { return unit_(random_); }

 private:
  Box region_;
  std::mt19937 random_;
  std::uniform_real_distribution<double> unit_{0.0, 1.0};
};

inline std::string text(const glm::dvec3& p) {
  return "(" + std::to_string(p.x) + ", " + std::to_string(p.y) + ", " + std::to_string(p.z) + ")";
}

}  // namespace sdf::test
