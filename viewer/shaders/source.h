// What every shader's source is put together from. Private to viewer/shaders.
#pragma once
#include <string>

#include "sdf/eval/glsl.h"

namespace sdf::viewer {

// Drivers inline and unroll, and take seconds over long programs: a gradient of more operations than this is
// taken by differences, and a distance of more has no tiles drawn apart, which would take another program.
inline constexpr std::size_t kLongProgram = 6000;

/// The line with the version, and the precision where it must be stated.
std::string header(bool es);

/// A number as GLSL has it.
std::string number(double v);

/// `#define name value`.
std::string define(const std::string& name, const std::string& value);

/// Gives the writer what the distance's gradient needs, and returns the parts that define normalAt.
std::string normals(GlslWriter& writer, const Expr& distance);

}  // namespace sdf::viewer
