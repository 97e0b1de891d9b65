// Scenes as values: names, what is united, what is refused.
#include "sdf/scene/scene.h"

#include <gtest/gtest.h>

#include "sdf/scene/patterns.h"
#include "sdf/shape/solids/flats.h"
#include "sdf/shape/solids/solids.h"

namespace sdf {
namespace scene_test {

double at(const Expr& e, double x, double y, double z) {
  return uniformValue(remap(e, {Expr(x), Expr(y), Expr(z)}, 1.0));
}

TEST(Scene, PartsWithoutNamesGetFreeOnes) {
  Scene scene;
  scene.add("part 2", sphere(1.0));
  scene.add("", sphere(1.0));
  scene.add("", sphere(1.0));
  EXPECT_EQ(scene.parts[1].name, "part 3");
  EXPECT_EQ(scene.parts[2].name, "part 4");
  EXPECT_TRUE(checked(scene));
}

TEST(Scene, TheWholeIsTheNearestPart) {
  Scene scene;
  scene.add("small", sphere(1.0));
  scene.add("large", sphere(2.0));
  EXPECT_EQ(at(scene.whole().distance, 5, 0, 0), 3.0);
  EXPECT_EQ(scene.whole().bounds.max, glm::dvec3(2.0));
}

TEST(Scene, ALaterPartWinsATie) {
  Scene scene;
  scene.add("red", sphere(1.0).paint({.color = {1.0, 0.0, 0.0}}));
  scene.add("blue", sphere(1.0).paint({.color = {0.0, 0.0, 1.0}}));
  const Shape whole = scene.whole();
  EXPECT_EQ(at(whole.surface[static_cast<int>(Attribute::Red)], 1, 0, 0), 0.0);
  EXPECT_EQ(at(whole.surface[static_cast<int>(Attribute::Blue)], 1, 0, 0), 1.0);
}

TEST(Scene, ParametersAreRegisteredAsTheyAreMade) {
  Scene scene;
  const Expr k = scene.parameter("k", 0.5, 0.25, 2.0);
  EXPECT_EQ(scene.parameters.at(0), (ParameterInfo{"k", 0.5, 0.25, 2.0}));
  EXPECT_EQ(uniformValue(k), 0.5);
}

TEST(Scene, WhatCannotBeUsedIsRefused) {
  EXPECT_EQ(checked({}).error().message, "the scene is empty; add a shape to it");

  Scene failed;
  failed.add("ball", sphere(-1.0));
  EXPECT_EQ(checked(failed).error().message, "part 'ball': sphere: radius must be positive, got -1");

  Scene twice;
  twice.add("a", sphere(1.0));
  twice.add("a", sphere(1.0));
  EXPECT_EQ(checked(twice).error().message, "part 'a' is there twice; give each part a name of its own");

  Scene flat;
  flat.add("disc", circle(1.0));
  EXPECT_EQ(checked(flat).error().message, "part 'disc' is flat; extrude or revolve it");

  Scene unnamed;
  unnamed.parts.push_back({"", sphere(1.0)});
  EXPECT_EQ(checked(unnamed).error().message, "a part has no name; add parts with Scene::add");

  Scene parameters;
  parameters.add("", sphere(parameters.parameter("k", 1.0)));
  parameters.parameter("k", 2.0);
  EXPECT_EQ(checked(parameters).error().message, "parameter 'k' is there twice; give each a name of its own");
}

}  // namespace scene_test
}  // namespace sdf
