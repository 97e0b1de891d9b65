#include "sdf/triangles/bricks.h"

#include <algorithm>
#include <atomic>
#include <cmath>
#include <cstdio>
#include <functional>
#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <thread>
#include <utility>

namespace sdf {
namespace {

constexpr int kCell = 4, kBrick = kCell + 1;  // voxels of a cell's side; samples of a brick's
constexpr double kHalfDiagonal = 0.8660254038;
constexpr int kMargin = 2;  // voxels around the box

/// Calls work(i) for each i below count, on all cores.
void inParallel(std::size_t count, const std::function<void(std::size_t)>& work) {
  std::atomic<std::size_t> next{0};
  const auto run = [&] {
    for (std::size_t i; (i = next++) < count;) work(i);
  };
  std::vector<std::jthread> others;
  for (unsigned i = 1; i < std::max(std::thread::hardware_concurrency(), 1u); ++i) others.emplace_back(run);
  run();
}

/// Reads the distance at points one after the other, each near the one before.
class Along {
 public:
  explicit Along(const TriangleDistance& distance) : distance_(distance) {}
  double operator()(const glm::dvec3& p) {
    const TriangleDistance::Read read = distance_.read(p, hint_);
    hint_ = read.triangle;
    return read.distance;
  }

 private:
  const TriangleDistance& distance_;
  std::uint32_t hint_ = 0;
};

std::size_t placeIn(const glm::ivec3& size, const glm::ivec3& at) {
  return (static_cast<std::size_t>(at.z) * size.y + at.y) * size.x + at.x;
}

void sampleGrid(const TriangleDistance& distance, Bricks& out) {
  const glm::ivec3 size = out.cells + 1;
  out.volumes[0].size = size;
  out.volumes[0].values.assign(2 * placeIn(size, {0, 0, size.z}), -1.0f);
  inParallel(static_cast<std::size_t>(size.z) * size.y, [&](std::size_t row) {
    Along along(distance);
    const int y = static_cast<int>(row) % size.y, z = static_cast<int>(row) / size.y;
    for (int x = 0; x < size.x; ++x)
      out.volumes[0].values[2 * placeIn(size, {x, y, z})] =
          static_cast<float>(along(out.origin + kCell * out.voxel * glm::dvec3(x, y, z)));
  });
}

/// The cells that may hold points within a cell's side of the surface: |f| changes by no more than the way.
std::vector<glm::ivec3> cellsNear(const Bricks& b) {
  const double reach = (2.0 * kHalfDiagonal + 1.0) * kCell * b.voxel;  // from the corner
  std::vector<glm::ivec3> near;
  for (int z = 0; z < b.cells.z; ++z)
    for (int y = 0; y < b.cells.y; ++y)
      for (int x = 0; x < b.cells.x; ++x) {
        double least = HUGE_VAL, most = 0.0;
        for (int c = 0; c < 8; ++c) {
          const glm::ivec3 at(x + (c & 1), y + (c >> 1 & 1), z + (c >> 2));
          const double f = std::abs(b.volumes[0].values[2 * placeIn(b.cells + 1, at)]);
          least = std::min(least, f), most = std::max(most, f);
        }
        // The point nearest to the surface is within half a diagonal of some corner.
        if (least < (kHalfDiagonal + 1.0) * kCell * b.voxel && most < reach) near.emplace_back(x, y, z);
      }
  return near;
}

struct Errors {
  double worst = 0.0, squares = 0.0;
  std::size_t count = 0;
};

glm::ivec3 columnOf(const Bricks& b, std::size_t brick) {
  const auto i = static_cast<int>(brick);
  return {i % b.columns.x, i / b.columns.x % b.columns.y, i / (b.columns.x * b.columns.y)};
}

/// Fills a brick, and looks how far off its interpolation is in the middle of its voxels.
Errors sampleBrick(const TriangleDistance& distance, const glm::ivec3& cell, std::size_t brick, Bricks& out) {
  Along along(distance);
  const glm::ivec3 first = kBrick * columnOf(out, brick);
  const auto at = [&](const glm::dvec3& voxels) {
    return along(out.origin + out.voxel * (glm::dvec3(kCell * cell) + voxels)) / out.voxel;
  };
  double f[kBrick][kBrick][kBrick];
  for (int z = 0; z < kBrick; ++z)
    for (int y = 0; y < kBrick; ++y)
      for (int k = 0; k < kBrick; ++k) {
        const int x = y % 2 == 0 ? k : kBrick - 1 - k;
        f[z][y][x] = at({x, y, z});
        out.volumes[1].values[placeIn(out.volumes[1].size, first + glm::ivec3(x, y, z))] =
            static_cast<float>(f[z][y][x]);
      }
  Errors errors;
  for (int z = 0; z < kCell; ++z)
    for (int y = 0; y < kCell; ++y)
      for (int x = 0; x < kCell; ++x) {
        double mean = 0.0;
        for (int c = 0; c < 8; ++c) mean += 0.125 * f[z + (c >> 2)][y + (c >> 1 & 1)][x + (c & 1)];
        if (std::abs(mean) > 1.0) continue;
        const double off = std::abs(at(glm::dvec3(x, y, z) + 0.5) - mean);
        errors.worst = std::max(errors.worst, off);
        errors.squares += off * off;
        ++errors.count;
      }
  return errors;
}

std::string number(double v) {
  char text[40];
  std::snprintf(text, sizeof text, "float(%.9g)", v);
  return text;
}

std::string vector(const glm::dvec3& v) {
  return "vec3(" + number(v.x) + ", " + number(v.y) + ", " + number(v.z) + ")";
}

}  // namespace

Bricks bricksOf(const TriangleDistance& distance, int voxels) {
  Bricks out;
  const glm::dvec3 sides = distance.max() - distance.min();
  out.voxel = std::max({sides.x, sides.y, sides.z}) / voxels;
  out.cells = glm::ivec3(glm::ceil((sides / out.voxel + 2.0 * kMargin) / double{kCell}));
  out.origin = 0.5 * (distance.min() + distance.max()) - 0.5 * kCell * out.voxel * glm::dvec3(out.cells);
  sampleGrid(distance, out);
  const std::vector<glm::ivec3> near = cellsNear(out);
  out.count = near.size();
  const int side = std::max(static_cast<int>(std::ceil(std::cbrt(static_cast<double>(out.count)))), 1);
  const int rows = static_cast<int>(out.count) / (side * side) + 1;
  out.columns = {side, side, rows};
  const glm::ivec3 size = kBrick * out.columns;
  out.volumes[1].size = size;
  out.volumes[1].values.assign(placeIn(size, {0, 0, size.z}), 0.0f);
  std::vector<Errors> errors(near.size());
  inParallel(near.size(), [&](std::size_t i) { errors[i] = sampleBrick(distance, near[i], i, out); });
  Errors all;
  for (std::size_t i = 0; i < near.size(); ++i) {
    out.volumes[0].values[2 * placeIn(out.cells + 1, near[i]) + 1] = static_cast<float>(i);
    all.worst = std::max(all.worst, errors[i].worst);
    all.squares += errors[i].squares;
    all.count += errors[i].count;
  }
  out.worst = all.worst * out.voxel;
  out.rms = all.count > 0 ? std::sqrt(all.squares / static_cast<double>(all.count)) * out.voxel : 0.0;
  return out;
}

// The interpolated values: a distance less |x|^2 / (2 D) is concave where it is D or more, and so no less
// than interpolation between corners makes of it (Jensen's inequality); of |x|^2 that is too large by 3 s^2 /
// 4 at most. Nothing is subtracted for that: blends would show a step where bricks end. Outside of the grid's
// box, whose nearest point is c, the surface is sqrt(|p - c|^2 + f(c)^2) away or more, for the box is convex
// and has it inside.
std::string Bricks::glsl(const std::string& name) const {
  std::string text = R"(
uniform sampler3D NAMEGrid, NAMEBricks;

float NAME(vec3 p) {
  vec3 q = (p - ORIGIN) * PER_CELL, c = clamp(q, vec3(0.0), CELLS), low = min(floor(c), CELLS - 1.0);
  vec3 gap = (q - c) * CELL;
  float brick = texelFetch(NAMEGrid, ivec3(low), 0).y, f;
  if (brick < 0.0) {
    f = textureLod(NAMEGrid, (c + 0.5) / (CELLS + 1.0), 0.0).x;
  } else {
    int i = int(brick);
    vec3 column = vec3(i % COLUMNS, i / COLUMNS % COLUMNS, i / (COLUMNS * COLUMNS));
    f = VOXEL * textureLod(NAMEBricks, (SIDE * column + (SIDE - 1.0) * (c - low) + 0.5) / SIZE, 0.0).x;
  }
  return gap == vec3(0.0) ? f : sqrt(f * f + dot(gap, gap));
}

vec3 NAMESlopes(vec3 p) {
  vec3 sum = vec3(0.0);
  for (int i = 0; i < 4; ++i) {
    vec3 corner = vec3(float(((i + 3) >> 1) & 1), float((i >> 1) & 1), float(i & 1)) * 2.0 - 1.0;
    sum += corner * NAME(p + 0.5 * VOXEL * corner);
  }
  return sum / (2.0 * VOXEL);
}
)";
  const std::pair<std::string, std::string> words[] = {{"NAME", name},
                                                       {"ORIGIN", vector(origin)},
                                                       {"PER_CELL", number(1.0 / (kCell * voxel))},
                                                       {"CELLS", vector(glm::dvec3(cells))},
                                                       {"CELL", number(kCell * voxel)},
                                                       {"COLUMNS", std::to_string(columns.x)},
                                                       {"VOXEL", number(voxel)},
                                                       {"SIDE", number(kBrick)},
                                                       {"SIZE", vector(glm::dvec3(volumes[1].size))}};
  for (const auto& [word, with] : words)
    for (std::size_t at; (at = text.find(word)) != std::string::npos;) text.replace(at, word.size(), with);
  return text;
}

}  // namespace sdf
