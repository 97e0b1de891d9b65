// Enclosures of a field, its slopes and its curvature over a small box or triangle that may stand askew.
#pragma once
#include <array>
#include <glm/vec2.hpp>
#include <glm/vec3.hpp>
#include <optional>
#include <vector>

#include "sdf/eval/tape.h"
#include "sdf/number/dual-inl.h"
#include "sdf/number/interval.h"

namespace sdf {

/// The points centre + s0 axis0 + s1 axis1 + s2 axis2 where s lies in a box around 0, or in the plane of the
/// first two axes in a triangle around 0.
class Patch {
 public:
  using Point = std::array<Interval, 3>;

  /// |s_k| <= radius[k].
  static Patch box(const glm::dvec3& centre, const std::array<glm::dvec3, 3>& axes, const glm::dvec3& radius);
  /// The part of a triangle whose corners have these coordinates along its first and its second side. The
  /// axes are those sides.
  static Patch triangle(const std::array<glm::dvec3, 3>& corners, const std::array<glm::dvec2, 3>& part);

  const Point& centre() const { return centre_; }
  const std::array<Point, 3>& axes() const { return axes_; }
  /// Contains slope · s for every s of the patch and every slope in these intervals.
  Interval spread(const Interval (&slope)[3]) const;
  /// The largest |s_k|.
  double radius(int k) const { return radius_[k]; }

 private:
  Point centre_;
  std::array<Point, 3> axes_;  // what has no extent along an axis has 0 there
  std::array<double, 3> radius_{};
  std::array<std::array<Interval, 2>, 3> corners_;
  bool isTriangle_ = false;
};

/// What is known of a field over a patch, along its axes.
struct PatchBounds {
  Interval value;
  std::array<Interval, 3> slope;      ///< contains all difference quotients, jumps included
  std::array<Interval, 6> curvature;  ///< second derivatives 00, 01, 02, 11, 12, 22, where `curved`
  bool curved = false;                ///< the field is twice differentiable there, as far as we know
};

/// A comparison of two values of a tape, or of one with 0, that is taken to come out one way: what min, max
/// and abs choose by.
struct Assumption {
  Operand a;
  std::optional<Operand> b;  ///< none: 0
  bool less;                 ///< a <= b, else a >= b
};

/// Runs a tape over patches. Each instruction's value is narrowed by the mean value theorem, value at the
/// centre + slope · s, and its slopes by its curvature; so that a minimum's or a maximum's value is as tight
/// as its branches' (Moore 1966, the mean value form). Not thread-safe; cheap to make.
class PatchReading {
 public:
  /// Bounds of output 0. Curvature is looked for only where asked.
  PatchBounds run(const Tape& tape, const Patch& patch, bool curvature);
  /// A lower bound of output 0's slope along axis k; not positive where none is found. Where min, max and abs
  /// are open each case is taken by itself, with what it says of the values: along a line the slope is almost
  /// everywhere that of some case.
  double leastSlope(const Tape& tape, const Patch& patch, int k);

  using Slopes = Dual<Interval, 3>;
  /// A value over the patch, and its second derivatives where they are known.
  struct Term {
    Slopes f;
    std::array<Interval, 6> h;
    bool curved;
    bool clipped;  ///< holds where assumptions do, not all over the patch
  };

 private:
  bool read(const Tape& tape, const Patch& patch, bool curvature);
  bool assume(const Instruction& n, Term& t) const;
  bool isImpossible(const Term& t) const;
  bool clip(std::size_t at, Term& t) const;
  const Assumption* known(const Operand& a, const std::optional<Operand>& b) const;
  std::optional<Assumption> openChoice(const Tape& tape) const;
  double leastSlopeOfCases(const Tape& tape, const Patch& patch, int k, int& runs);

  Term term(Operand a) const;
  Slopes atCentre(Operand a) const;
  void narrow(const Slopes& centre, const Patch& patch, Term& t) const;

  const Tape* tape_ = nullptr;
  std::array<Term, kVariableCount> variables_;
  std::array<Slopes, kVariableCount> centreVariables_;
  std::vector<Term> terms_;
  std::vector<Slopes> centres_;
  std::vector<Assumption> assumptions_;
  int along_ = 0;  // axis of the slope that is looked for
};

}  // namespace sdf
