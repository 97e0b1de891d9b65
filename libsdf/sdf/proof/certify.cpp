#include "sdf/proof/certify.h"

#include <tbb/enumerable_thread_specific.h>
#include <tbb/parallel_for.h>

#include <algorithm>
#include <atomic>
#include <cmath>
#include <glm/geometric.hpp>
#include <numeric>

#include "sdf/eval/scalar_reading.h"
#include "sdf/proof/cells.h"
#include "sdf/proof/prisms.h"
#include "sdf/proof/shell.h"
#include "sdf/triangles/incidence.h"

namespace sdf {
namespace {

// Cells with no more triangles are tasks: proven by one thread with one tape.
constexpr std::size_t kTask = 400;
// How often offsets are halved where their prisms reach too far.
constexpr int kRounds = 7;
// Of the goal: offsets that are shorter are not halved, or once nothing else is left, these.
constexpr double kShortReach = 6.0, kLeastReach = 2.0;
// Of the voxel size: what faces are lifted by at first, at least.
constexpr double kLeastOffset = 1.0;
// How much smaller than the finest cells a task may be.
constexpr double kSmallestTask = 0.5;
constexpr double kSpace = 1e-9;  // of a region's side

// A part of space, with what can matter in it.
struct Region {
  Box box;
  TapePtr tape;                          // holds in the box and all over the triangles' prisms
  std::vector<std::uint32_t> operands;   // of the model's union, those that the tape is of
  std::vector<std::uint32_t> triangles;  // those whose prisms may meet the box
  bool free = false;                     // of the surface
};

class Certifier {
 public:
  Certifier(const std::vector<glm::vec3>& positions, const std::vector<glm::uvec3>& triangles,
            const ModelTapes& model, const CertifyOptions& options, Progress& progress)
      : shell_(positions, triangles, kLeastOffset * options.finest),
        model_(model),
        options_(options),
        progress_(progress),
        proofs_(triangles.size()) {}

  Certificate run() {
    const std::vector<Region> tasks = descend();
    provePrisms(tasks);
    if (progress_.stopped()) return {};
    const ShellDegree degree(shell_);
    std::vector<CellProof> found(tasks.size());
    inParallel(tasks.size(), 0.5, [&](std::size_t i) {
      found[i] = CellProver(shell_, degree, proofs_, readings_.local())
                     .prove(*tasks[i].tape, tasks[i].box.grown(0.5 * kSpace * tasks[i].box.longestSide()),
                            tasks[i].triangles, options_.finest);
    });
    return summary(found);
  }

 private:
  template <class F>
  void inParallel(std::size_t count, double done, const F& f) {
    std::atomic<std::size_t> some{0};
    tbb::parallel_for(std::size_t{0}, count, [&](std::size_t i) {
      if (progress_.stopped()) return;
      f(i);
      progress_.update(done + 0.5 * static_cast<double>(++some) / static_cast<double>(count));
    });
  }

  Region root() const {
    Box all = options_.bounds;
    Region region;
    region.triangles.resize(shell_.size());
    std::iota(region.triangles.begin(), region.triangles.end(), 0u);
    for (std::uint32_t t = 0; t < shell_.size(); ++t) all = unite(all, shell_.flatBoxOf(t));
    const glm::dvec3 c = all.centre(), half(0.5 * (1.0 + 1e-6) * all.longestSide());
    region.box = {c - half, c + half};
    region.tape = model_.whole()->firstOutputOnly();
    region.operands = model_.all();
    return region;
  }

  // The regions that are tasks; level by level.
  std::vector<Region> descend() {
    std::vector<Region> open{root()}, tasks;
    while (!open.empty() && !progress_.stopped()) {
      std::vector<std::vector<Region>> found(open.size());
      tbb::parallel_for(std::size_t{0}, open.size(), [&](std::size_t i) {
        for (int k = 0; k < 8; ++k)
          if (Region part = child(open[i], k); !part.free || !part.triangles.empty())
            found[i].push_back(std::move(part));
      });
      open.clear();
      for (auto& list : found)
        for (Region& part : list) (isTask(part) ? tasks : open).push_back(std::move(part));
    }
    return tasks;
  }

  // So much larger that what rounding leaves between neighbours is covered.
  static Box spacious(const Box& box) { return box.grown(kSpace * box.longestSide()); }

  bool isTask(const Region& r) const {
    const double side = r.box.longestSide();
    return (r.triangles.size() <= kTask && side < 0.3 * options_.bounds.longestSide()) ||
           side <= kSmallestTask * options_.finest;
  }

  // The k-th eighth of a region, with its own tape.
  Region child(const Region& region, int k) {
    Region part;
    const glm::dvec3 middle = region.box.centre();
    for (int i = 0; i < 3; ++i) {
      const bool upper = k >> i & 1;
      part.box.min[i] = upper ? middle[i] : region.box.min[i];
      part.box.max[i] = upper ? region.box.max[i] : middle[i];
    }
    Box reach = spacious(part.box);
    for (const std::uint32_t t : region.triangles)
      if (const Box box = shell_.boxOf(t); !intersect(box, spacious(part.box)).empty()) {
        part.triangles.push_back(t);
        reach = unite(reach, box);
      }
    specialise(region, reach, part);
    const Interval v = evaluate(*part.tape, part.box, scratch_.local().intervals);
    part.free = !v.nan && (v.lo > 0.0 || v.hi < 0.0);
    return part;
  }

  void specialise(const Region& region, const Box& reach, Region& part) {
    part.tape = region.tape;
    part.operands = region.operands;
    if (part.operands.size() > 1 && model_.slope() < kInfinity) {
      part.operands = model_.relevantOperands(reach, region.box.longestSide(), region.operands);
      if (part.operands.empty()) part.operands = {region.operands.front()};
      if (part.operands.size() < region.operands.size())
        part.tape = model_.link(part.operands)->firstOutputOnly();
    }
    if (part.tape->decisionCount() == 0) return;
    Scratch& s = scratch_.local();
    evaluate(*part.tape, reach, s.intervals, s.decisions);
    if (TapePtr special = part.tape->specialised(s.decisions.data(), 1)) part.tape = std::move(special);
  }

  // Is the vertex in the half-open box? Each is in one task's.
  static bool isIn(const Box& box, const glm::dvec3& p) {
    return !glm::any(glm::lessThan(p, box.min)) && !glm::any(glm::greaterThanEqual(p, box.max));
  }

  // Proves all triangles; where that fails for prisms that reach too far, with smaller ones.
  void provePrisms(const std::vector<Region>& tasks) {
    std::vector<std::vector<std::uint32_t>> own(tasks.size());
    inParallel(tasks.size(), 0.0, [&](std::size_t i) {
      for (const std::uint32_t t : tasks[i].triangles)
        if (isIn(tasks[i].box, shell_.positions()[shell_.triangle(t).x])) own[i].push_back(t);
      prove(tasks[i], own[i]);
    });
    for (int round = 1;
         round < kRounds && !progress_.stopped() && (shrink(kShortReach) || shrink(kLeastReach)); ++round)
      tbb::parallel_for(std::size_t{0}, tasks.size(), [&](std::size_t i) {
        std::vector<std::uint32_t> again;
        for (const std::uint32_t t : own[i])
          if (!proofs_[t].looked) again.push_back(t);
        prove(tasks[i], again);
      });
  }

  void prove(const Region& task, const std::vector<std::uint32_t>& triangles) {
    if (triangles.empty() || progress_.stopped()) return;
    sdf::provePrisms(*task.tape, model_.slope() < kInfinity, shell_, triangles, options_.goal,
                     readings_.local(), proofs_);
    // Tapes are the model's up to distances of a task's side, and more.
    for (const std::uint32_t t : triangles)
      proofs_[t].sides = std::min(proofs_[t].sides, task.box.longestSide());
  }

  // Halves the offsets at triangles whose prisms are not proven to be passed, where they are not as low as
  // the surface may well be away; false where there are none.
  bool shrink(double least) {
    std::vector<bool> halved(shell_.positions().size(), false);
    bool any = false;
    for (std::uint32_t t = 0; t < shell_.size(); ++t)
      if (const PrismProof& p = proofs_[t]; p.looked && (!p.passed || p.bound > options_.limit))
        for (int k = 0; k < 3; ++k)
          if (const std::uint32_t v = shell_.triangle(t)[k]; shell_.reach(v) > least * options_.goal)
            halved[v] = any = true;
    for (std::uint32_t v = 0; v < halved.size(); ++v)
      if (halved[v]) shell_.halveOffset(v);
    for (std::uint32_t t = 0; t < shell_.size(); ++t)
      for (int k = 0; k < 3; ++k)
        if (halved[shell_.triangle(t)[k]]) proofs_[t] = {};
    return any;
  }

  Certificate summary(const std::vector<CellProof>& found) const {
    Certificate all;
    const auto unproven = [&](std::uint64_t count, const glm::dvec3& at, double size) {
      if (all.unproven == 0) all.firstUnproven = at, all.unprovenSize = size;
      all.unproven += count;
    };
    for (std::uint32_t t = 0; t < shell_.size(); ++t) {
      const PrismProof& p = proofs_[t];
      if (!p.proven() || p.bound > options_.limit) {
        unproven(1, shell_.centre(t), shell_.flatBoxOf(t).longestSide());
      } else if (p.bound > all.toSurface) {
        all.toSurface = all.toMesh = p.bound;
        all.widest = shell_.centre(t);
      }
    }
    all.cells = shell_.size();
    for (const CellProof& c : found) {
      all.cells += c.cells;
      if (c.unproven > 0) unproven(c.unproven, c.first, c.size);
    }
    return all;
  }

  struct Scratch {
    ScalarReading<Interval> intervals;
    std::vector<Decision> decisions;
  };

  Shell shell_;
  const ModelTapes& model_;
  const CertifyOptions& options_;
  Progress& progress_;
  std::vector<PrismProof> proofs_;
  tbb::enumerable_thread_specific<Scratch> scratch_;
  tbb::enumerable_thread_specific<ProofReading> readings_;
};

}  // namespace

Certificate certify(const std::vector<glm::vec3>& positions, const std::vector<glm::uvec3>& triangles,
                    const ModelTapes& model, const CertifyOptions& options, Progress& progress) {
  const std::optional<std::uint32_t> open = openVertex(triangles, positions.size());
  if (open || triangles.empty()) {
    Certificate none;
    none.unproven = 1;
    if (open) none.firstUnproven = positions[*open];
    return none;
  }
  return Certifier(positions, triangles, model, options, progress).run();
}

}  // namespace sdf
