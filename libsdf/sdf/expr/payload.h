// Payloads: functions that are given by data, such as samples on a grid, and not written in operations.
#pragma once
#include <array>
#include <cstddef>
#include <glm/vec3.hpp>
#include <memory>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "sdf/number/interval.h"

namespace sdf {

/// A value and its exact partial derivatives along x, y and z.
struct ValueAndGradient {
  double value;
  glm::dvec3 gradient;
};

/// Rows of a payload's first, second and third arguments.
using PayloadRows = std::array<const float*, 3>;

/// A texture in three dimensions that a payload's shader reads, as `uniform sampler3D` of the payload's name
/// and this one. Beyond its edge the edge goes on.
struct PayloadVolume {
  std::string name;
  glm::ivec3 size{0};
  int channels = 1;             ///< of each texel: 1, 2 or 4
  bool halves = false;          ///< floats of 16 bits do
  std::vector<float> values{};  ///< by texel, x first, then y, then z
};

/// A function f of a point, in units of its own, that answers every reading itself. Arguments may be
/// infinite, or NaN. Immutable, and read from any thread.
class Payload {
 public:
  virtual ~Payload() = default;

  /// f(p): this defines the function.
  virtual double value(const glm::dvec3& p) const = 0;
  /// f(p) and its partial derivatives there, at a crease those of one side; no number where f(p) is none.
  virtual ValueAndGradient gradient(const glm::dvec3& p) const = 0;
  /// Contains f at every point of the box, whose sides may be infinite, and says if it may be NaN.
  virtual Interval range(const std::array<Interval, 3>& box) const = 0;
  /// Proven L with |f(p) - f(q)| <= L |p - q| for all p and q; infinite where none is known.
  virtual double lipschitz() const = 0;
  /// Are the kinks of f edges of the shapes that it gives? Those between samples are none.
  virtual bool hasCreases() const { return false; }

  /// By how much a value in float may be off at p, in the batch reading (besides half an ulp) and, unless
  /// there are volumes(), in a shader. No less where the coordinates are larger. Derivatives in float may be
  /// those of a point near by.
  virtual double rounding(const glm::dvec3& p) const = 0;
  /// f at `count` points, which do not overlap `out`. Unless it is overridden it rounds value().
  virtual void values(const PayloadRows& p, std::size_t count, float* out) const;
  /// f and its partial derivatives, in that order. Unless it is overridden it rounds gradient().
  virtual void gradients(const PayloadRows& p, std::size_t count, const std::array<float*, 4>& out) const;
  /// GLSL of `float NAME(vec3 p)`, which is f, and `vec3 NAMESlopes(vec3 p)`, its derivatives, for 3.30 core
  /// and ES 3.00. Whatever else is defined has a name that begins with NAME. A shader has it once.
  virtual std::string glsl(const std::string& name) const = 0;
  /// The textures that this GLSL reads, by a linear filter. They may be made when they are first asked for.
  virtual std::span<const PayloadVolume> volumes() const { return {}; }
  /// Payloads of one kind have one GLSL, and differ in their volumes alone. Empty: it is of no kind.
  virtual std::string_view kind() const { return {}; }
};

/// A payload's value or one of its derivatives, as a node of the graph or an instruction of a tape has it.
struct PayloadPart {
  std::shared_ptr<const Payload> payload;
  int part = 0;  ///< 0: the value; 1, 2, 3: the partial derivative by this argument
  bool operator==(const PayloadPart&) const = default;
};

/// The part at (a, b, c). Number types have this function and the next beside those of ops.def.
double payloadAt(const PayloadPart& part, double a, double b, double c);
Interval payloadAt(const PayloadPart& part, const Interval& a, const Interval& b, const Interval& c);
/// The part and its partial derivatives; those of a derivative are not known, and NaN.
std::array<double, 4> payloadSlopes(const PayloadPart& part, double a, double b, double c);
/// The same for `count` points in rows, whose rows `out` does not overlap. Without `slopes` only the first of
/// `out` means anything.
void payloadSlopes(const PayloadPart& part, const PayloadRows& p, std::size_t count, bool slopes,
                   const std::array<float*, 4>& out);
/// Contains all partial derivatives, and difference quotients, of a part that has values in this range.
Interval payloadSlope(const PayloadPart& part, const Interval& range);

}  // namespace sdf
