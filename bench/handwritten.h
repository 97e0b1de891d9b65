// The measuring shapes as loops that a patient programmer would write, for the compiler to vectorise: what
// the batch reading and the mesher are measured against.
#pragma once
#include <cstddef>

namespace sdf::bench {

/// Distances at n points, a multiple of kBlock.
using PointLoop = void (*)(const float* x, const float* y, const float* z, float* out, std::size_t n);
/// Distances along a row of n points that share x and y.
using RowLoop = void (*)(float x, float y, const float* z, float* out, std::size_t n);

inline constexpr std::size_t kBlock = 64;

struct Handwritten {
  PointLoop points;
  RowLoop row;
};

inline constexpr int kShapes = 7;
/// Shape S1 … S7 for i = 0 … 6.
Handwritten handwritten(int i);

}  // namespace sdf::bench
