// Checks on the arguments of shapes and operators, worded once for the C++ functions and the catalog. Private
// to shape/.
#pragma once
#include <optional>
#include <string>
#include <string_view>

#include "sdf/shape/catalog.h"

namespace sdf {

/// Collects the first thing that is wrong with the arguments of one call:
///
///   Check check("torus");
///   check.positive("major", major).positive("minor", minor);
///   if (!check.ok()) return check.failure();
///
/// Every check first makes sure that the number does not depend on position and is finite at present.
class Check {
 public:
  explicit Check(std::string_view subject) : subject_(subject) {}

  Check& number(std::string_view name, const Expr& e, Rule rule);
  Check& vector(std::string_view name, const Vec3E& v, Rule rule, int components = 3);
  Check& positive(std::string_view name, const Expr& e) { return number(name, e, Rule::Positive); }
  Check& notNegative(std::string_view name, const Expr& e) { return number(name, e, Rule::NotNegative); }
  Check& any(std::string_view name, const Expr& e) { return number(name, e, Rule::Any); }

  /// e < limit and e <= limit; `what` names the limit: "radius must be at most the smallest half size, 1".
  Check& below(std::string_view name, const Expr& e, std::string_view what, const Expr& limit);
  Check& atMost(std::string_view name, const Expr& e, std::string_view what, const Expr& limit);
  /// An angle in radians, 0 < e < limit (or <=); the message speaks of degrees, as scene files do.
  Check& angle(std::string_view name, const Expr& e, double limitDegrees, bool limitIncluded);
  Check& integerAtLeast(std::string_view name, int value, int least);
  /// Anything else: `fault` completes "subject: ".
  Check& that(bool holds, const std::string& fault);

  bool ok() const { return !message_; }
  /// The failed shape. Precondition: !ok().
  Shape failure() const { return Shape::failed(*message_); }
  const std::optional<std::string>& message() const { return message_; }

 private:
  Check& fail(const std::string& fault);
  std::string subject_;
  std::optional<std::string> message_;
};

}  // namespace sdf
