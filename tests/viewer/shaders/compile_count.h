// What a frame makes the driver and the CPU compile.
#pragma once
#include <epoxy/gl.h>

#include <cstddef>

#include "sdf/eval/tape.h"

namespace sdf::test {

/// Counts, while it lives, the shaders that the driver is asked to compile, and the tapes that this thread
/// compiles.
class CompileCount {
 public:
  CompileCount() : tapes_(tapesCompiled()) {
    compileShader() = epoxy_glCompileShader;
    epoxy_glCompileShader = counting;
    shaders() = 0;
  }
  ~CompileCount() { epoxy_glCompileShader = compileShader(); }
  CompileCount(const CompileCount&) = delete;
  CompileCount& operator=(const CompileCount&) = delete;

  int value() const { return shaders(); }
  std::size_t tapes() const { return tapesCompiled() - tapes_; }

 private:
  static int& shaders() {
    static int count = 0;
    return count;
  }
  static PFNGLCOMPILESHADERPROC& compileShader() {
    static PFNGLCOMPILESHADERPROC function = nullptr;
    return function;
  }
  static void counting(GLuint shader) {
    ++shaders();
    compileShader()(shader);
  }

  std::size_t tapes_;
};

}  // namespace sdf::test
