#include "viewer/render/place_triangles.h"

#include <epoxy/gl.h>

#include <glm/geometric.hpp>
#include <glm/matrix.hpp>
#include <vector>

namespace sdf::viewer {

void placeTriangles(const Program& program, const Shot& shot, const glm::dmat3& toScene,
                    const glm::dvec3& origin) {
  const auto [axes, from] = shot.view();
  const double focal = glm::length(axes.forward), width = shot.width(), height = shot.height();
  const glm::dvec3 forward = axes.forward / focal;
  const glm::dvec2 shift = glm::dvec2(0.5) - glm::dvec2(shot.within());
  program.set("lens", std::vector{glm::vec4(2.0 * focal * height / width, 2.0 * focal, 2.0 * shift.x / width,
                                            2.0 * shift.y / height)});
  program.set("nearest", 1e-4 * shot.lengths().unit);
  std::vector<glm::vec4> toEye, toNormal;
  for (const glm::dvec3& axis : {axes.right, axes.up, forward})
    toEye.emplace_back(axis * toScene, glm::dot(axis, origin - from));
  const glm::dmat3 normals = glm::transpose(glm::inverse(toScene));
  for (int row = 0; row < 3; ++row)
    toNormal.emplace_back(normals[0][row], normals[1][row], normals[2][row], 0.0);
  program.set("toEye", toEye);
  program.set("toNormal", toNormal);
  const bool mirrored = glm::dot(glm::cross(axes.right, axes.up), forward) > 0.0;
  glFrontFace((glm::determinant(toScene) < 0.0) == mirrored ? GL_CCW : GL_CW);
}

}  // namespace sdf::viewer
