// What every shader's source is put together from. Private to viewer/shaders.
#pragma once
#include <glm/vec3.hpp>
#include <string>

#include "sdf/base/box.h"
#include "sdf/eval/glsl.h"

namespace sdf::viewer {

// Drivers inline and unroll, and take seconds over long programs: a gradient of more operations than this is
// taken by differences, and a distance of more has no tiles drawn apart, which would take another program.
inline constexpr std::size_t kLongProgram = 6000;

/// The line with the version, and the precision where it must be stated.
std::string header(bool es);

/// A number as GLSL has it.
std::string number(double v);

/// A vec3.
std::string vector(const glm::dvec3& v);

/// `#define name value`.
std::string define(const std::string& name, const std::string& value);

/// farEnd(ray, spread, widening): t where all rays of a cone leave a ball around the bounds, or the end of
/// sight where these are not finite.
std::string farEnd(const Box& bounds);

/// The name of a parameter that no scene has.
inline std::string hidden(const std::string& name) { return '\x01' + name; }

/// Gives the writer what the distance's gradient needs, and returns the parts that define normalAt.
std::string normals(GlslWriter& writer, const Expr& distance);

}  // namespace sdf::viewer
