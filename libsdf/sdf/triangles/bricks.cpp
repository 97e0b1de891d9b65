#include "sdf/triangles/bricks.h"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <functional>
#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <map>
#include <utility>

#include "sdf/base/parallel.h"
#include "sdf/triangles/brick_samples.h"

namespace sdf {
namespace {

// Around the box distances are known, and not only bounds of them, so far, in voxels: what is rounded,
// blended or given a shell reaches out there.
int marginOf(int voxels) { return std::min(voxels / 4, 64); }

// A part that is farther off than this where it is looked at, in voxels, gets a brick of its own: room is
// left for where it is not. On the third level nothing whose slope is 1 is off by more than half a diagonal
// of a sixteenth.
constexpr double kFlawed = 0.06;
constexpr int kLevels = 3;
constexpr int kTable = kParts + 1;         // the bricks of a cube's parts, and its own
constexpr std::size_t kMostLayers = 2048;  // of the grid with the tables behind it: what all drivers have

std::size_t placeIn(const glm::ivec3& size, const glm::ivec3& at) {
  return (static_cast<std::size_t>(at.z) * size.y + at.y) * size.x + at.x;
}

void sampleGrid(const TriangleDistance& distance, Bricks& out) {
  const glm::ivec3 size = out.cells + 1;
  out.volumes[0].size = size;
  out.volumes[0].values.assign(2 * placeIn(size, {0, 0, size.z}), -1.0f);
  inParallel(static_cast<std::size_t>(size.z) * size.y, [&](std::size_t row) {
    DistanceAlong along(distance);
    const int y = static_cast<int>(row) % size.y, z = static_cast<int>(row) / size.y;
    for (int x = 0; x < size.x; ++x)
      out.volumes[0].values[2 * placeIn(size, {x, y, z})] =
          static_cast<float>(along(out.origin + kCell * out.voxel * glm::dvec3(x, y, z)).distance);
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

glm::ivec3 columnOf(const Bricks& b, std::size_t brick) {
  const auto i = static_cast<int>(brick);
  return {i % b.columns.x, i / b.columns.x % b.columns.y, i / (b.columns.x * b.columns.y)};
}

/// A cube that is to have a brick, and the texel of the grid that is to name it.
struct Wanted {
  Cube cube;
  std::size_t texel;
};

/// Of a cube that was sampled.
struct CubeError {
  std::size_t cube;
  PartError part;
};

/// Samples bricks, one level after the other.
class Sampler {
 public:
  Sampler(const TriangleDistance& distance, Bricks& out)
      : distance_(distance),
        out_(out),
        layer_(placeIn(grid().size, {0, 0, 1})),
        cells_(placeIn(grid().size, {0, 0, grid().size.z})) {}

  void run(std::vector<Wanted> wanted) {
    constexpr std::size_t kMore = 16384;
    const std::size_t most = 2 * wanted.size() + kMore;  // bricks: that bounds what they cost
    const int side = static_cast<int>(std::ceil(std::cbrt(static_cast<double>(most))));
    out_.columns = {side, side, 1};
    for (int level = 1; !wanted.empty(); ++level) {
      std::vector<CubeError> flaws = sample(wanted);
      const std::size_t room = level < kLevels ? most - out_.count : 0;
      if (flaws.size() > room)
        std::ranges::stable_sort(flaws, std::greater{}, [](const CubeError& e) { return e.part.worst; });
      wanted = finer(wanted, flaws, room);
    }
    out_.rms = volume_ > 0.0 ? std::sqrt(squares_ / volume_) : 0.0;
  }

 private:
  PayloadVolume& grid() { return out_.volumes[0]; }
  float& named(std::size_t texel) { return grid().values[2 * texel + 1]; }

  // Returns what is too far off.
  std::vector<CubeError> sample(const std::vector<Wanted>& wanted) {
    const std::size_t first = out_.count;
    out_.count += wanted.size();
    PayloadVolume& bricks = out_.volumes[1];
    out_.columns.z = columnOf(out_, out_.count).z + 1;
    bricks.size = kBrick * out_.columns;
    bricks.values.resize(placeIn(bricks.size, {0, 0, bricks.size.z}), 0.0f);
    std::vector<std::vector<PartError>> errors(wanted.size());
    inParallel(wanted.size(), [&](std::size_t i) { errors[i] = fill(first + i, wanted[i].cube); });
    std::vector<CubeError> flaws;
    for (std::size_t i = 0; i < wanted.size(); ++i) {
      named(wanted[i].texel) = static_cast<float>(first + i);
      for (const PartError& part : errors[i])
        isFlaw(part) ? flaws.push_back({i, part}) : count(part, partOf(wanted[i].cube, part.part));
    }
    return flaws;
  }

  // Where triangles cross there are kinks within the solid, too, which nobody sees.
  bool isFlaw(const PartError& part) const {
    return part.worst > kFlawed && (part.crossed || distance_.signBy() == SignBy::Normals);
  }

  std::vector<PartError> fill(std::size_t brick, const Cube& cube) {
    BrickSamples samples(distance_, out_.origin, out_.voxel, cube);
    PayloadVolume& bricks = out_.volumes[1];
    const glm::ivec3 first = kBrick * columnOf(out_, brick);
    for (int z = 0; z < kBrick; ++z)
      for (int y = 0; y < kBrick; ++y)
        for (int x = 0; x < kBrick; ++x)
          bricks.values[placeIn(bricks.size, first + glm::ivec3(x, y, z))] =
              static_cast<float>(samples.value({x, y, z}));
    return samples.errors();
  }

  void count(const PartError& error, const Cube& part) {
    const double volume = part.side * part.side * part.side;
    out_.worst = std::max(out_.worst, error.worst * out_.voxel);
    squares_ += volume * error.middle * error.middle * out_.voxel * out_.voxel;
    volume_ += volume;
  }

  // The first of the flaws become cubes of their own; where there is no room for them they stay.
  std::vector<Wanted> finer(const std::vector<Wanted>& cubes, const std::vector<CubeError>& flaws,
                            std::size_t room) {
    std::vector<Wanted> wanted;
    std::map<std::size_t, std::size_t> tables;  // of cubes
    for (const auto& [cube, part] : flaws) {
      const auto known = tables.find(cube);
      if (wanted.size() == room || (known == tables.end() && !hasRoomForATable())) {
        count(part, partOf(cubes[cube].cube, part.part));
        continue;
      }
      const std::size_t table = known != tables.end() ? known->second : addTable(cubes[cube].texel);
      tables.emplace(cube, table);
      wanted.push_back({partOf(cubes[cube].cube, part.part), table + static_cast<std::size_t>(part.part)});
    }
    return wanted;
  }

  std::size_t texelOf(std::size_t table) const { return cells_ + table * kTable; }
  bool hasRoomForATable() const { return texelOf(tables_ + 1) <= kMostLayers * layer_; }

  // In the place of the brick, which it names last; returns its first texel.
  std::size_t addTable(std::size_t texel) {
    const std::size_t first = texelOf(tables_), layers = texelOf(tables_ + 1) / layer_ + 1;
    grid().size.z = static_cast<int>(layers);
    grid().values.resize(2 * layers * layer_, -1.0f);
    named(first + kParts) = named(texel);
    named(texel) = -2.0f - static_cast<float>(tables_++);
    return first;
  }

  const TriangleDistance& distance_;
  Bricks& out_;
  std::size_t layer_, cells_;  // texels of one layer of the grid, and before the tables
  std::size_t tables_ = 0;
  double squares_ = 0.0, volume_ = 0.0;
};

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
  out.cells = glm::ivec3(glm::ceil((sides / out.voxel + 2.0 * marginOf(voxels)) / double{kCell}));
  out.origin = 0.5 * (distance.min() + distance.max()) - 0.5 * kCell * out.voxel * glm::dvec3(out.cells);
  sampleGrid(distance, out);
  std::vector<Wanted> wanted;
  for (const glm::ivec3& cell : cellsNear(out))
    wanted.push_back({{glm::dvec3(kCell * cell), double{kCell}}, placeIn(out.cells + 1, cell)});
  Sampler(distance, out).run(std::move(wanted));
  return out;
}

// The interpolated values: a distance less |x|^2 / (2 D) is concave where it is D or more, and so no less
// than interpolation between corners makes of it (Jensen's inequality); of |x|^2 that is too large by 3 s^2 /
// 4 at most. Nothing is subtracted for that: blends would show a step where bricks end. Outside of the grid's
// box, whose nearest point is c, the surface is sqrt(|p - c|^2 + f(c)^2) away or more, for the box is convex
// and has it inside. A number below -1 is not that of a brick but of a table, of those of the cube's parts.
std::string Bricks::glsl(const std::string& name) const {
  const bool hasTables = volumes[0].size.z > cells.z + 1;
  const std::string reading = R"(
float NAMENamed(int i) {
  i += TABLES;
  return texelFetch(NAMEGrid, ivec3(i % GRID_X, i / GRID_X % GRID_Y, i / (GRID_X * GRID_Y)), 0).y;
}
)",
                    descent = R"(
  for (int level = 1; level < LEVELS && brick < -1.0; ++level) {
    vec3 part = min(floor(PARTS * at), PARTS - 1.0);
    int table = TABLE_SIZE * int(-2.0 - brick);
    float finer = NAMENamed(table + int(dot(part, vec3(1.0, PARTS, PARTS * PARTS))));
    at = finer == -1.0 ? at : PARTS * at - part;
    brick = finer == -1.0 ? NAMENamed(table + TABLE_SIZE - 1) : finer;
  }
)";
  std::string text = R"(
uniform sampler3D NAMEGrid, NAMEBricks;
READING
float NAME(vec3 p) {
  vec3 q = (p - ORIGIN) * PER_CELL, c = clamp(q, vec3(0.0), CELLS), low = min(floor(c), CELLS - 1.0);
  vec3 gap = (q - c) * CELL, at = c - low;
  float brick = texelFetch(NAMEGrid, ivec3(low), 0).y, f;
DESCENT  if (brick < 0.0) {
    f = textureLod(NAMEGrid, (c + 0.5) / GRID, 0.0).x;
  } else {
    int i = int(brick);
    vec3 column = vec3(i % COLUMNS, i / COLUMNS % COLUMNS, i / (COLUMNS * COLUMNS));
    f = VOXEL * textureLod(NAMEBricks, (SIDE * column + (SIDE - 1.0) * at + 0.5) / SIZE, 0.0).x;
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
  const std::pair<std::string, std::string> words[] = {
      {"READING", hasTables ? reading : ""},
      {"DESCENT", hasTables ? descent : ""},
      {"NAME", name},
      {"TABLE_SIZE", std::to_string(kTable)},
      {"TABLES", std::to_string((cells.x + 1) * (cells.y + 1) * (cells.z + 1))},
      {"LEVELS", std::to_string(kLevels)},
      {"PARTS", number(kCell)},
      {"GRID_X", std::to_string(volumes[0].size.x)},
      {"GRID_Y", std::to_string(volumes[0].size.y)},
      {"GRID", vector(glm::dvec3(volumes[0].size))},
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
