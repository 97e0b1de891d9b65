// Compiled by itself with -O3 -march=native -ffast-math and what else was found to make it faster; the
// formulas are the ones that the scenes state, operation by operation.
#include "handwritten.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <vector>

namespace sdf::bench {
namespace {

#define SDF_INLINE [[gnu::always_inline]] inline

SDF_INLINE float length(float a, float b) { return std::sqrt(a * a + b * b); }
SDF_INLINE float length(float a, float b, float c) { return std::sqrt(a * a + b * b + c * c); }

SDF_INLINE float box(float x, float y, float z, float hx, float hy, float hz) {
  const float a = std::fabs(x) - hx, b = std::fabs(y) - hy, c = std::fabs(z) - hz;
  const float outside = length(std::max(a, 0.0f), std::max(b, 0.0f), std::max(c, 0.0f));
  return outside + std::min(std::max(a, std::max(b, c)), 0.0f);
}

struct S1 {
  SDF_INLINE static float at(float x, float y, float z) { return length(x, y, z) - 1.0f; }
};

struct S2 {
  SDF_INLINE static float at(float x, float y, float z) {
    const float body = std::max(box(x, y, z, 1.0f, 1.0f, 1.0f), length(x, y, z) - 1.3f);
    const float bores = std::min(std::min(length(x, z) - 0.5f, length(x, y) - 0.5f), length(y, z) - 0.5f);
    return std::max(body, -bores);
  }
};

struct S6 {
  SDF_INLINE static float at(float x, float y, float z) {
    return std::min(length(length(x, y) - 1.2f, z) - 0.05f, box(x, y, z, 1.5f, 1.5f, 0.01f));
  }
};

struct S7 {
  SDF_INLINE static float at(float x, float y, float z) {
    return S6::at(x - 0.0137f, y - 0.0213f, z - 0.0311f);
  }
};

template <class Shape>
void points(const float* __restrict x, const float* __restrict y, const float* __restrict z,
            float* __restrict out, std::size_t n) {
  for (std::size_t i = 0; i < n; ++i) out[i] = Shape::at(x[i], y[i], z[i]);
}

template <class Shape>
void row(float x, float y, const float* __restrict z, float* __restrict out, std::size_t n) {
  for (std::size_t i = 0; i < n; ++i) out[i] = Shape::at(x, y, z[i]);
}

struct Ball {
  float x, y, z, radius;
};
constexpr int kSmoothBalls = 20;
constexpr int kManyBalls = 1000;

std::array<Ball, kSmoothBalls> makeSmoothBalls() {
  std::array<Ball, kSmoothBalls> balls;
  for (int i = 0; i < kSmoothBalls; ++i)
    balls[i] = {static_cast<float>(1.2 * std::sin(1.3 * i)), static_cast<float>(1.2 * std::sin(2.1 * i + 1)),
                static_cast<float>(1.2 * std::sin(3.7 * i + 2)),
                static_cast<float>(0.35 + 0.1 * std::sin(i))};
  return balls;
}

std::vector<Ball> makeManyBalls() {
  std::vector<Ball> balls(kManyBalls);
  for (int i = 0; i < kManyBalls; ++i)
    balls[i] = {static_cast<float>(1.7 * std::sin(12.9898 * i)),
                static_cast<float>(1.7 * std::sin(78.233 * i)),
                static_cast<float>(1.7 * std::sin(37.719 * i)), 0.06f};
  return balls;
}

const std::array<Ball, kSmoothBalls> kSmooth = makeSmoothBalls();
const std::vector<Ball> kMany = makeManyBalls();

SDF_INLINE float ballAt(const Ball& b, float x, float y, float z) {
  return length(x - b.x, y - b.y, z - b.z) - b.radius;
}

// A block of points goes through all the balls before the next, so that it stays in registers.

struct S3 {
  SDF_INLINE static float start(float x, float y, float z) { return ballAt(kSmooth[0], x, y, z); }
  SDF_INLINE static float join(float d, const Ball& b, float x, float y, float z) {
    const float e = ballAt(b, x, y, z);
    const float h = std::max(0.2f - std::fabs(d - e), 0.0f);
    return std::min(d, e) - h * h * 1.25f;
  }
  static const Ball* balls() { return kSmooth.data(); }
  static constexpr int kCount = kSmoothBalls;
};

struct S5 {
  SDF_INLINE static float start(float x, float y, float z) { return ballAt(kMany[0], x, y, z); }
  SDF_INLINE static float join(float d, const Ball& b, float x, float y, float z) {
    return std::min(d, ballAt(b, x, y, z));
  }
  static const Ball* balls() { return kMany.data(); }
  static constexpr int kCount = kManyBalls;
};

template <class Shape>
SDF_INLINE void block(const float* __restrict x, const float* __restrict y, const float* __restrict z,
                      float* __restrict out) {
  const Ball* balls = Shape::balls();
  float d[kBlock];
  for (std::size_t k = 0; k < kBlock; ++k) d[k] = Shape::start(x[k], y[k], z[k]);
  for (int b = 1; b < Shape::kCount; ++b)
#pragma GCC unroll 16
    for (std::size_t k = 0; k < kBlock; ++k) d[k] = Shape::join(d[k], balls[b], x[k], y[k], z[k]);
  for (std::size_t k = 0; k < kBlock; ++k) out[k] = d[k];
}

// A gyroid in a ball. GCC makes one call of the sine and the cosine of an argument, and then finds no vector
// form of it: so the compiler is kept from seeing that the arguments are the same.
SDF_INLINE float sheet(float sx, float sy, float sz, float cx, float cy, float cz, float radius) {
  return std::max(std::fabs(sx * cy + sy * cz + sz * cx) * 0.125f - 0.05f, radius - 1.5f);
}

void pointsS4(const float* __restrict x, const float* __restrict y, const float* __restrict z,
              float* __restrict out, std::size_t n) {
  for (std::size_t i = 0; i < n; i += kBlock, x += kBlock, y += kBlock, z += kBlock, out += kBlock) {
    float sx[kBlock], sy[kBlock], sz[kBlock];
    for (std::size_t k = 0; k < kBlock; ++k) sx[k] = std::sin(5 * x[k]);
    for (std::size_t k = 0; k < kBlock; ++k) sy[k] = std::sin(5 * y[k]);
    for (std::size_t k = 0; k < kBlock; ++k) sz[k] = std::sin(5 * z[k]);
    asm volatile("" : "+r"(x), "+r"(y), "+r"(z) : : "memory");
    for (std::size_t k = 0; k < kBlock; ++k)
      out[k] = sheet(sx[k], sy[k], sz[k], std::cos(5 * x[k]), std::cos(5 * y[k]), std::cos(5 * z[k]),
                     length(x[k], y[k], z[k]));
  }
}

void rowS4(float x, float y, const float* __restrict z, float* __restrict out, std::size_t n) {
  const float sx = std::sin(5 * x), sy = std::sin(5 * y), cx = std::cos(5 * x), cy = std::cos(5 * y);
  for (std::size_t i = 0; i < n; i += kBlock, z += kBlock, out += kBlock) {
    float sz[kBlock];
    for (std::size_t k = 0; k < kBlock; ++k) sz[k] = std::sin(5 * z[k]);
    asm volatile("" : "+r"(z) : : "memory");
    for (std::size_t k = 0; k < kBlock; ++k)
      out[k] = sheet(sx, sy, sz[k], cx, cy, std::cos(5 * z[k]), length(x, y, z[k]));
  }
}

template <class Shape>
void blockPoints(const float* __restrict x, const float* __restrict y, const float* __restrict z,
                 float* __restrict out, std::size_t n) {
  for (std::size_t i = 0; i < n; i += kBlock) block<Shape>(x + i, y + i, z + i, out + i);
}

template <class Shape>
void blockRow(float x, float y, const float* __restrict z, float* __restrict out, std::size_t n) {
  float xs[kBlock], ys[kBlock];
  for (std::size_t k = 0; k < kBlock; ++k) xs[k] = x, ys[k] = y;
  for (std::size_t i = 0; i < n; i += kBlock) block<Shape>(xs, ys, z + i, out + i);
}

}  // namespace

Handwritten handwritten(int i) {
  static constexpr Handwritten kAll[kShapes] = {
      {points<S1>, row<S1>}, {points<S2>, row<S2>},           {blockPoints<S3>, blockRow<S3>},
      {pointsS4, rowS4},     {blockPoints<S5>, blockRow<S5>}, {points<S6>, row<S6>},
      {points<S7>, row<S7>}};
  return kAll[i];
}

}  // namespace sdf::bench
