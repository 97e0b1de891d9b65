// Shader programs. All of it works in the current context, which must be the same for one program's whole
// life.
#pragma once
#include <glm/vec2.hpp>
#include <glm/vec3.hpp>
#include <glm/vec4.hpp>
#include <set>
#include <span>
#include <string>
#include <unordered_map>
#include <vector>

#include "sdf/base/result.h"
#include "viewer/gpu/handle.h"

namespace sdf::viewer {

/// Finds the names of the uniforms that a shader's source declares, arrays without their brackets.
std::set<std::string> declaredUniforms(const std::string& source);

/// A Program is a vertex and a fragment shader, linked. OpenGL itself lets uniforms be set that the shaders
/// do not have, and gives those that were never set some value; `strict` finds both.
class Program {
 public:
  /// Whether a program refuses to draw, by std::logic_error, while uniformFaults() finds something. It is
  /// true in debug builds, and tests set it.
  static bool strict;

  /// Compiles and links the shaders. Errors: Graphics, with the driver's words and the source lines that it
  /// names.
  static Result<Program> create(const std::string& vertex, const std::string& fragment);

  /// Makes a program whose fragment shader runs once for each pixel of the target. Errors: as create.
  static Result<Program> overScreen(const std::string& fragment);

  /// Makes a program whose fragment shader runs once for each pixel of some square tiles, in rows from the
  /// bottom: those at which the texture `tiles` has a value below `tileLimit`. A larger texture may hold
  /// several cells of such tiles, in rows from the bottom; then one value of those from `firstCell` to
  /// `lastCell` suffices. Errors: as create.
  static Result<Program> overTiles(const std::string& fragment);

  /// Makes the program the one that draws.
  void use() const;

  /// Returns where a uniform is, or -1 if the shaders use none of that name. An array's name is its first
  /// element's.
  int location(const std::string& name) const;

  /// Returns what is wrong with the uniforms that were set so far: a line for each that no shader declares,
  /// and for each declared one that was not set. Cost: the length of the sources.
  std::vector<std::string> uniformFaults() const;

  // These use() the program.
  void set(const std::string& name, int value) const;  ///< also a sampler's unit
  void set(const std::string& name, float value) const;
  void set(const std::string& name, const glm::vec2& value) const;
  void set(const std::string& name, const glm::vec3& value) const;
  void set(const std::string& name, const glm::vec4& value) const;
  void set(const std::string& name, std::span<const float> values) const;      ///< float[]
  void set(const std::string& name, std::span<const glm::vec4> values) const;  ///< vec4[]

  /// Covers the viewport with one triangle: three vertices without attributes, made from gl_VertexID by the
  /// vertex shader of overScreen.
  void draw() const;

  /// Draws the tiles of this side in pixels, of a program that overTiles made; they cover the viewport or
  /// more. The side may be as large as a point, GL_POINT_SIZE_RANGE: 255 and more on today's drivers.
  void drawTiles(int columns, int rows, int side) const;

 private:
  Program(Handle program, Handle vertexArray);
  void refuseFaults() const;

  Handle program_, vertexArray_;
  mutable std::unordered_map<std::string, int> locations_;  // of all that were set
};

}  // namespace sdf::viewer
