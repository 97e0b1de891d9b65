// Small scenes whose pictures can be told by geometry alone.
#pragma once
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <glm/geometric.hpp>
#include <glm/vec2.hpp>
#include <numbers>
#include <optional>
#include <sstream>
#include <string>

#include "sdf/shape/operators/place.h"
#include "sdf/shape/solids/solids.h"
#include "viewer/render/renderers.h"

namespace sdf::test {

inline constexpr int kWidth = 161, kHeight = 91;  // odd, so that the middle pixel looks straight ahead
inline constexpr double kAway = 6.0;              // of the camera from the origin
inline const glm::dvec3 kEye(0.0, 0.0, kAway);

/// Field of view of a picture one picture height away.
inline double unitFov() { return 2.0 * std::atan(0.5) * 180.0 / std::numbers::pi; }

/// Black, without lights, its colours shown as they are; the eye on the z axis looks at the origin.
inline Scene darkScene() {
  Scene scene;
  scene.camera.from = Vec3E(kEye);
  scene.camera.fov = unitFov();
  scene.ambient = Vec3E(0.0);
  scene.background = Vec3E(0.0);
  scene.gamma = 1.0;
  return scene;
}

inline glm::dvec2 onScreen(int column, int row) {
  return {(column + 0.5 - 0.5 * kWidth) / kHeight, (0.5 * kHeight - row - 0.5) / kHeight};
}
/// Where the eye of darkScene() looks through a pixel.
inline glm::dvec3 rayThrough(int column, int row) {
  return glm::normalize(glm::dvec3(onScreen(column, row), -1.0));
}
/// Where that ray meets the plane z = 0.
inline glm::dvec3 onWall(int column, int row) { return glm::dvec3(kAway * onScreen(column, row), 0.0); }

inline Shape wall(Material material) { return plane(Vec3E(0.0, 0.0, 1.0), 0.0).paint(std::move(material)); }
inline Shape ball(const glm::dvec3& center, double radius, Material material) {
  return translate(sphere(radius), Vec3E(center)).paint(std::move(material));
}
inline Light pointLight(const glm::dvec3& position, const glm::dvec3& color, double intensity = 1.0) {
  return {
      .kind = Light::Kind::Point, .vector = Vec3E(position), .color = Vec3E(color), .intensity = intensity};
}
inline Light sunTowards(const glm::dvec3& direction) { return {.vector = Vec3E(direction)}; }

/// How near a ray comes to a point.
inline double approach(const glm::dvec3& from, const glm::dvec3& along, const glm::dvec3& point) {
  const double t = std::max(0.0, glm::dot(point - from, along));
  return glm::length(from + t * along - point);
}
/// First t at which a ray that comes nearer than `radius` meets the sphere.
inline double enterSphere(const glm::dvec3& from, const glm::dvec3& along, const glm::dvec3& center,
                          double radius) {
  const double b = glm::dot(center - from, along), miss = approach(from, along, center);
  return b - std::sqrt(radius * radius - miss * miss);
}

inline double farthest(const glm::dvec3& a, const glm::dvec3& b) {
  const glm::dvec3 d = glm::abs(a - b);
  return std::max({d.x, d.y, d.z});
}

/// What a pixel must show, and how far off it may be.
struct Expected {
  glm::dvec3 color;
  double tolerance;
};
/// Nothing is expected of a pixel too close to an edge to tell its side.
using Expectation = std::function<std::optional<Expected>(int column, int row)>;

class Truth : public testing::TestWithParam<Renderer> {
 protected:
  Picture draw(const Scene& scene) const { return GetParam().render(scene, kWidth, kHeight); }
  double rounding() const { return GetParam().rounding; }
  double offset() const { return GetParam().offset; }

  static glm::dvec3 middle(const Picture& picture) {
    return picture.color[picture.at(kWidth / 2, kHeight / 2)];
  }

  /// Compares all pixels; of those that expect nothing there may be one in ten.
  static void expectPicture(const Picture& picture, const Expectation& expectation) {
    int compared = 0, wrong = 0;
    std::string first;
    for (int row = 0; row < kHeight; ++row)
      for (int column = 0; column < kWidth; ++column) {
        const std::optional<Expected> expected = expectation(column, row);
        if (!expected) continue;
        ++compared;
        const glm::dvec3 shown = picture.color[picture.at(column, row)];
        if (farthest(shown, expected->color) <= expected->tolerance) continue;
        if (++wrong == 1) first = describe(column, row, shown, *expected);
      }
    EXPECT_EQ(wrong, 0) << "the first: " << first;
    EXPECT_GE(compared, 0.9 * kWidth * kHeight);
  }

 private:
  static std::string describe(int column, int row, const glm::dvec3& shown, const Expected& expected) {
    std::ostringstream out;
    const auto write = [&](const glm::dvec3& c) { out << '(' << c.x << ", " << c.y << ", " << c.z << ')'; };
    out << "pixel " << column << ", " << row << ' ';
    write(shown);
    out << ", expected ";
    write(expected.color);
    out << " within " << expected.tolerance;
    return out.str();
  }
};

}  // namespace sdf::test
