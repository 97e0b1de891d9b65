#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <limits>
#include <utility>

#include "meshes.h"

namespace sdf::accuracy {
namespace {

bool isMultiple(int i, int of) { return i % of == 0; }

// Is there a node at (x, y, z) quarters of a cell?
bool isNode(Struts kind, const glm::ivec3& p) {
  int off[3];  // from the nearest corner of a cube
  for (int k = 0; k < 3; ++k) off[k] = std::min((p[k] % 4 + 4) % 4, 4 - (p[k] % 4 + 4) % 4);
  std::ranges::sort(off);
  switch (kind) {
    case Struts::Cubic:
      return off[2] == 0;
    case Struts::BodyCentred:
      return off[2] == 0 || off[0] == 2;
    case Struts::Octet:
      return std::ranges::all_of(off, [](int i) { return isMultiple(i, 2); }) &&
             isMultiple(p.x + p.y + p.z, 4);
    case Struts::Kelvin:
      return off[0] == 0 && off[1] == 1 && off[2] == 2;
  }
  return false;
}

double lengthOf(Struts kind) {
  switch (kind) {
    case Struts::Cubic:
      return 1.0;
    case Struts::BodyCentred:
      return std::sqrt(0.75);
    case Struts::Octet:
      return std::sqrt(0.5);
    case Struts::Kelvin:
      break;
  }
  return std::sqrt(0.125);
}

// Ends of struts near the cube [-1/2, 1/2]^3; no point of it is half a cell from all struts.
std::vector<std::pair<glm::dvec3, glm::dvec3>> strutsNear(Struts kind) {
  constexpr int kReach = 6;
  std::vector<glm::dvec3> nodes;
  for (int x = -kReach; x <= kReach; ++x)
    for (int y = -kReach; y <= kReach; ++y)
      for (int z = -kReach; z <= kReach; ++z)
        if (isNode(kind, {x, y, z})) nodes.push_back(0.25 * glm::dvec3(x, y, z));
  const auto isNear = [](const glm::dvec3& p) {
    return std::max({std::abs(p.x), std::abs(p.y), std::abs(p.z)}) < 1.0;
  };
  std::vector<std::pair<glm::dvec3, glm::dvec3>> struts;
  for (std::size_t i = 0; i < nodes.size(); ++i)
    for (std::size_t k = 0; k < i; ++k)
      if (std::abs(glm::distance(nodes[i], nodes[k]) - lengthOf(kind)) < 1e-9 &&
          isNear(0.5 * (nodes[i] + nodes[k])))
        struts.emplace_back(nodes[i], nodes[k]);
  return struts;
}

// Distance to the nearest of a list of struts, of p in radians of the period.
template <Struts kind>
double toStruts(const glm::dvec3& p) {
  static const std::vector<std::pair<glm::dvec3, glm::dvec3>> struts = strutsNear(kind);
  glm::dvec3 at = p / (2.0 * kPi);
  at -= glm::round(at);
  double least = std::numeric_limits<double>::infinity();
  for (const auto& [a, b] : struts) {
    const glm::dvec3 way = b - a, from = at - a;
    const double t = std::clamp(glm::dot(from, way) / glm::dot(way, way), 0.0, 1.0);
    const glm::dvec3 off = from - t * way;
    least = std::min(least, glm::dot(off, off));
  }
  return 2.0 * kPi * std::sqrt(least);
}

}  // namespace

Tessellation strutsMesh(Struts kind, double cell, double radius, int cellsAPeriod) {
  double (*const values[])(const glm::dvec3&) = {toStruts<Struts::Octet>, toStruts<Struts::Cubic>,
                                                 toStruts<Struts::BodyCentred>, toStruts<Struts::Kelvin>};
  // Where struts meet the distance bends sharply.
  const Wave distance{values[static_cast<int>(kind)], 1.0, std::numeric_limits<double>::infinity()};
  return filled(distance, cell, 2.0 * kPi * radius / cell, cellsAPeriod);
}

}  // namespace sdf::accuracy
