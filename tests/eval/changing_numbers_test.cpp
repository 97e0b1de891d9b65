// The text of functions that are made anew with other numbers.
#include "sdf/eval/changing_numbers.h"

#include <gtest/gtest.h>

#include <cmath>

#include "sdf/eval/glsl.h"
#include "sdf/expr/payload.h"
#include "sdf/expr/vec.h"

namespace sdf {
namespace changing_numbers_test {

struct Written {
  std::string text;
  std::vector<double> uniforms;
};

// One function, in the form that the numbers know.
Written written(const std::shared_ptr<ChangingNumbers>& numbers, const Expr& e, const Values& values = {}) {
  numbers->begin();
  numbers->take({&e, 1});
  numbers->settle();
  GlslWriter writer(numbers);
  writer.add("distance", {&e, 1});
  return {writer.source(), writer.uniforms().uniform(values)};
}

// A distance with a step of this slope, which a slider does not move.
Expr ball(double radius, double slope) {
  const Expr size = Expr::parameter({"size", radius, radius, radius});
  return (length(position()) * 3.0 - size) * (1.0 / slope);
}

TEST(ChangingNumbersTest, BecomeUniformsOnceTheyAreSeenToChange) {
  const auto numbers = std::make_shared<ChangingNumbers>();
  const Written first = written(numbers, ball(1.0, 2.0));
  numbers->keep();
  EXPECT_NE(first.text.find("0.5"), std::string::npos);
  const Written second = written(numbers, ball(1.5, 4.0));
  EXPECT_NE(second.text, first.text);
  numbers->keep();
  EXPECT_EQ(second.uniforms, (std::vector{1.5, 0.25}));
  const Written third = written(numbers, ball(0.7, 16.0));
  EXPECT_EQ(third.text, second.text);
  EXPECT_EQ(third.uniforms, (std::vector{0.7, 0.0625}));
  EXPECT_NE(third.text.find("3.0"), std::string::npos) << "what never changes is a literal";
}

TEST(ChangingNumbersTest, AreToldApartWhereTheyAreOneByChance) {
  const auto numbers = std::make_shared<ChangingNumbers>();
  const auto sum = [](double a, double b) { return abs(position().x - a) + abs(position().x - b); };
  written(numbers, sum(1.0, 2.0));
  numbers->keep();
  const Written apart = written(numbers, sum(3.0, 4.0));
  numbers->keep();
  const Written same = written(numbers, sum(5.0, 5.0));
  EXPECT_EQ(same.text, apart.text);
  EXPECT_EQ(same.uniforms, (std::vector{5.0, 5.0}));
}

TEST(ChangingNumbersTest, AreThoseOfTheSameStructure) {
  const auto numbers = std::make_shared<ChangingNumbers>();
  const Expr other = position().y * 2.0;
  for (const Expr& e : {ball(1.0, 2.0), ball(2.0, 3.0)}) written(numbers, e), numbers->keep();
  const std::string text = written(numbers, ball(4.0, 5.0)).text;
  EXPECT_NE(written(numbers, other).text, text);
  numbers->keep();
  EXPECT_EQ(written(numbers, ball(6.0, 7.0)).text, text) << "what was seen of another one is still known";
}

TEST(ChangingNumbersTest, KeepFormulasOfInputs) {
  const auto numbers = std::make_shared<ChangingNumbers>();
  const auto wave = [](double slope) {
    return (position().x - sin(Expr::parameter({"time", 0.0, 0.0, 9.0}))) * (1.0 / slope);
  };
  written(numbers, wave(2.0));
  numbers->keep();
  EXPECT_EQ(written(numbers, wave(4.0), {{"time", 2.0}}).uniforms, (std::vector{std::sin(2.0), 0.25}));
}

// A table of a number or two.
class Table : public Payload {
 public:
  explicit Table(std::string_view kind) : kind_(kind) {}
  double value(const glm::dvec3& p) const override { return p.x; }
  ValueAndGradient gradient(const glm::dvec3& p) const override { return {p.x, {1.0, 0.0, 0.0}}; }
  Interval range(const std::array<Interval, 3>& box) const override { return box[0]; }
  double lipschitz() const override { return 1.0; }
  double rounding(const glm::dvec3&) const override { return 0.0; }
  std::string glsl(const std::string& name) const override { return "float " + name + "(vec3 p);"; }
  std::string_view kind() const override { return kind_; }

 private:
  std::string_view kind_;
};

TEST(ChangingNumbersTest, PayloadsOfOneKindStandInEachOthersPlaces) {
  const Vec3E p = position();
  const auto numbers = std::make_shared<ChangingNumbers>();
  const auto of = [&](const auto& a, const auto& b) {
    return Expr::payload({a, 0}, {p.x, p.y, p.z}) + 2.0 * Expr::payload({b, 0}, {p.y, p.z, p.x});
  };
  const auto made = [](const char* kind) { return std::make_shared<Table>(kind); };
  const auto payloads = [&](const Expr& e) {
    numbers->begin();
    numbers->take({&e, 1});
    numbers->settle();
    numbers->keep();
    GlslWriter writer(numbers);
    writer.add("distance", {&e, 1});
    std::vector<std::shared_ptr<const Payload>> all;
    for (const auto& [name, payload] : writer.payloads()) all.push_back(payload);
    return std::pair(writer.source(), all);
  };
  const auto a = made("table"), b = made("table"), c = made("table"), own = made(""), other = made("");
  const auto [text, first] = payloads(of(a, b));
  using All = std::vector<std::shared_ptr<const Payload>>;
  EXPECT_EQ(first, (All{a, b}));
  for (const All& now : {All{b, c}, All{b, a}}) {
    const auto [same, taken] = payloads(of(now[0], now[1]));
    EXPECT_EQ(same, text);
    EXPECT_EQ(taken, now);
  }
  EXPECT_EQ(payloads(of(c, c)).second, All{c}) << "one that stands in both places is another form";
  EXPECT_EQ(payloads(of(own, other)).second, (All{own, other})) << "those of no kind stay";
}

TEST(ChangingNumbersTest, OfBoundsAreEachAUniform) {
  GlslWriter plain, changing(std::make_shared<ChangingNumbers>());
  EXPECT_EQ(plain.changingTerm(2.5), "2.5");
  EXPECT_EQ(changing.changingTerm(2.5), "u0");
  EXPECT_EQ(changing.changingTerm(2.5), "u1");
  EXPECT_EQ(changing.uniforms().uniform(), (std::vector{2.5, 2.5}));
}

}  // namespace changing_numbers_test
}  // namespace sdf
