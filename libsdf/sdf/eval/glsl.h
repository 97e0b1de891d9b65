// The GLSL reading: expressions as source of functions, for GLSL 3.30 core and GLSL ES 3.00.
#pragma once
#include <map>
#include <memory>
#include <span>
#include <string>
#include <unordered_map>
#include <unordered_set>
#include <utility>
#include <vector>

#include "sdf/eval/changing_numbers.h"
#include "sdf/eval/function.h"

namespace sdf {

/// Can the node be computed in double in a shader?
bool canBeExact(const Expr& e);

/// Gathers functions over one set of uniforms. What depends on parameters alone is left to the CPU: a shader
/// reads it as a number, so that a new value of a parameter compiles nothing and costs nothing a pixel.
class GlslWriter {
 public:
  /// Numbers that change become uniforms, too, if it is told which.
  GlslWriter() = default;
  explicit GlslWriter(std::shared_ptr<ChangingNumbers> numbers) : numbers_(std::move(numbers)) {}

  /// Adds a function of the point p and the unit normal n:
  ///
  ///     void name(vec3 p, vec3 n, out float values[outputs.size()])
  ///
  /// or, for one output, `float name(vec3 p, vec3 n)`, and for three `vec3 name(…)`.
  /// Common parts are computed once. Values agree with the batch reading's but for the order in which the
  /// driver adds, and its rounding of divisions, roots and transcendental functions; min, max, pow, atan and
  /// atan2 of a NaN are the driver's choice. Cost: linear in the size of the graph.
  void add(const std::string& name, std::span<const Expr> outputs);

  /// Returns the GLSL term of a number that follows from bounds: where numbers change, a uniform of its own,
  /// else a literal.
  std::string changingTerm(double v);

  /// From now on the parameter of this name is read as that GLSL term, which may differ from pixel to pixel.
  void substitute(const std::string& parameter, const std::string& term) { terms_[parameter] = term; }

  /// The lines that compute what this expression needs, and none that was labelled before, will end in this
  /// comment, so that a driver's complaint about one tells whose it is. Characters other than ASCII's
  /// printable ones become question marks. Cost: linear in the size of its graph.
  void label(const Expr& e, const std::string& comment);

  /// From now on these nodes are computed in double, with what uses them, which GL_ARB_gpu_shader_fp64
  /// allows; the header has to ask for it if source() contains "double". Uniforms are floats all the same,
  /// and so is what tan, arcs, powers, exp, log and payloads take and give.
  void computeExactly(std::span<const Expr> nodes) { exact_.insert(nodes.begin(), nodes.end()); }

  /// Declarations and functions, without `#version` and precision. `main` must call sdfTakeValues() before
  /// any of them.
  std::string source() const;
  /// The function whose outputs the uniform `vec4 sdfValues[]` holds, in order; it has none where the source
  /// has no such uniform. Readings of many frames keep it.
  Function uniforms() const { return Function(uniforms_); }
  /// The payloads that the source reads, each with the name of its function.
  std::vector<std::pair<std::string, std::shared_ptr<const Payload>>> payloads() const;

 private:
  class Body;
  std::string uniform(const Expr& e);
  std::string nameOf(const std::shared_ptr<const Payload>& payload);
  std::string commentOf(const Expr& e) const;

  std::shared_ptr<ChangingNumbers> numbers_;
  std::string functions_;
  std::unordered_map<std::string, std::string> terms_;
  std::vector<std::string> comments_;
  std::unordered_map<Expr, std::size_t> labels_;  // index of the comment
  std::unordered_set<Expr> exact_;
  std::unordered_set<Expr> labelled_;  // the expressions that were given, each on a line of its own
  std::vector<Expr> uniforms_;
  std::unordered_map<Expr, std::size_t> slots_;
  std::vector<std::shared_ptr<const Payload>> payloads_;
};

}  // namespace sdf
