#include "sdf/mesh/certify.h"

#include <tbb/enumerable_thread_specific.h>
#include <tbb/parallel_for.h>

#include <algorithm>
#include <atomic>
#include <cmath>
#include <numeric>

#include "sdf/mesh/certify_cell.h"
#include "sdf/mesh/stages.h"

namespace sdf {
namespace {

// Cells with no more triangles in reach are proven one by one, each with its parts, by one task.
constexpr std::size_t kTask = 2000;

class Certifier {
 public:
  Certifier(const std::vector<glm::vec3>& positions, const std::vector<glm::uvec3>& triangles,
            const ModelTapes& model, const CertifyOptions& options, Progress& progress)
      : mesh_{{positions.begin(), positions.end()}, triangles, std::vector<Interval>(positions.size())},
        model_(model),
        options_(options),
        progress_(progress) {}

  Certificate run() {
    std::vector<CertifyCell> tasks = descend();
    tbb::parallel_for(std::size_t{0}, tasks.size(), [&](std::size_t i) { evaluateCorners(tasks[i]); });
    std::vector<Certificate> results(tasks.size());
    std::atomic<std::size_t> done{0};
    tbb::parallel_for(std::size_t{0}, tasks.size(), [&](std::size_t i) {
      if (progress_.stopped()) return;
      prover().beginTask();
      prove(tasks[i], results[i]);
      progress_.update(static_cast<double>(++done) / tasks.size());
    });
    Certificate all;
    for (const Certificate& one : results) join(one, all);
    return all;
  }

 private:
  CellProver& prover() { return provers_.local(); }

  CertifyCell root() const {
    Box all = options_.bounds;
    CertifyCell cell;
    cell.triangles.resize(mesh_.triangles.size());
    std::iota(cell.triangles.begin(), cell.triangles.end(), 0u);
    for (const glm::uvec3& t : mesh_.triangles)
      for (int k = 0; k < 3; ++k) all = unite(all, {mesh_.positions[t[k]], mesh_.positions[t[k]]});
    const glm::dvec3 c = all.centre(), half(0.5 * (1.0 + 1e-6) * all.longestSide());
    cell.box = {c - half, c + half};
    cell.tape = model_.whole();
    cell.operands = model_.all();
    return cell;
  }

  // The cells that are tasks; level by level.
  std::vector<CertifyCell> descend() {
    std::vector<CertifyCell> open{root()}, tasks;
    while (!open.empty() && !progress_.stopped()) {
      std::vector<std::vector<CertifyCell>> found(open.size());
      tbb::parallel_for(std::size_t{0}, open.size(), [&](std::size_t i) {
        for (int k = 0; k < 8; ++k)
          if (CertifyCell part = child(open[i], k); !settled(part)) found[i].push_back(std::move(part));
      });
      open.clear();
      for (auto& list : found)
        for (CertifyCell& part : list) (isTask(part) ? tasks : open).push_back(std::move(part));
    }
    return tasks;
  }

  bool isTask(const CertifyCell& cell) const {
    return (cell.triangles.size() <= kTask && cell.box.longestSide() < 0.3 * options_.bounds.longestSide()) ||
           cell.box.longestSide() <= options_.finest;
  }

  // The k-th eighth of a cell, with its own tape.
  CertifyCell child(const CertifyCell& cell, int k) {
    CertifyCell part;
    const glm::dvec3 middle = cell.box.centre();
    for (int i = 0; i < 3; ++i) {
      const bool upper = k >> i & 1;
      part.box.min[i] = upper ? middle[i] : cell.box.min[i];
      part.box.max[i] = upper ? cell.box.max[i] : middle[i];
    }
    const Box reach = part.reach(options_.goal);
    Box region = reach;
    for (const std::uint32_t t : cell.triangles)
      if (const Box box = mesh_.boxOf(t); !intersect(box, reach).empty()) {
        part.triangles.push_back(t);
        region = unite(region, box);
      }
    specialise(cell, region, part);
    part.free =
        prover().isFree(*part.tape, part.box, std::min<double>(part.tape->lipschitz(), model_.slope()));
    return part;
  }

  void specialise(const CertifyCell& cell, const Box& region, CertifyCell& part) {
    part.tape = cell.tape;
    part.operands = cell.operands;
    if (part.operands.size() > 1 && model_.slope() < kInfinity) {
      part.operands = model_.near(region, cell.box.longestSide(), cell.operands);
      if (part.operands.empty()) part.operands = {cell.operands.front()};
      if (part.operands.size() < cell.operands.size()) part.tape = model_.link(part.operands);
    }
    if (part.tape->decisionCount() == 0) return;
    Scratch& s = scratch_.local();
    evaluate(*part.tape, region, s.intervals, s.decisions);
    if (TapePtr special = part.tape->specialised(s.decisions.data(), 1)) part.tape = std::move(special);
  }

  // Neither surface nor mesh.
  bool settled(const CertifyCell& cell) const {
    return cell.free && std::none_of(cell.triangles.begin(), cell.triangles.end(), [&](std::uint32_t t) {
             return !intersect(mesh_.boxOf(t), cell.box).empty();
           });
  }

  // The field at those corners of the mesh that lie in the cell; each lies in one.
  void evaluateCorners(const CertifyCell& cell) {
    Scratch& s = scratch_.local();
    for (const std::uint32_t t : cell.triangles)
      for (int k = 0; k < 3; ++k) {
        const glm::uvec3& v = mesh_.triangles[t];
        const glm::dvec3& p = mesh_.positions[v[k]];
        if (glm::any(glm::lessThan(p, cell.box.min)) || glm::any(glm::greaterThanEqual(p, cell.box.max)))
          continue;
        mesh_.values[v[k]] = evaluate(*cell.tape, {p, p}, s.intervals);
      }
  }

  void prove(const CertifyCell& cell, Certificate& into) {
    if (progress_.stopped()) return;
    ++into.cells;
    CellBounds bounds = prover().bySlope(cell, options_.goal);
    if (bounds.larger() <= options_.goal) return keep(cell, bounds, into);
    if (cell.box.longestSide() > options_.finest) {
      for (int k = 0; k < 8; ++k)
        if (const CertifyCell part = child(cell, k); !settled(part)) prove(part, into);
      return;
    }
    for (const CellBounds& other : {prover().bySlope(cell, 2.0 * options_.goal), prover().bySize(cell)}) {
      bounds.toSurface = std::min(bounds.toSurface, other.toSurface);
      bounds.toMesh = std::min(bounds.toMesh, other.toMesh);
    }
    keep(cell, bounds, into);
  }

  void keep(const CertifyCell& cell, const CellBounds& bounds, Certificate& into) const {
    Certificate one;
    if (bounds.larger() <= options_.limit) {
      one.toSurface = bounds.toSurface;
      one.toMesh = bounds.toMesh;
      one.widest = cell.box.centre();
    } else {
      one.unproven = 1;
      one.firstUnproven = cell.box.centre();
      one.unprovenSize = cell.box.longestSide();
    }
    join(one, into);
  }

  static void join(const Certificate& one, Certificate& all) {
    if (one.bound() > all.bound()) all.widest = one.widest;
    all.toSurface = std::max(all.toSurface, one.toSurface);
    all.toMesh = std::max(all.toMesh, one.toMesh);
    if (all.unproven == 0) all.firstUnproven = one.firstUnproven, all.unprovenSize = one.unprovenSize;
    all.unproven += one.unproven;
    all.cells += one.cells;
  }

  struct Scratch {
    ScalarReading<Interval> intervals;
    std::vector<Decision> decisions;
  };

  CertifiedMesh mesh_;
  const ModelTapes& model_;
  const CertifyOptions& options_;
  Progress& progress_;
  tbb::enumerable_thread_specific<Scratch> scratch_;
  tbb::enumerable_thread_specific<CellProver> provers_{[this] { return CellProver(mesh_, options_); }};
};

}  // namespace

Certificate certify(const std::vector<glm::vec3>& positions, const std::vector<glm::uvec3>& triangles,
                    const ModelTapes& model, const CertifyOptions& options, Progress& progress) {
  MeshStats stats;
  measureTopology(triangles, positions.size(), stats);
  if (!stats.watertight) {
    Certificate none;
    none.unproven = 1;
    if (!triangles.empty()) none.firstUnproven = positions[openVertex(triangles, positions.size())];
    return none;
  }
  return Certifier(positions, triangles, model, options, progress).run();
}

}  // namespace sdf
