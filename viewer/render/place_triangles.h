// Where triangles are before the eye of a shot.
#pragma once
#include <glm/mat3x3.hpp>

#include "viewer/gpu/program.h"
#include "viewer/render/frame.h"

namespace sdf::viewer {

/// Sets the uniforms of parts::kTrianglesVertex for triangles that lie at origin + toScene * their corners,
/// and which way round they are seen from their front.
void placeTriangles(const Program& program, const Shot& shot, const glm::dmat3& toScene,
                    const glm::dvec3& origin);

}  // namespace sdf::viewer
