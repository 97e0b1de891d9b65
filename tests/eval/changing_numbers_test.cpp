// The text of functions that are made anew with other numbers.
#include "sdf/eval/changing_numbers.h"

#include <gtest/gtest.h>

#include <cmath>

#include "sdf/eval/glsl.h"
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

TEST(ChangingNumbersTest, OfBoundsAreEachAUniform) {
  GlslWriter plain, changing(std::make_shared<ChangingNumbers>());
  EXPECT_EQ(plain.changingTerm(2.5), "2.5");
  EXPECT_EQ(changing.changingTerm(2.5), "u0");
  EXPECT_EQ(changing.changingTerm(2.5), "u1");
  EXPECT_EQ(changing.uniforms().uniform(), (std::vector{2.5, 2.5}));
}

}  // namespace changing_numbers_test
}  // namespace sdf
