// Where a fan's distances are read.
#pragma once
#include <algorithm>
#include <cmath>
#include <cstdint>
#include <glm/geometric.hpp>
#include <span>

#include "sdf/mesh/refine/remesh_fans.h"

namespace sdf {

/// Beside creases the field is read so many tolerances inside the triangle, where it is the triangle's own
/// side's: a crease is at most one tolerance beside the mesh's.
inline constexpr float kBeside = 4.0f;

/// A distance to be read at `at` for the point `of` of the mesh, which moves by `weight` times what the
/// centre does.
struct FanSample {
  enum Kind { Centre, Centroid, Inner, Spoke };
  Kind kind;
  glm::vec3 of, at;
  float weight;
  std::uint32_t triangle;  // of the fan
};

/// Triangles with sides longer than `spacing` are looked at in between, too, so many times along a side at
/// most.
inline constexpr int kMostSteps = 8;

/// What was read: signed distance at FanSample::of, and the unit gradient.
struct Reading {
  float distance;
  glm::vec3 normal;
};

/// Sides of a crease that meet at less than 5 degrees (cosine) are one.
inline constexpr float kOneSide = 0.9962f;

/// The area vector, twice as long as the triangle is large; whether its least height is above a share of the
/// tolerance, or of its longest side where that is less, and above the corners' rounding.
struct Facet {
  glm::vec3 area;
  float size;
  bool sound;
  Facet(const glm::vec3& a, const glm::vec3& b, const glm::vec3& c, float tolerance)
      : area(glm::cross(b - a, c - a)), size(glm::length(area)) {
    constexpr float kHeight = 0.02f, kSlender = 0.05f, kRounding = 16.0f * 0x1p-24f;
    const float longest =
        std::sqrt(std::max({glm::dot(b - a, b - a), glm::dot(c - b, c - b), glm::dot(a - c, a - c)}));
    const float scale = std::max({std::abs(a.x), std::abs(a.y), std::abs(a.z), longest});
    sound = size > longest * std::max(std::min(kHeight * tolerance, kSlender * longest), kRounding * scale);
  }
};

/// The least step that moves by s along a and by t along b, which are unit and not parallel.
inline glm::vec3 leastStep(const glm::vec3& a, const glm::vec3& b, float s, float t) {
  const float c = glm::dot(a, b), det = 1.0f - c * c;
  return ((s - c * t) * a + (t - c * s) * b) / det;
}

/// From a fan's centre to the surface, or to the crease, by a reading for each sector.
inline glm::vec3 stepOnto(std::span<const Reading> centres) {
  if (centres.empty()) return glm::vec3(0.0f);
  const Reading &a = centres.front(), &b = centres.back();
  if (centres.size() == 2 && std::abs(glm::dot(a.normal, b.normal)) < kOneSide)
    return leastStep(a.normal, b.normal, -a.distance, -b.distance);
  return -a.distance * a.normal;
}

/// One fan with its rim at hand.
struct FanView {
  const Fan& fan;
  std::span<const Fans::Spoke> rim;
  float beside, spacing;

  FanView(const Fans& fans, std::size_t i, float tolerance, float spacing)
      : fan(fans.all[i]),
        rim(fans.rim.data() + fan.first, fan.count),
        beside(kBeside * tolerance),
        spacing(spacing) {}

  const glm::vec3& end(std::uint32_t i) const { return rim[i].end; }
  std::uint32_t after(std::uint32_t i) const { return i + 1 == fan.count ? 0 : i + 1; }
  glm::vec3 centroid(std::uint32_t i) const { return (fan.centre + end(i) + end(after(i))) / 3.0f; }
  bool hasCentre() const { return fan.closed && fan.centred; }

  // From a point of the mesh on a crease a little into one triangle beside it, at right angles to `along`.
  glm::vec3 besideOf(const glm::vec3& p, const glm::vec3& along, std::uint32_t triangle) const {
    glm::vec3 way = centroid(triangle) - p;
    if (const float l = glm::dot(along, along); l > 0.0f) way -= along * (glm::dot(way, along) / l);
    const float length = glm::length(way);
    return length > beside ? p + way * (beside / length) : p + way;
  }

  // Calls take(sample) for those at the centre, one for each sector.
  template <class Take>
  void forEachCentre(const Take& take) const {
    if (!hasCentre()) return;
    if (fan.creases == 0) return take(FanSample{FanSample::Centre, fan.centre, fan.centre, 1.0f, 0});
    forEachSector([&](std::uint32_t first, std::uint32_t count) {
      const std::uint32_t middle = (first + count / 2) % fan.count;
      take(FanSample{FanSample::Centre, fan.centre, besideOf(fan.centre, glm::vec3(0.0f), middle), 1.0f,
                     middle});
    });
  }
  std::size_t centres() const { return hasCentre() ? std::max(1u, fan.creases) : 0; }

  // Calls take(sample) for each: at the centre; in each triangle; on each spoke, creases from either side.
  template <class Take>
  void forEachSample(const Take& take) const {
    const std::uint32_t n = fan.triangles();
    forEachCentre(take);
    for (std::uint32_t i = 0; i < n; ++i) {
      const glm::vec3 c = centroid(i);
      take(FanSample{FanSample::Centroid, c, c, 1.0f / 3.0f, i});
      forEachInner(i, take);
    }
    const std::uint32_t begin = fan.closed ? 0 : 1, spokes = fan.closed ? fan.count : fan.count - 1;
    for (std::uint32_t i = begin; i < spokes; ++i) {
      const glm::vec3 p = 0.5f * (fan.centre + end(i)), along = end(i) - fan.centre;
      const std::uint32_t before = i == 0 ? fan.count - 1 : i - 1;
      if (!rim[i].crease) {
        take(FanSample{FanSample::Spoke, p, p, 0.5f, i});
        continue;
      }
      take(FanSample{FanSample::Spoke, p, besideOf(p, along, i), 0.5f, i});
      take(FanSample{FanSample::Spoke, p, besideOf(p, along, before), 0.5f, before});
    }
  }

  int steps(std::uint32_t i) const {
    const glm::vec3 &a = end(i), &b = end(after(i));
    const float longest =
        std::max({glm::distance(fan.centre, a), glm::distance(fan.centre, b), glm::distance(a, b)});
    // A centre that is no number, which no fan is sound with, gets one step.
    return longest > spacing ? static_cast<int>(std::min(std::ceil(longest / spacing), 1.0f * kMostSteps))
                             : 1;
  }

  // The nodes of a grid inside the triangle; three steps have one, which is its centroid.
  static constexpr int kLeastSteps = 4;
  template <class Take>
  void forEachInner(std::uint32_t i, const Take& take) const {
    const int n = steps(i);
    if (n < kLeastSteps) return;
    for (int j = 1; j < n; ++j)
      for (int k = 1; j + k < n; ++k) {
        const float u = static_cast<float>(j) / static_cast<float>(n),
                    v = static_cast<float>(k) / static_cast<float>(n), w = 1.0f - u - v;
        const glm::vec3 p = w * fan.centre + u * end(i) + v * end(after(i));
        take(FanSample{FanSample::Inner, p, p, w, i});
      }
  }

  // Calls take(first triangle, number of triangles) for each sector, from the first crease on.
  template <class Take>
  void forEachSector(const Take& take) const {
    std::uint32_t i = 0;
    while (i < fan.count && !rim[i].crease) ++i;
    for (std::uint32_t k = 0; k < fan.creases; ++k) {
      std::uint32_t n = 1;
      while (!rim[(i + n) % fan.count].crease) ++n;
      take(i, n);
      i = (i + n) % fan.count;
    }
  }

  std::size_t samples() const {
    std::size_t inner = 0;
    for (std::uint32_t i = 0; i < fan.triangles(); ++i)
      if (const auto n = static_cast<std::size_t>(steps(i)); n >= kLeastSteps) inner += (n - 1) * (n - 2) / 2;
    return centres() + fan.triangles() + inner + (fan.closed ? fan.count : fan.count - 2) + fan.creases;
  }

  // Which sector a triangle belongs to, for two of them.
  bool inSecond(std::uint32_t triangle) const {
    bool second = false;
    for (std::uint32_t i = 0; i <= triangle; ++i) second ^= rim[i].crease;
    return second;
  }
};

}  // namespace sdf
