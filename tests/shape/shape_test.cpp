#include "sdf/shape/shape.h"

#include <gtest/gtest.h>

#include "sdf/shape/operators/booleans.h"
#include "sdf/shape/solids/solids.h"

namespace sdf {
namespace shape_test {

Expr attribute(const Attributes& a, Attribute which) { return a[static_cast<int>(which)]; }

TEST(Material, IsItselfAndNoOtherThatLooksTheSame) {
  const MaterialPtr brass = makeMaterial({.name = "brass"}), same = makeMaterial({.name = "brass"});
  EXPECT_EQ(brass->name, "brass");
  const Shape ball = sphere(1.0);
  EXPECT_EQ(unite(ball.paint(brass), ball.paint(brass)).materials, std::vector{brass});
  EXPECT_EQ(unite(ball.paint(brass), ball.paint(same)).materials, (std::vector{brass, same}));
}

TEST(Material, AnswersAmbientLightInItsOwnColourUnlessToldOtherwise) {
  Material m;
  m.color = {0.25, 0.5, position().x};
  Attributes a = attributesOf(m);
  EXPECT_EQ(attribute(a, Attribute::AmbientGreen), Expr(0.5));
  EXPECT_EQ(attribute(a, Attribute::AmbientBlue), position().x);
  m.ambient = Vec3E{0.1, 0.2, 0.3};
  a = attributesOf(m);
  EXPECT_EQ(attribute(a, Attribute::AmbientGreen), Expr(0.2));
  EXPECT_EQ(attribute(a, Attribute::Green), Expr(0.5));
}

TEST(Material, GivesEveryAttributeItsField) {
  Material m;
  m.specular = {0.1, 0.2, 0.3};
  m.emission = {0.4, 0.5, 0.6};
  m.shininess = 7.0;
  m.reflectivity = 0.8;
  m.fresnelPower = 5.0;
  m.fresnelBias = 0.9;
  const Attributes a = attributesOf(m);
  EXPECT_EQ(attribute(a, Attribute::SpecularBlue), Expr(0.3));
  EXPECT_EQ(attribute(a, Attribute::EmissionRed), Expr(0.4));
  EXPECT_EQ(attribute(a, Attribute::Shininess), Expr(7.0));
  EXPECT_EQ(attribute(a, Attribute::Reflectivity), Expr(0.8));
  EXPECT_EQ(attribute(a, Attribute::FresnelPower), Expr(5.0));
  EXPECT_EQ(attribute(a, Attribute::FresnelBias), Expr(0.9));
  EXPECT_EQ(attribute(a, Attribute::MaterialId), Expr(0.0));
}

TEST(Shape, IsGreyUntilPaintedAndThenAllInOneMaterial) {
  const Shape plain = sphere(1.0);
  EXPECT_EQ(plain.materials, std::vector{defaultMaterial()});
  EXPECT_EQ(attribute(plain.surface, Attribute::MaterialId), Expr(0.0));
  Material red;
  red.color = {1.0, 0.0, 0.0};
  const Shape painted = plain.paint(red);
  EXPECT_EQ(painted.distance, plain.distance);
  ASSERT_EQ(painted.materials.size(), 1u);
  EXPECT_EQ(attribute(painted.surface, Attribute::MaterialId), Expr(0.0));
  EXPECT_EQ(attribute(painted.surface, Attribute::Red), Expr(1.0));
}

TEST(Shape, ThatFailedStaysSoWhenPainted) {
  const Shape failed = Shape::failed("sphere: radius must be positive, got -1");
  EXPECT_FALSE(failed.ok());
  EXPECT_EQ(failed.paint(Material{}).error, failed.error);
}

}  // namespace shape_test
}  // namespace sdf
