#include "sdf/mesh/measure/search.h"

#include <algorithm>
#include <bit>
#include <cmath>
#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <numbers>
#include <numeric>
#include <utility>

#include "sdf/base/box.h"
#include "sdf/mesh/measure/find_surface.h"
#include "sdf/mesh/measure/read_values.h"

namespace sdf {
namespace {

constexpr std::size_t kSteps = 16;
constexpr int kBits = 20, kMostBits = 5;  // of where it is in a step, and of those found by one reading

std::vector<std::size_t> allOf(std::size_t count) {
  std::vector<std::size_t> all(count);
  std::iota(all.begin(), all.end(), std::size_t{0});
  return all;
}

// How many points to read for each of so many: what fills a batch, and more only of what is read anyway.
std::size_t pointsForEach(std::size_t count, std::size_t most) {
  return std::clamp(kBatchPoints / count, std::size_t{1}, most);
}

// For each of these ways, the first of so many points, along(i, k) from where it begins, that is across, or
// their number.
template <class Along>
std::vector<std::size_t> firstAcross(const PointRun& run, const std::vector<Way>& ways,
                                     const std::vector<std::size_t>& which, std::size_t count,
                                     const Along& along) {
  std::vector<std::size_t> first(which.size(), count);
  readValues(
      run.batch, *run.tapes.distance, which.size() * count,
      [&](std::size_t k) {
        const std::size_t i = which[k / count];
        return ways[i].from + along(i, k % count) * ways[i].direction;
      },
      [&](std::size_t k, float value) {
        std::size_t& found = first[k / count];
        if (found == count && isAcross(value, ways[which[k / count]].inside)) found = k % count;
      });
  return first;
}

// The piece of a way in which the sign changes: from `near` on, which is on the point's side.
struct Piece {
  double near = 0.0, width = kInfinity;  // along the direction; none where infinite
};

// Steps to one side and the other, from the nearest on.
std::vector<Piece> piecesOf(const PointRun& run, const std::vector<Way>& ways) {
  std::vector<Piece> pieces(ways.size());
  std::vector<std::size_t> open = allOf(ways.size()), rest;
  const auto pieceOf = [&](std::size_t i, std::size_t step) {
    const double width = (step % 2 == 0 ? 1.0 : -1.0) * ways[i].reach / kSteps;
    return Piece{width * static_cast<double>(step / 2), width};
  };
  for (std::size_t step = 0; step < 2 * kSteps && !open.empty();) {
    const std::size_t count = pointsForEach(open.size(), 2 * kSteps - step);
    const std::vector<std::size_t> first =
        firstAcross(run, ways, open, count, [&](std::size_t i, std::size_t k) {
          const Piece piece = pieceOf(i, step + k);
          return piece.near + piece.width;
        });
    rest.clear();
    for (std::size_t k = 0; k < open.size(); ++k) {
      if (first[k] < count)
        pieces[open[k]] = pieceOf(open[k], step + first[k]);
      else
        rest.push_back(open[k]);
    }
    std::swap(open, rest);
    step += count;
  }
  return pieces;
}

}  // namespace

std::vector<glm::dvec3> allAround(const glm::dvec3& way, int count, double turned) {
  const glm::dvec3 size = glm::abs(way);
  glm::dvec3 least(0.0);  // the axis that it leads along the least
  least[size.x <= size.y && size.x <= size.z ? 0 : size.y <= size.z ? 1 : 2] = 1.0;
  const glm::dvec3 u = glm::normalize(glm::cross(way, least)), v = glm::cross(way, u);
  std::vector<glm::dvec3> all;
  for (int k = 0; k < count; ++k) {
    const double turn = (k + turned) * 2.0 * std::numbers::pi / count;
    all.push_back(std::cos(turn) * u + std::sin(turn) * v);
  }
  return all;
}

std::vector<Met> meetAlong(const PointRun& run, const std::vector<Way>& ways) {
  std::vector<Piece> pieces = piecesOf(run, ways);
  std::vector<std::size_t> found;
  for (std::size_t i = 0; i < ways.size(); ++i)
    if (pieces[i].width != kInfinity) found.push_back(i);
  for (int bits = 0; bits < kBits && !found.empty();) {
    const int more = std::clamp(static_cast<int>(std::bit_width(kBatchPoints / found.size() + 1)) - 1, 1,
                                std::min(kMostBits, kBits - bits));
    for (const std::size_t i : found) pieces[i].width = std::ldexp(pieces[i].width, -more);
    const std::vector<std::size_t> first =
        firstAcross(run, ways, found, (std::size_t{1} << more) - 1, [&](std::size_t i, std::size_t k) {
          return pieces[i].near + static_cast<double>(k + 1) * pieces[i].width;
        });
    for (std::size_t k = 0; k < found.size(); ++k)
      pieces[found[k]].near += static_cast<double>(first[k]) * pieces[found[k]].width;
    bits += more;
  }
  std::vector<Met> met(ways.size());
  for (const std::size_t i : found) {
    const double t = pieces[i].near + pieces[i].width;
    met[i] = {std::abs(t), std::copysign(1.0, t) * ways[i].direction};
  }
  return met;
}

namespace {

// Samples of the lattice around the one nearest to a point, itself first.
std::vector<glm::dvec3> samplesAround() {
  const int reach = static_cast<int>(std::ceil(kFarthestVoxels));
  std::vector<glm::dvec3> samples;
  for (int x = -reach; x <= reach; ++x)
    for (int y = -reach; y <= reach; ++y)
      for (int z = -reach; z <= reach; ++z) samples.emplace_back(x, y, z);
  std::stable_sort(samples.begin(), samples.end(),
                   [](const glm::dvec3& a, const glm::dvec3& b) { return glm::dot(a, a) < glm::dot(b, b); });
  return samples;
}

}  // namespace

std::vector<Met> meetAround(const PointRun& run, const std::vector<Way>& points) {
  constexpr double kHalfDiagonal =
      0.8660254037844387;  // of a voxel: from a point to the sample nearest to it
  static const std::vector<glm::dvec3> samples = samplesAround();
  std::vector<double> nearest(points.size(), kFarthestVoxels * run.voxel);
  std::vector<Way> ways = points;
  std::vector<bool> found(points.size());
  std::vector<std::size_t> open = allOf(points.size());
  for (std::size_t first = 0, count = 0; first < samples.size(); first += count) {
    const double least = (glm::length(samples[first]) - kHalfDiagonal) * run.voxel;
    std::erase_if(open, [&](std::size_t i) { return nearest[i] <= least; });
    if (open.empty()) break;
    count = pointsForEach(open.size(), samples.size() - first);
    const auto at = [&](std::size_t k) {
      const glm::dvec3 lattice =
          glm::round(points[open[k / count]].from / run.voxel) + samples[first + k % count];
      return glm::dvec3(glm::vec3(lattice * run.voxel));
    };
    readValues(run.batch, *run.tapes.distance, open.size() * count, at, [&](std::size_t k, float value) {
      const std::size_t i = open[k / count];
      const glm::dvec3 way = at(k) - points[i].from;
      const double length = glm::length(way);
      if (!isAcross(value, points[i].inside) || !(length <= nearest[i])) return;
      found[i] = true;
      nearest[i] = ways[i].reach = length;
      if (length > 0.0) ways[i].direction = way / length;
    });
  }
  std::vector<Way> toSamples;
  std::vector<std::size_t> which;
  std::vector<Met> met(points.size());
  for (std::size_t i = 0; i < points.size(); ++i) {
    if (!found[i]) continue;
    met[i] = {nearest[i], ways[i].direction};
    if (nearest[i] > 0.0) which.push_back(i), toSamples.push_back(ways[i]);
  }
  const std::vector<Met> along = meetAlong(run, toSamples);
  for (std::size_t k = 0; k < which.size(); ++k) met[which[k]] = nearer(met[which[k]], along[k]);
  return met;
}

std::vector<Met> meetAllAround(const PointRun& run, const std::vector<Way>& points, int fineness) {
  std::vector<glm::dvec3> lines;
  for (int x = -fineness; x <= fineness; ++x)
    for (int y = -fineness; y <= fineness; ++y)
      for (int z = -fineness; z <= fineness; ++z) {
        const bool isOutermost = std::max({std::abs(x), std::abs(y), std::abs(z)}) == fineness;
        const bool isSecondEnd = x > 0 || (x == 0 && (y > 0 || (y == 0 && z > 0)));
        if (isOutermost && isSecondEnd) lines.push_back(glm::normalize(glm::dvec3(x, y, z)));
      }
  std::vector<Way> ways;
  for (const Way& point : points)
    for (const glm::dvec3& line : lines) ways.push_back({point.from, point.inside, line, point.reach});
  const std::vector<Met> along = meetAlong(run, ways);
  std::vector<Met> met(points.size());
  for (std::size_t i = 0; i < along.size(); ++i) {
    Met& m = met[i / lines.size()];
    m = nearer(m, along[i]);
  }
  return met;
}

std::vector<Met> meetNearer(const PointRun& run, const std::vector<Way>& points, std::vector<Met> met) {
  // The gradient is read a little before the surface, where a field that is flat on it has one.
  constexpr double kBefore = 1.0 - 0x1p-6, kWorthwhile = 0.99;
  constexpr int kRounds = 8;
  std::vector<std::size_t> open;
  for (std::size_t i = 0; i < met.size(); ++i)
    if (met[i].distance > 0.0 && met[i].distance < kInfinity) open.push_back(i);
  for (int round = 0; round < kRounds && !open.empty(); ++round) {
    PointRows at, gradients;
    float values[kBatchPoints];
    for (std::size_t k = 0; k < open.size(); ++k) {
      const Met& m = met[open[k]];
      at.set(k, glm::vec3(points[open[k]].from + kBefore * m.distance * m.direction));
    }
    run.batch.evaluateGradient(*run.tapes.distance, at.rows(), open.size(), values, gradients.x, gradients.y,
                               gradients.z);
    std::vector<std::size_t> which;
    std::vector<Way> ways;
    for (std::size_t k = 0; k < open.size(); ++k) {
      const Way& point = points[open[k]];
      const glm::dvec3 normal = glm::normalize(glm::dvec3(gradients.at(k)));
      if (!std::isfinite(normal.x + normal.y + normal.z)) continue;
      which.push_back(open[k]);
      ways.push_back({point.from, point.inside, normal, met[open[k]].distance});
    }
    const std::vector<Met> along = meetAlong(run, ways);
    open.clear();
    for (std::size_t k = 0; k < which.size(); ++k) {
      Met& m = met[which[k]];
      if (along[k].distance < kWorthwhile * m.distance) open.push_back(which[k]);
      m = nearer(m, along[k]);
    }
  }
  return met;
}

std::vector<Met> meetBeside(const PointRun& run, const std::vector<Way>& points, std::vector<Met> met) {
  constexpr int kSides = 6;
  constexpr double kFirst = 0.5, kLast = 0x1p-7;  // tangents of the angles to a direction
  constexpr double kWorthwhile = 0.999;
  std::vector<double> aside(points.size(), kFirst);
  std::vector<std::size_t> open;
  for (std::size_t i = 0; i < met.size(); ++i)
    if (met[i].distance > 0.0 && met[i].distance < kInfinity) open.push_back(i);
  for (int round = 0; !open.empty(); ++round) {
    std::vector<Way> ways;
    for (const std::size_t i : open) {
      const glm::dvec3 way = met[i].direction;
      for (const glm::dvec3& side : allAround(way, kSides, 0.5 * (round % 2)))
        ways.push_back(
            {points[i].from, points[i].inside, glm::normalize(way + aside[i] * side), met[i].distance});
    }
    const std::vector<Met> along = meetAlong(run, ways);
    for (std::size_t k = 0; k < open.size(); ++k) {
      Met& m = met[open[k]];
      const double before = m.distance;
      for (int side = 0; side < kSides; ++side) m = nearer(m, along[kSides * k + side]);
      if (!(m.distance < kWorthwhile * before)) aside[open[k]] /= 2.0;
    }
    std::erase_if(open, [&](std::size_t i) { return aside[i] < kLast || !(met[i].distance > 0.0); });
  }
  return met;
}

}  // namespace sdf
