// How a surface passes through a cell of the lattice, by the signs at its corners.
#pragma once
#include <array>
#include <cstdint>

namespace sdf {

inline constexpr int kCellEdges = 12;

/// The bit of a corner's number that says on which side along an axis it lies: corner c is at (c >> 2, c >> 1
/// & 1, c & 1).
constexpr unsigned cornerBit(int axis) { return 4u >> axis % 3; }
/// The edge along an axis that lies u and v along the next two axes (x, y, z, x …).
constexpr int cellEdge(int axis, int u, int v) { return axis % 3 * 4 + u * 2 + v; }
/// An edge's lower corner; the upper one is | cornerBit(edge / 4).
constexpr unsigned lowerCorner(int edge) {
  return (edge >> 1 & 1) * cornerBit(edge / 4 + 1) | (edge & 1) * cornerBit(edge / 4 + 2);
}

/// The pieces of surface in a cell. Each is a loop over the cell's faces that joins the edges which it
/// crosses.
struct CellPatches {
  static constexpr std::uint8_t kNone = 255;

  std::uint8_t count = 0;
  /// 1 + 2 axis + side of the face that one patch crosses twice, while no other face is ambiguous; else 0.
  /// Where the cells on both sides of a face name it, two edges of the mesh would join the same two points,
  /// which is not manifold.
  std::uint8_t twiceCrossed = 0;
  std::array<std::uint8_t, kCellEdges> of{};  ///< patch of an edge; kNone where it is not crossed
};

/// `inside` has a bit for each corner. In a face with its corners inside along one diagonal only, these are
/// joined (Wenger, Isosurfaces, 2013, 3.2; Nielson, Dual marching cubes, 2004). To have the others joined
/// take the patches of ~inside.
constexpr CellPatches cellPatches(unsigned inside) {
  CellPatches p;
  const auto crossed = [&](int e) {
    return ((inside >> lowerCorner(e) ^ inside >> (lowerCorner(e) | cornerBit(e / 4))) & 1u) != 0;
  };
  int ambiguous = 0, face = 0;
  std::array<int, 4> faceEdges{};
  for (int e = 0; e < kCellEdges; ++e) p.of[e] = crossed(e) ? e : CellPatches::kNone;
  const auto join = [&](int a, int b) {
    const std::uint8_t from = p.of[a], to = p.of[b];
    for (auto& patch : p.of)
      if (patch == from) patch = to;
  };
  for (int axis = 0; axis < 3; ++axis)
    for (int side = 0; side < 2; ++side) {
      const std::array<int, 4> edges{cellEdge(axis + 1, 0, side), cellEdge(axis + 2, side, 1),
                                     cellEdge(axis + 1, 1, side), cellEdge(axis + 2, side, 0)};
      int crossings[4]{}, count = 0;
      for (const int e : edges)
        if (crossed(e)) crossings[count++] = e;
      if (count == 2) join(crossings[0], crossings[1]);
      if (count != 4) continue;
      // Each edge meets the next in a corner; edges[3] and edges[0] meet in the face's first.
      const bool first = (inside >> side * cornerBit(axis) & 1u) != 0;
      for (int i = 0; i < 4; i += 2) join(edges[i], edges[first ? i + 1 : (i + 3) % 4]);
      ++ambiguous, face = 1 + 2 * axis + side, faceEdges = edges;
    }
  if (ambiguous == 1 && p.of[faceEdges[0]] == p.of[faceEdges[2]]) p.twiceCrossed = face;
  // The patches were called after one of their edges; they are numbered by their first.
  const auto name = p.of;
  for (int e = 0; e < kCellEdges; ++e) {
    if (name[e] == CellPatches::kNone) continue;
    int first = 0;
    while (name[first] != name[e]) ++first;
    p.of[e] = first == e ? p.count++ : p.of[first];
  }
  return p;
}

/// cellPatches of all signs.
inline constexpr std::array<CellPatches, 256> kCellPatches = [] {
  std::array<CellPatches, 256> all;
  for (unsigned inside = 0; inside < 256; ++inside) all[inside] = cellPatches(inside);
  return all;
}();

/// The mean of a patch's crossings, from its cell's lowest corner: base[axis] + the sum of weight[e] t over
/// the edges e along the axis, t being where an edge is crossed, in [0, 1].
struct PatchMean {
  std::array<float, kCellEdges> weight{};
  std::array<float, 3> base{};
};

constexpr PatchMean patchMean(const CellPatches& patches, int patch) {
  PatchMean m;
  float count = 0.0f;
  for (const std::uint8_t of : patches.of) count += of == patch;
  for (int e = 0; e < kCellEdges; ++e) {
    if (patches.of[e] != patch) continue;
    m.weight[e] = 1.0f / count;
    for (int axis = 0; axis < 3; ++axis)
      if (lowerCorner(e) & cornerBit(axis)) m.base[axis] += 1.0f / count;
  }
  return m;
}

/// patchMean of all patches of all signs.
inline constexpr int kMostPatches = 4;
inline constexpr auto kPatchMeans = [] {
  std::array<std::array<PatchMean, kMostPatches>, 256> all;
  for (unsigned inside = 0; inside < 256; ++inside)
    for (int p = 0; p < kMostPatches; ++p) all[inside][p] = patchMean(kCellPatches[inside], p);
  return all;
}();

}  // namespace sdf
