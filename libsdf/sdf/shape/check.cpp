#include "sdf/shape/check.h"

#include <array>
#include <cmath>
#include <cstdio>
#include <numbers>

namespace sdf {

const char* wording(Rule rule) {
  switch (rule) {
    case Rule::Positive:
      return "positive";
    case Rule::NotNegative:
      return "0 or more";
    case Rule::NotZero:
      return "other than 0";
    case Rule::Count:
      return "a whole number from 1";
    case Rule::Any:
      break;
  }
  return "a finite number";
}

bool keeps(Rule rule, double value) {
  switch (rule) {
    case Rule::Positive:
      return value > 0.0;
    case Rule::NotNegative:
      return value >= 0.0;
    case Rule::NotZero:
      return value != 0.0;
    case Rule::Count:
      return value >= 1.0 && value == std::floor(value);
    case Rule::Any:
      break;
  }
  return true;
}

std::string shown(double value) {
  std::array<char, 32> text{};
  std::snprintf(text.data(), text.size(), "%.6g", std::isnan(value) ? std::abs(value) : value);
  return text.data();
}

std::string shown(const std::vector<std::string>& choices) {
  std::string text;
  for (std::size_t i = 0; i < choices.size(); ++i)
    text += (i == 0 ? "\"" : i + 1 == choices.size() ? " or \"" : ", \"") + choices[i] + "\"";
  return text;
}

Check& Check::that(bool holds, const std::string& fault) {
  if (!holds && !message_) message_ = subject_ + ": " + fault;
  return *this;
}

Check& Check::number(const std::string& name, const Expr& e, Rule rule) {
  if (!ok()) return *this;
  if (dependsOnSpace(e)) return that(false, name + " must not depend on position");
  const double value = uniformValue(e);
  const bool finite = std::isfinite(value);
  if (finite && keeps(rule, value)) return *this;
  return that(false, name + " must be " + wording(finite ? rule : Rule::Any) + ", got " + shown(value));
}

Check& Check::vector(const std::string& name, const Vec3E& v, Rule rule, int components) {
  number(name + ".x", v.x, rule).number(name + ".y", v.y, rule);
  return components > 2 ? number(name + ".z", v.z, rule) : *this;
}

Check& Check::limited(const std::string& name, const Expr& e, const std::string& wanted, const Expr& limit,
                      bool included) {
  if (!number(name, e, Rule::Any).ok()) return *this;
  const double value = uniformValue(e), most = uniformValue(limit);
  return that(included ? value <= most : value < most,
              name + " must be " + wanted + ", " + shown(most) + ", got " + shown(value));
}

Check& Check::angle(const std::string& name, const Expr& e, double limitDegrees, bool limitIncluded) {
  if (!number(name, e, Rule::Any).ok()) return *this;
  // The catalog's conversion to radians may end an ulp above the limit.
  constexpr double kRounding = 1e-12;
  const double degrees = uniformValue(e) * (180.0 / std::numbers::pi);
  const bool within = degrees > 0.0 && (limitIncluded ? degrees <= limitDegrees * (1.0 + kRounding)
                                                      : degrees < limitDegrees * (1.0 - kRounding));
  return that(within, name + " must be above 0 and " + (limitIncluded ? "at most " : "below ") +
                          shown(limitDegrees) + " degrees, got " + shown(degrees));
}

Check& Check::integerAtLeast(const std::string& name, int value, int least) {
  return that(value >= least,
              name + " must be at least " + std::to_string(least) + ", got " + std::to_string(value));
}

}  // namespace sdf
