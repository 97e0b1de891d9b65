// The GLSL reading of a distance, by OpenGL.
#pragma once
#include <glm/vec4.hpp>
#include <memory>
#include <string>
#include <vector>

#include "sdf/expr/expr.h"

namespace sdf::chart {

/// A shader that reads a distance at some points, each of them `times` over. All throw std::runtime_error
/// where there is no OpenGL or it refuses.
class ShaderReading {
 public:
  /// Compiles it, and runs it once, for drivers compile when they draw.
  ShaderReading(const Expr& distance, const std::vector<glm::vec4>& points, int times);
  ~ShaderReading();
  ShaderReading(const ShaderReading&) = delete;
  ShaderReading& operator=(const ShaderReading&) = delete;

  /// Reads, and waits until all is read.
  void run() const;
  /// Of each point, as the last run read it.
  std::vector<float> values() const;
  static std::string driver();

 private:
  struct State;
  std::unique_ptr<State> state_;
};

}  // namespace sdf::chart
