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
    case Rule::Any:
      break;
  }
  return true;
}

namespace {

std::string quoted(std::string_view name, std::string_view rest) {
  return std::string(name) + std::string(rest);
}

}  // namespace

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

Check& Check::fail(const std::string& fault) {
  if (!message_) message_ = subject_ + ": " + fault;
  return *this;
}

Check& Check::that(bool holds, const std::string& fault) { return holds ? *this : fail(fault); }

Check& Check::number(std::string_view name, const Expr& e, Rule rule) {
  if (!ok()) return *this;
  if (dependsOnSpace(e)) return fail(quoted(name, " must not depend on position"));
  const double value = uniformValue(e);
  if (!std::isfinite(value))
    return fail(quoted(name, " must be ") + wording(Rule::Any) + ", got " + shown(value));
  if (!keeps(rule, value)) return fail(quoted(name, " must be ") + wording(rule) + ", got " + shown(value));
  return *this;
}

Check& Check::vector(std::string_view name, const Vec3E& v, Rule rule, int components) {
  number(quoted(name, ".x"), v.x, rule).number(quoted(name, ".y"), v.y, rule);
  return components > 2 ? number(quoted(name, ".z"), v.z, rule) : *this;
}

Check& Check::below(std::string_view name, const Expr& e, std::string_view what, const Expr& limit) {
  if (!number(name, e, Rule::Any).ok()) return *this;
  const double value = uniformValue(e), most = uniformValue(limit);
  return that(value < most, quoted(name, " must be less than ") + std::string(what) + ", " + shown(most) +
                                ", got " + shown(value));
}

Check& Check::atMost(std::string_view name, const Expr& e, std::string_view what, const Expr& limit) {
  if (!number(name, e, Rule::Any).ok()) return *this;
  const double value = uniformValue(e), most = uniformValue(limit);
  return that(value <= most, quoted(name, " must be at most ") + std::string(what) + ", " + shown(most) +
                                 ", got " + shown(value));
}

Check& Check::angle(std::string_view name, const Expr& e, double limitDegrees, bool limitIncluded) {
  if (!number(name, e, Rule::Any).ok()) return *this;
  // The catalog's conversion to radians may end an ulp above the limit.
  constexpr double kRounding = 1e-12;
  const double degrees = uniformValue(e) * (180.0 / std::numbers::pi);
  const bool within = degrees > 0.0 && (limitIncluded ? degrees <= limitDegrees * (1.0 + kRounding)
                                                      : degrees < limitDegrees * (1.0 - kRounding));
  return that(within, quoted(name, " must be above 0 and ") + (limitIncluded ? "at most " : "below ") +
                          shown(limitDegrees) + " degrees, got " + shown(degrees));
}

Check& Check::integerAtLeast(std::string_view name, int value, int least) {
  return that(value >= least,
              quoted(name, " must be at least ") + std::to_string(least) + ", got " + std::to_string(value));
}

}  // namespace sdf
