// Payloads to hold the readings to: samples on a grid, which answers all by itself, and the distance to the
// nearest of some points, which leaves the batch readings to the defaults.
#pragma once
#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>
#include <glm/geometric.hpp>
#include <memory>
#include <numbers>
#include <ostream>
#include <string>
#include <utility>
#include <vector>

#include "sdf/expr/expr.h"
#include "sdf/expr/lattice_noise.h"
#include "sdf/expr/payload.h"
#include "sdf/shape/solids/polygon_field.h"

namespace sdf::test {

inline std::string glslNumber(double v) {
  char text[40];
  std::snprintf(text, sizeof text, "float(%.9g)", v);
  return text;
}
inline std::string glslArray(const std::string& type, const std::string& name,
                             const std::vector<std::string>& all) {
  const std::string kind = type + "[" + std::to_string(all.size()) + "]";
  std::string text = "const " + kind + " " + name + " = " + kind + "(";
  for (const std::string& s : all) text += (&s == all.data() ? "" : ", ") + s;
  return text + ");\n";
}

// What rounding of intervals' ends in double may lose.
inline Interval withSlack(double lo, double hi, bool nan) {
  const auto by = [](double x) { return std::isfinite(x) ? 1e-12 * (1.0 + std::abs(x)) : 0.0; };
  return {lo - by(lo), hi + by(hi), nan};
}

/// n³ samples of a function over the cube [-half, half]³, interpolated along the axes; beyond the cube the
/// value is that of the nearest point of it. (n - 1) / half should be a power of two.
class Grid : public Payload {
 public:
  template <class F>
  Grid(int n, double half, F f) : n_(n), half_(half), perUnit_((n - 1) / (2.0 * half)) {
    const auto at = [&](int i) { return i / perUnit_ - half_; };
    for (int k = 0; k < n; ++k)
      for (int j = 0; j < n; ++j)
        for (int i = 0; i < n; ++i)
          samples_.push_back(static_cast<float>(f(glm::dvec3(at(i), at(j), at(k)))));
    for (const float s : samples_) largest_ = std::max(largest_, std::abs(static_cast<double>(s)));
    for (int k = 0; k + 1 < n; ++k)
      for (int j = 0; j + 1 < n; ++j)
        for (int i = 0; i + 1 < n; ++i) slope_ = std::max(slope_, steepest({i, j, k}));
    slope_ *= 1.0 + 1e-12;
  }

  double value(const glm::dvec3& p) const override { return read<double>({p.x, p.y, p.z})[0]; }
  ValueAndGradient gradient(const glm::dvec3& p) const override {
    const auto f = read<double>({p.x, p.y, p.z});
    return {f[0], {f[1], f[2], f[3]}};
  }
  Interval range(const std::array<Interval, 3>& box) const override {
    std::array<int, 3> first{}, last{};
    glm::dvec3 lo, hi;
    for (int k = 0; k < 3; ++k) {
      lo[k] = std::clamp(box[k].lo, -half_, half_), hi[k] = std::clamp(box[k].hi, -half_, half_);
      first[k] = cellOf((lo[k] + half_) * perUnit_), last[k] = cellOf((hi[k] + half_) * perUnit_) + 1;
    }
    double least = HUGE_VAL, most = -HUGE_VAL;
    for (int k = first[2]; k <= last[2]; ++k)
      for (int j = first[1]; j <= last[1]; ++j)
        for (int i = first[0]; i <= last[0]; ++i) {
          least = std::min<double>(least, sampleAt({i, j, k}));
          most = std::max<double>(most, sampleAt({i, j, k}));
        }
    const double middle = value(0.5 * (lo + hi)), reach = slope_ * 0.5 * glm::length(hi - lo);
    return withSlack(std::max(least, middle - reach), std::min(most, middle + reach),
                     box[0].nan || box[1].nan || box[2].nan);
  }
  double lipschitz() const override { return slope_; }

  double rounding(const glm::dvec3&) const override { return 0x1p-19 * (largest_ + slope_ * half_); }
  void values(const PayloadRows& p, std::size_t count, float* out) const override {
    for (std::size_t i = 0; i < count; ++i) out[i] = read<float>({p[0][i], p[1][i], p[2][i]})[0];
  }
  void gradients(const PayloadRows& p, std::size_t count, const std::array<float*, 4>& out) const override {
    for (std::size_t i = 0; i < count; ++i) {
      const auto f = read<float>({p[0][i], p[1][i], p[2][i]});
      for (int k = 0; k < 4; ++k) out[k][i] = f[k];
    }
  }
  std::string glsl(const std::string& name) const override {
    std::vector<std::string> numbers;
    for (const float s : samples_) numbers.push_back(glslNumber(s));
    std::string text = R"(vec4 NAMERead(vec3 p) {
  vec3 q = (p + HALF) * UNIT, c = clamp(q, 0.0, LAST), cell = min(floor(c), LAST - 1.0), t = c - cell;
  vec3 moves = vec3(greaterThanEqual(q, vec3(0.0))) * vec3(lessThanEqual(q, vec3(LAST))) * UNIT;
  vec4 sum = vec4(0.0);
  for (int i = 0; i < 8; ++i) {
    ivec3 side = ivec3(i & 1, (i >> 1) & 1, i >> 2), at = ivec3(cell) + side;
    vec3 w = mix(1.0 - t, t, vec3(side)), d = (2.0 * vec3(side) - 1.0) * moves;
    sum += NAMESamples[(at.z * COUNT + at.y) * COUNT + at.x] *
           vec4(w.x * w.y * w.z, d.x * w.y * w.z, w.x * d.y * w.z, w.x * w.y * d.z);
  }
  return sum;
}
float NAME(vec3 p) { return NAMERead(p).x; }
vec3 NAMESlopes(vec3 p) { return NAMERead(p).yzw; }
)";
    for (const auto& [word, with] : {std::pair<std::string, std::string>{"NAME", name},
                                     {"HALF", glslNumber(half_)},
                                     {"UNIT", glslNumber(perUnit_)},
                                     {"LAST", glslNumber(n_ - 1)},
                                     {"COUNT", std::to_string(n_)}})
      for (std::size_t at; (at = text.find(word)) != std::string::npos;) text.replace(at, word.size(), with);
    return glslArray("float", name + "Samples", numbers) + text;
  }

  /// Half a side of a cell.
  double halfCell() const { return 0.5 / perUnit_; }

 private:
  using Index = std::array<int, 3>;

  float sampleAt(const Index& i) const { return samples_[(i[2] * n_ + i[1]) * n_ + i[0]]; }
  int cellOf(double q) const { return std::clamp(static_cast<int>(q), 0, n_ - 2); }
  double steepest(const Index& cell) const {
    glm::dvec3 most(0.0);
    for (int k = 0; k < 3; ++k)
      for (int i = 0; i < 4; ++i) {
        Index a = cell, b;
        a[(k + 1) % 3] += i & 1, a[(k + 2) % 3] += i >> 1;
        b = a, ++b[k];
        most[k] = std::max(most[k], std::abs(static_cast<double>(sampleAt(b)) - sampleAt(a)) * perUnit_);
      }
    return glm::length(most);
  }

  template <class R>
  std::array<R, 4> read(const std::array<R, 3>& p) const {
    Index cell{};
    R weights[3][2], slopes[3][2];
    for (int k = 0; k < 3; ++k) {
      if (std::isnan(p[k])) return {R(NAN), R(NAN), R(NAN), R(NAN)};
      const R q = (p[k] + static_cast<R>(half_)) * static_cast<R>(perUnit_), last = static_cast<R>(n_ - 1);
      const R c = std::clamp(q, R(0), last);
      cell[k] = cellOf(c);
      weights[k][1] = c - static_cast<R>(cell[k]), weights[k][0] = R(1) - weights[k][1];
      slopes[k][1] = q == c ? static_cast<R>(perUnit_) : R(0), slopes[k][0] = -slopes[k][1];
    }
    std::array<R, 4> sum{};
    for (int i = 0; i < 8; ++i) {
      const int x = i & 1, y = (i >> 1) & 1, z = i >> 2;
      const R s = sampleAt({cell[0] + x, cell[1] + y, cell[2] + z});
      sum[0] += s * weights[0][x] * weights[1][y] * weights[2][z];
      sum[1] += s * slopes[0][x] * weights[1][y] * weights[2][z];
      sum[2] += s * weights[0][x] * slopes[1][y] * weights[2][z];
      sum[3] += s * weights[0][x] * weights[1][y] * slopes[2][z];
    }
    return sum;
  }

  int n_;
  double half_, perUnit_;
  std::vector<float> samples_;
  double largest_ = 0.0, slope_ = 0.0;
};

/// The distance to the nearest of some points less a radius: a union of balls, exact outside.
class Points : public Payload {
 public:
  Points(std::vector<glm::dvec3> points, double radius) : points_(std::move(points)), radius_(radius) {}

  double value(const glm::dvec3& p) const override { return gradient(p).value; }
  ValueAndGradient gradient(const glm::dvec3& p) const override {
    double least = HUGE_VAL;
    glm::dvec3 way(0.0);
    for (const glm::dvec3& c : points_)
      if (const double d = glm::length(p - c); !(d >= least)) least = d, way = p - c;
    return {least - radius_, least == 0.0 ? glm::dvec3(0.0) : way / least};
  }
  Interval range(const std::array<Interval, 3>& box) const override {
    double least = HUGE_VAL, most = HUGE_VAL;
    for (const glm::dvec3& c : points_) {
      glm::dvec3 near, far;
      for (int k = 0; k < 3; ++k) {
        near[k] = std::max({0.0, box[k].lo - c[k], c[k] - box[k].hi});
        far[k] = std::max(std::abs(box[k].lo - c[k]), std::abs(box[k].hi - c[k]));
      }
      least = std::min(least, glm::length(near)), most = std::min(most, glm::length(far));
    }
    return withSlack(least - radius_, most - radius_, box[0].nan || box[1].nan || box[2].nan);
  }
  double lipschitz() const override { return 1.0; }

  double rounding(const glm::dvec3& p) const override {
    double size = radius_ + glm::length(p);
    for (const glm::dvec3& c : points_) size = std::max(size, radius_ + glm::length(p) + glm::length(c));
    return 0x1p-21 * size;
  }
  std::string glsl(const std::string& name) const override {
    std::vector<std::string> places;
    for (const glm::dvec3& c : points_)
      places.push_back("vec3(" + glslNumber(c.x) + ", " + glslNumber(c.y) + ", " + glslNumber(c.z) + ")");
    const std::string array = name + "Places";
    return glslArray("vec3", array, places) + "vec3 " + name + "Nearest(vec3 p) {\n  vec3 way = p - " +
           array + "[0];\n  for (int i = 1; i < " + std::to_string(points_.size()) +
           "; ++i)\n    if (length(p - " + array + "[i]) < length(way)) way = p - " + array +
           "[i];\n  return way;\n}\nfloat " + name + "(vec3 p) { return length(" + name + "Nearest(p)) - " +
           glslNumber(radius_) + "; }\nvec3 " + name + "Slopes(vec3 p) { return normalize(" + name +
           "Nearest(p)); }\n";
  }

  const std::vector<glm::dvec3>& points() const { return points_; }
  double radius() const { return radius_; }

 private:
  std::vector<glm::dvec3> points_;
  double radius_;
};

/// A field with creases and bends: a ball with a plane's cut.
inline std::shared_ptr<const Grid> sampledBall(int n) {
  return std::make_shared<const Grid>(n, 1.0, [](const glm::dvec3& p) {
    return std::max(glm::length(p - glm::dvec3(0.05, 0.0, -0.03)) - 0.7, p.x + 0.25 * p.y - 0.4);
  });
}
inline std::shared_ptr<const Points> fourPoints() {
  return std::make_shared<const Points>(
      std::vector<glm::dvec3>{{0.5, 0.1, 0.0}, {-0.5, 0.3, 0.2}, {0.1, -0.6, -0.3}, {0.0, 0.2, 0.7}}, 0.35);
}

/// A star with 60 tips, in the plane of the first two arguments.
inline std::shared_ptr<const Payload> starOfManySides() {
  std::vector<glm::dvec2> corners;
  for (int i = 0; i < 120; ++i) {
    const double angle = 2.0 * std::numbers::pi * i / 120.0, radius = i % 2 == 0 ? 1.0 : 0.8;
    corners.push_back(radius * glm::dvec2(std::cos(angle), std::sin(angle)));
  }
  return PolygonField::of(std::move(corners));
}

/// A ring of arcs, in the same plane.
inline std::shared_ptr<const Payload> ringOfArcs() {
  const auto circle = [](double r, double bulge) {
    return ArcContour{{{r, 0.0}, bulge},
                      {{0.0, r * (bulge < 0.0 ? -1.0 : 1.0)}, bulge},
                      {{-r, 0.0}, bulge},
                      {{0.0, r * (bulge < 0.0 ? 1.0 : -1.0)}, bulge}};
  };
  const double quarter = std::tan(std::numbers::pi / 8.0);
  return PolygonField::of(std::vector<ArcContour>{circle(1.0, quarter), circle(0.5, -quarter)});
}

struct PayloadCase {
  std::string name;
  std::shared_ptr<const Payload> payload;
  double steepest = 0.7;  ///< of its slope, is found somewhere
};
inline void PrintTo(const PayloadCase& c, std::ostream* out) { *out << c.name; }
inline std::vector<PayloadCase> payloadCases() {
  return {{"Grid", sampledBall(9)},
          {"Points", fourPoints()},
          {"Polygon", starOfManySides()},
          {"Arcs", ringOfArcs()},
          {"ValueNoise", LatticeNoise::of(LatticeNoise::Kind::Value)},
          {"GradientNoise", LatticeNoise::of(LatticeNoise::Kind::Gradient, 3), 0.55},
          {"NearestPoint", LatticeNoise::of(LatticeNoise::Kind::Nearest)},
          {"SecondPoint", LatticeNoise::of(LatticeNoise::Kind::Second)},
          {"BorderNoise", LatticeNoise::of(LatticeNoise::Kind::Border)}};
}

inline const std::array<Expr, 3>& coordinates() {
  static const std::array<Expr, 3> xyz{Expr::variable(Variable::X), Expr::variable(Variable::Y),
                                       Expr::variable(Variable::Z)};
  return xyz;
}
/// The payload at the position, with the slope that it has there.
inline Expr payloadHere(const std::shared_ptr<const Payload>& payload) {
  return Expr::payload({payload}, coordinates()).claimLipschitz(payload->lipschitz());
}

}  // namespace sdf::test
