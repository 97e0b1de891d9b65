#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <set>
#include <tuple>

#include "meshes.h"

namespace sdf::accuracy {
namespace {

using Row = std::vector<glm::dvec3>;

// A place by its distance from the y axis and the angle in which a helix of this hand (1: right, -1: left)
// rises.
glm::dvec3 place(double rho, double angle, double y, double hand) {
  return {rho * std::cos(angle), y, -hand * rho * std::sin(angle)};
}

// The circles about the helix' end, from the tube's last one to a point. `out` leads along the helix.
void addEnd(const Row& circle, const glm::dvec3& centre, const glm::dvec3& out, double wire, int steps,
            std::vector<Row>& rows) {
  for (int k = 1; k <= steps; ++k) {
    const double up = 0.5 * kPi * k / steps, around = k == steps ? 0.0 : std::cos(up);
    Row& row = rows.emplace_back();
    for (const glm::dvec3& p : circle)
      row.push_back(centre + around * (p - centre) + wire * std::sin(up) * out);
  }
}

// Triangles that join the open edges of either end to the axis.
void closeEnds(std::vector<Triangle>& triangles) {
  const auto less = [](const glm::dvec3& a, const glm::dvec3& b) {
    return std::tie(a.x, a.y, a.z) < std::tie(b.x, b.y, b.z);
  };
  const auto edgeLess = [&](const auto& a, const auto& b) {
    return less(a.first, b.first) || (!less(b.first, a.first) && less(a.second, b.second));
  };
  std::set<std::pair<glm::dvec3, glm::dvec3>, decltype(edgeLess)> open(edgeLess);
  double top = 0.0;
  for (const Triangle& t : triangles)
    for (int k = 0; k < 3; ++k) {
      const glm::dvec3 &a = t[k], &b = t[(k + 1) % 3];
      top = std::max(top, std::abs(a.y));
      if (const auto twin = open.find({b, a}); twin != open.end())
        open.erase(twin);
      else
        open.insert({a, b});
    }
  for (const auto& [a, b] : open) triangles.push_back({b, a, {0.0, a.y > 0.0 ? top : -top, 0.0}});
}

}  // namespace

// With the tube's points p(t, s) = helix(t) + wire (cos s n(t) + sin s b(t)) second derivatives are no longer
// than major + 2 wire along t and wire along s, and the mixed one than the mean of these. A triangle over a
// part of dt by ds is off by half of what they amount to over half its longest side (Waldron 1998), so by no
// more than ((major + 2 wire) dt^2 + wire ds^2) / 4.
Tessellation helicalTube(double major, double pitch, double turns, double wire, double hand, int steps,
                         int aTurn) {
  const double rise = pitch / (2.0 * kPi), last = kPi * turns, length = std::hypot(major, rise);
  const int along = std::max(2, static_cast<int>(std::ceil(aTurn * turns)));
  const auto centre = [&](double t) { return place(major, t, rise * t, hand); };
  const auto ahead = [&](double t) {
    return glm::dvec3(-major * std::sin(t), rise, -hand * major * std::cos(t)) / length;
  };
  std::vector<Row> tube;
  for (int k = 0; k <= along; ++k) {
    const double t = last * (2.0 * k / along - 1.0);
    const glm::dvec3 out = place(1.0, t, 0.0, hand), side = glm::cross(ahead(t), out);
    Row& row = tube.emplace_back();
    for (int i = 0; i < steps; ++i) {
      const double angle = 2.0 * kPi * i / steps;
      row.push_back(centre(t) + wire * (std::cos(angle) * out + std::sin(angle) * side));
    }
  }
  std::vector<Row> rows;
  addEnd(tube.front(), centre(-last), -ahead(-last), wire, steps / 4, rows);
  std::ranges::reverse(rows);
  rows.insert(rows.end(), tube.begin(), tube.end());
  addEnd(tube.back(), centre(last), ahead(last), wire, steps / 4, rows);
  Tessellation t;
  t.mesh = welded(rowsJoined(rows, true));
  const double ds = 2.0 * kPi / steps, dt = 2.0 * last / along;
  t.chord = 0.25 * ((major + 2.0 * wire) * dt * dt + wire * ds * ds);
  t.special = {centre(last), centre(-last), centre(0.0), {0, 0, 0}, {0, rise * last, 0}};
  return t;
}

// A flank is off by r dt^2 / 8 + depth dt / 4 with the sides dt and 1 of its triangles' parts: the second
// derivatives are r along dt and the depth mixed (Waldron 1998).
Tessellation helicalThread(double diameter, double pitch, int starts, double clearance, double hand,
                           int steps) {
  const double crest = 0.5 * diameter + clearance, depth = 0.625 * std::sqrt(0.75) * pitch,
               root = crest - depth;
  // A flank that is moved out by the clearance meets crest and root, moved as well, farther along the axis by
  // what is left of it: clearance / cos 30 less that of the rise tan 30.
  const double wider = clearance * (1.0 / std::cos(kPi / 6.0) - std::tan(kPi / 6.0));
  const double atCrest = pitch / 16.0 + wider, atRoot = 0.375 * pitch + wider;
  const glm::dvec2 profile[] = {{crest, -atCrest}, {crest, atCrest}, {root, atRoot}, {root, pitch - atRoot}};
  const double tried = diameter;
  const int turns = static_cast<int>(std::ceil((tried + 2.0 * diameter) / pitch)) + starts;
  // Corner i of the profile's line through all turns, at step k of the turn; what a whole turn away is the
  // same as other corners has their numbers.
  const auto corner = [&](int i, int k) {
    if (k == steps) i += 4 * starts, k = 0;
    const int turn = i >= 0 ? i / 4 : -((3 - i) / 4);
    const glm::dvec2& p = profile[i - 4 * turn];
    const double share = static_cast<double>(k) / steps;
    return place(p.x, 2.0 * kPi * share, p.y + (turn + starts * share) * pitch, hand);
  };
  std::vector<Triangle> triangles;
  for (int i = -4 * turns; i < 4 * turns; ++i)
    for (int k = 0; k < steps; ++k) {
      const glm::dvec3 a = corner(i, k), b = corner(i + 1, k), c = corner(i + 1, k + 1), d = corner(i, k + 1);
      triangles.push_back({a, b, c});
      triangles.push_back({a, c, d});
    }
  closeEnds(triangles);
  Tessellation t;
  t.mesh = welded(triangles);
  const double dt = 2.0 * kPi / steps;
  t.chord = crest * dt * dt / 8.0 + depth * dt / 4.0;
  t.region = {glm::dvec3(-tried), glm::dvec3(tried)};
  return t;
}

}  // namespace sdf::accuracy
