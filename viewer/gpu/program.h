// Shader programs. All of it works in the current context, which must be the same for one program's whole
// life.
#pragma once
#include <glm/vec2.hpp>
#include <glm/vec3.hpp>
#include <glm/vec4.hpp>
#include <optional>
#include <set>
#include <span>
#include <string>
#include <string_view>
#include <unordered_map>
#include <vector>

#include "sdf/base/result.h"
#include "viewer/gpu/handle.h"
#include "viewer/gpu/mesh_buffer.h"

namespace sdf::viewer {

/// Puts the first few lines of what a driver says of a source in one, warnings left out, each beside the line
/// of the source that it speaks of. It knows the places of Mesa, "0:12(3): ", of NVIDIA, "0(12) : ", and of
/// ANGLE and Apple, "ERROR: 0:12: ". A source may not use #line.
std::string complaintsOf(std::string_view log, std::string_view source);

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

  /// Returns what is wrong with the uniforms that were set so far: a line for each that no shader declares,
  /// and for each declared one that was not set. Cost: once the length of the sources.
  std::vector<std::string> uniformFaults() const;

  // These make the program the one that draws.
  void set(const std::string& name, int value) const;     ///< also a sampler's unit
  void set(const std::string& name, double value) const;  ///< a float
  void set(const std::string& name, const glm::vec2& value) const;
  void set(const std::string& name, const glm::vec3& value) const;
  void set(const std::string& name, std::span<const float> values) const;      ///< float[]
  void set(const std::string& name, std::span<const glm::vec4> values) const;  ///< vec4[]

  /// Covers the viewport with one triangle: three vertices without attributes, made from gl_VertexID by the
  /// vertex shader of overScreen.
  void draw() const;

  /// Draws some of a buffer's triangles.
  void draw(const MeshBuffer& buffer, int first, int count) const;

  /// Draws the tiles of this side in pixels, of a program that overTiles made; they cover the viewport or
  /// more. The side may be as large as a point, GL_POINT_SIZE_RANGE: 255 and more on today's drivers.
  void drawTiles(int columns, int rows, int side) const;

 private:
  Program(Handle program, Handle vertexArray)
      : program_(std::move(program)), vertexArray_(std::move(vertexArray)) {}
  int location(const std::string& name) const;    // -1 if there is none; the program is used from now on
  const std::set<std::string>& declared() const;  // uniforms
  void refuseFaults() const;                      // if strict

  Handle program_, vertexArray_;
  mutable std::unordered_map<std::string, int> locations_;  // of all that were set
  mutable std::optional<std::set<std::string>> declared_;   // once they were read
};

}  // namespace sdf::viewer
