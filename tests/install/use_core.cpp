// A program that only evaluates scenes: it must build without the mesher's dependencies.
#include <cstdio>

#include "sdf/eval/scalar_reading.h"
#include "sdf/script/script.h"

int main() {
  const sdf::Result<sdf::Scene> scene = sdf::runScene("part('ball', sphere(1))", "ball.lua");
  if (!scene) {
    std::fprintf(stderr, "%s\n", scene.error().message.c_str());
    return 1;
  }
  const double distance = sdf::evaluate(sdf::Tape(scene.value().whole().distance), glm::dvec3(0.0, 0.0, 3.0));
  std::printf("(0, 0, 3) is %g from the unit sphere\n", distance);
  return distance == 2.0 ? 0 : 1;
}
