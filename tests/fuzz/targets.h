// What is fuzzed. Each target takes any bytes, and returns if everything that it checks holds; a find is
// printed, and the process aborts. The fuzzer (libfuzzer/entry.cpp) and the test over the kept corpus
// (corpus_test.cpp) call the same.
#pragma once
#include <cmath>
#include <cstdint>
#include <glm/vec3.hpp>
#include <span>
#include <string>

namespace sdf::fuzz {

using Input = std::span<const std::uint8_t>;

/// The text of a scene: it runs within small limits, and either fails with one line that says where, or gives
/// a scene whose parts can be evaluated and bounded.
void script(Input input);

/// A graph over all operations: every reading of it agrees with double, and its facts hold.
void graph(Input input);

/// A tree of catalog entries: its mesh is sound, and each format reads back.
void meshed(Input input);

/// The extension and the bytes of a mesh file: its mesh is sound, or an error of one line says why there is
/// none.
void files(Input input);

inline bool finite(const glm::vec3& v) {
  return std::isfinite(v.x) && std::isfinite(v.y) && std::isfinite(v.z);
}

/// Prints what went wrong and aborts.
[[noreturn]] void find(const std::string& what);

}  // namespace sdf::fuzz
