#include "viewer/shaders/source.h"

#include <cstdio>

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

std::string define(const std::string& name, const std::string& value) {
  return "#define " + name + " " + value + "\n";
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
