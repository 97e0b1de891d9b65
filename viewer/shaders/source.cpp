#include "viewer/shaders/source.h"

#include <cstdio>
#include <glm/geometric.hpp>

#include "sdf/expr/gradient.h"
#include "viewer/shaders/parts.h"

namespace sdf::viewer {

std::string header(bool es) {
  return es ? "#version 300 es\nprecision highp float;\nprecision highp int;\nprecision highp sampler2D;\n"
            : "#version 330 core\n";
}

std::string number(double v) {
  char text[32];
  std::snprintf(text, sizeof text, "%.9g", v);
  return std::string("float(") + text + ")";
}

std::string vector(const glm::dvec3& v) {
  return "vec3(" + number(v.x) + ", " + number(v.y) + ", " + number(v.z) + ")";
}

std::string define(const std::string& name, const std::string& value) {
  return "#define " + name + " " + value + "\n";
}

std::string farEnd(const Box& bounds) {
  const std::string head = "float farEnd(Ray ray, float spread, float widening) {\n";
  constexpr double kBeyondFloats = 1e15;  // whose squares would be
  if (!bounds.finite() || bounds.longestSide() > kBeyondFloats) return head + "  return maxDistance;\n}\n";
  return head + "  float along = dot(" + vector(bounds.centre()) +
         " - ray.origin, ray.direction);\n  float reach = along + " +
         number(0.5 * glm::length(bounds.size())) + " + spread * ahead;\n" +
         "  return widening < 0.5 ? clamp(reach / (1.0 - widening), 0.0, maxDistance) : maxDistance;\n}\n";
}

std::string normals(GlslWriter& writer, const Expr& distance) {
  const Vec3E g = gradientOf(distance);
  const Expr all[] = {g.x, g.y, g.z};
  if (topologicalOrder(all).size() > kLongProgram)
    return std::string(parts::kGradientByTaps) + parts::kNormal;
  writer.add("sdfGradient", all);
  return std::string(parts::kGradient) + parts::kNormal;
}

}  // namespace sdf::viewer
