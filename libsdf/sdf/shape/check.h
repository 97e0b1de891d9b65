// Checks on the arguments of shapes and operators, worded once for the C++ functions and the catalog. Private
// to shape/.
#pragma once
#include <optional>
#include <string>
#include <utility>

#include "sdf/shape/catalog.h"

namespace sdf {

/// Keeps the first fault of the arguments of one call:
///
///   Check check("torus");
///   check.positive("major", major).positive("minor", minor);
///   if (!check.ok()) return check.failure();
///
/// Every check first makes sure that the number does not depend on position and is finite at present.
class Check {
 public:
  explicit Check(std::string subject) : subject_(std::move(subject)) {}
  /// A failed operand's error goes before everything else, as it is.
  Check(std::string subject, const Shape& operand) : subject_(std::move(subject)), message_(operand.error) {}

  Check& number(const std::string& name, const Expr& e, Rule rule);
  Check& vector(const std::string& name, const Vec3E& v, Rule rule, int components = 3);
  Check& positive(const std::string& name, const Expr& e) { return number(name, e, Rule::Positive); }
  Check& notNegative(const std::string& name, const Expr& e) { return number(name, e, Rule::NotNegative); }
  Check& any(const std::string& name, const Expr& e) { return number(name, e, Rule::Any); }

  /// e < limit and e <= limit; `what` names the limit: "radius must be at most the smallest half size, 1".
  Check& below(const std::string& name, const Expr& e, const std::string& what, const Expr& limit) {
    return limited(name, e, "less than " + what, limit, false);
  }
  Check& atMost(const std::string& name, const Expr& e, const std::string& what, const Expr& limit) {
    return limited(name, e, "at most " + what, limit, true);
  }
  /// An angle in radians, 0 < e < limit (or <=); the message speaks of degrees, as scene files do.
  Check& angle(const std::string& name, const Expr& e, double limitDegrees, bool limitIncluded);
  Check& integerAtLeast(const std::string& name, int value, int least);
  /// Anything else: `fault` completes "subject: ".
  Check& that(bool holds, const std::string& fault);

  bool ok() const { return !message_; }
  /// The failed shape. Precondition: !ok().
  Shape failure() const { return Shape::failed(*message_); }

 private:
  Check& limited(const std::string& name, const Expr& e, const std::string& wanted, const Expr& limit,
                 bool included);

  std::string subject_;
  std::optional<std::string> message_;
};

}  // namespace sdf
