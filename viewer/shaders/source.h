// Shader sources: literals, and the composition of fixed parts with the macros and functions that they use.
// Private to viewer/shaders.
#pragma once
#include <functional>
#include <glm/vec3.hpp>
#include <map>
#include <set>
#include <string>
#include <string_view>
#include <vector>

#include "sdf/eval/glsl.h"
#include "sdf/expr/alike.h"
#include "sdf/expr/vec.h"
#include "viewer/shaders/volume.h"

namespace sdf::viewer {

/// Writes the number as a GLSL term.
std::string number(double v);

/// Write a number and a vector that follow from bounds as GLSL terms (see GlslWriter::changingTerm).
std::string number(double v, GlslWriter& writer);
std::string vector(const glm::dvec3& v, GlslWriter& writer);

/// Returns the name of a parameter that no scene has.
inline std::string hidden(const std::string& name) { return kOwnName + name; }

/// Returns a vector's components as the outputs of one function.
inline std::vector<Expr> partsOf(const Vec3E& v) { return {v.x, v.y, v.z}; }

/// Macros are definitions by their names, parameters included, as in "ENCODE(c)".
using Macros = std::map<std::string, std::string>;

/// Functions are the outputs of the scene's functions by their names, which begin with "sdf". Each is made
/// when it is used.
using Functions = std::map<std::string, std::function<std::vector<Expr>()>>;

/// A Composer writes shaders that share the values of one set of uniforms.
class Composer {
 public:
  /// Whether macros that are dead, undefined or unused are refused, by std::logic_error. It is true in debug
  /// builds, and tests set it.
  static bool strict;

  /// Takes a writer that may know labels and terms, which are variables that `globals` declares.
  Composer(bool es, Macros macros, Functions functions, GlslWriter writer, std::string globals = {});

  /// Writes a shader of this body: before it stand the macros and functions that it uses, and no others.
  std::string compose(const std::string& body);

  /// Returns what the uniform sdfValues holds, of all shaders so far.
  Function uniforms() const { return writer_.uniforms(); }
  /// Returns the volumes that shaders so far read.
  std::vector<ShaderVolume> volumes() const { return volumesOf(writer_); }

 private:
  std::string start_;  // header and globals
  Macros macros_;
  Functions functions_;
  GlslWriter writer_;
  std::set<std::string> written_;  // functions
};

/// Finds the names of the macros that a source uses, by the convention that these, like constants, are in
/// capitals. Constants that it declares, and what comments say, do not count.
std::set<std::string> usedMacros(std::string_view source);

/// Finds the names of those macros that neither a fixed part nor another of them uses, so that no shader can.
std::vector<std::string> deadMacros(const Macros& macros);

/// Returns what is wrong with the macros of a whole shader: one line for each that it uses without a
/// definition or defines without a use.
std::vector<std::string> macroFaults(std::string_view shader);

}  // namespace sdf::viewer
