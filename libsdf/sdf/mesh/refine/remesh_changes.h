// The changes that remeshing consists of, each made all over the mesh at once.
#pragma once
#include <cstdint>
#include <glm/vec3.hpp>
#include <vector>

#include "sdf/base/progress.h"
#include "sdf/mesh/edit/half_edges.h"
#include "sdf/mesh/refine/remesh_fans.h"
#include "sdf/mesh/surface/local_field.h"

namespace sdf {

/// A mesh in the making. A change is proposed at many places of which no two share a triangle, cheapest first
/// and ties by number; all are evaluated in one batch, and those that keep the tolerance are made.
class RemeshChanges {
 public:
  /// Distances are held to `tolerance`, and where the mesh is `painted` so is what is seen on it
  /// (addPaintErrors).
  RemeshChanges(HalfEdgeMesh& mesh, const LocalField& field, double tolerance, bool painted,
                Progress& progress);

  enum class Care {
    Usual,  ///< along creases a little more than the tolerance is let pass
    Strict
  };
  /// Collapses edges, those first along which the surface turns least, until no collapse keeps the tolerance.
  /// Edges that failed are tried anew only when something near them has changed.
  void collapse(Care care = Care::Usual);
  /// Merges vertices whose distance is next to nothing beside the tolerance, which splits have brought
  /// together; returns how many went.
  std::size_t collapseShortest();
  /// Moves each vertex once to where the largest distances around it are balanced, if that lessens them;
  /// returns the number of those that moved. Where nothing changed since the last time nothing is tried.
  std::size_t relocate(float loose = 0.0f);
  /// Replaces edges by the other diagonal where that lessens the distances; returns the number of
  /// flips. Both let the distances' energy rise by the share `loose`.
  std::size_t flip(float loose = 0.0f);
  /// Splits edges until none of the triangles exceeds the tolerance at its samples, or the halves of those
  /// that do would be needles or folded, and adjusts what is new.
  void split();
  /// Puts these vertices onto the surface.
  void project(const std::vector<std::uint32_t>& vertices);
  /// Splits these triangles where they are farthest off, where it makes needles or folds of them only if
  /// `force`, and adjusts what is new.
  void splitTriangles(const std::vector<std::uint32_t>& triangles, bool force);

  float evenness(std::uint32_t h) const;
  void setTolerance(double tolerance);

 private:
  struct Candidate {
    float cost;
    std::uint32_t where;  // a half-edge or a vertex
    bool operator<(const Candidate& o) const { return cost != o.cost ? cost < o.cost : where < o.where; }
  };
  // With what is seen on the surface, if it is painted.
  void evaluate(const Fans& fans, Sampling sampling, std::vector<FanError>& errors) const;
  // Some of the fans, and all over large triangles: what a few samples refuse needs no more of them.
  std::vector<FanError> lookClosely(const Fans& fans, const std::vector<std::uint32_t>& some) const;
  // Is the tolerance exceeded by more than before?
  bool worsens(const FanError& before, const FanError& after) const;
  // Keeps those changes, by their fans' numbers, that worsen them nowhere.
  void dropWorse(const Fans& before, const Fans& after, std::vector<std::uint32_t>& changes) const;
  void readNormals();
  float collapseCost(std::uint32_t h) const;
  float creaseCost(std::uint32_t h) const;
  float chordError(std::uint32_t h) const;
  std::uint32_t collapsible(std::uint32_t h) const;
  // The cheapest; are there more?
  std::vector<Candidate> collapseCandidates(bool& more) const;
  bool collapseRound(std::size_t most, Care care, bool& more);
  // What the collapses make of the edges; the fans' centres move to where they would be.
  void tryCollapses(const std::vector<std::uint32_t>& edges, Fans& fans, std::vector<FanError>& errors) const;
  // Is the edge long enough to be resolved when it is halved, and not to be left as it is?
  bool maySplit(std::uint32_t edge) const;
  std::uint32_t longestSide(std::uint32_t h) const;
  std::vector<Candidate> splitCandidates();
  // The new vertices lie on the surface (`onto`), or to either side of it as balances the distances. What
  // makes needles or folds is left out, or done all the same (`force`).
  void splitRound(const std::vector<Candidate>& candidates, bool onto, bool force);
  void moveToOffsets(Fans& fans, const std::vector<FanError>& errors) const;
  bool claim(std::uint32_t v);
  bool claimEdge(std::uint32_t h);
  // Takes those of the waiting vertices that can be changed in one round, and adds their fans.
  std::vector<std::uint32_t> claimSome(std::vector<std::uint32_t>& waiting, Fans& fans);
  void touch(std::uint32_t v);
  void grow();

  HalfEdgeMesh& mesh_;
  const LocalField& field_;
  float tolerance_;
  float size_;  // half the mesh's longest extent
  bool painted_;
  Progress& progress_;
  std::uint32_t round_ = 1;
  std::uint32_t lastFlips_ = 0, lastSplits_ = 0;  // rounds
  std::vector<std::uint32_t> claimed_;            // by triangle: the round in which a change had it
  std::vector<std::uint32_t> changed_;  // by vertex: the last round in which a triangle at it was changed
  std::vector<std::uint32_t> tried_;    // by half-edge: the last round in which its collapse failed
  std::vector<std::uint32_t> settled_;  // by vertex: the last round in which it was to be moved
  std::vector<glm::vec3> normals_;      // by vertex, of the surface
};

}  // namespace sdf
