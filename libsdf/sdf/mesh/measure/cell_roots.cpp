#include "sdf/mesh/measure/cell_roots.h"

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>

#include "sdf/mesh/measure/read_values.h"
#include "sdf/mesh/measure/search.h"
#include "sdf/mesh/surface/surface_points.h"

namespace sdf {
namespace {

// Readings along a line; how often a piece of it is halved in which the slope lets the sign change twice, of
// which (1 - cos a) / 2 is left each time at an angle of a to the surface's normal; and the halvings of a
// piece in which it does change, as many as a float has bits.
constexpr std::size_t kAlong = 9;
constexpr int kIsolations = 5;
constexpr int kBisections = 24;

}  // namespace

void CellRoots::find(const Tape& tape, const Box& cell, bool isolates) {
  isolates_ = isolates && !std::isinf(slope_);
  points_.clear();
  const glm::vec3 centre(cell.centre()), half(0.5 * cell.size());
  for (const glm::vec3& way : {glm::vec3(1, 0, 0), glm::vec3(0, 1, 0), glm::vec3(0, 0, 1)})
    addLine(centre, way * half);
  read(tape, along_);
  // All of the cell is inside or outside if the centre is farther from the surface than the corners are from
  // it.
  mayHold_ = !(std::abs(along_[kAlong / 2].value) > slope_ * glm::length(half));
  follow(tape);
  if (!isOpen()) return;
  for (const glm::vec3& way :
       {glm::vec3(1, 1, 1), glm::vec3(1, 1, -1), glm::vec3(1, -1, 1), glm::vec3(-1, 1, 1)})
    addLine(centre, way * half);
  read(tape, along_);
  follow(tape);
}

void CellRoots::read(const Tape& tape, std::vector<Reading>& readings) {
  readValues(
      batch_, tape, readings.size(), [&](std::size_t i) { return readings[i].at; },
      [&](std::size_t i, float value) { readings[i].value = value; });
}

void CellRoots::addLine(const glm::vec3& centre, const glm::vec3& half) {
  for (std::size_t k = 0; k < kAlong; ++k)
    along_.push_back({centre + (2.0f * static_cast<float>(k) / (kAlong - 1) - 1.0f) * half, 0.0f});
}

// Finds the points on the lines, which were read.
void CellRoots::follow(const Tape& tape) {
  pieces_.clear();
  brackets_.clear();
  for (std::size_t i = 0; i + 1 < along_.size(); ++i)
    if (i % kAlong != kAlong - 1) take({along_[i], along_[i + 1]});
  along_.clear();
  if (isolates_) isolate(tape);
  bisect(tape);
  takePoints(tape);
}

// Keeps a piece in which the sign changes, or may do so twice: the surface is |f| / slope away at least. A
// reading of 0 is outside.
void CellRoots::take(const Piece& piece) {
  const auto& [from, to] = piece;
  const bool first = from.value < 0.0f, second = to.value < 0.0f;
  const float length = glm::distance(from.at, to.at);
  if (first != second) {
    const glm::vec3 way = (first ? to.at - from.at : from.at - to.at) / length;
    brackets_.push_back({first ? from.at : to.at, first ? to.at : from.at, way});
  } else if (std::abs(from.value) + std::abs(to.value) < slope_ * length) {
    pieces_.push_back(piece);
  }
}

// Of the part that neither end's distance excludes.
glm::vec3 CellRoots::middleOf(const Piece& piece) const {
  const glm::vec3 way = piece.to.at - piece.from.at;
  const float by = (std::abs(piece.from.value) - std::abs(piece.to.value)) / (slope_ * glm::length(way));
  return piece.from.at + 0.5f * (1.0f + by) * way;
}

void CellRoots::isolate(const Tape& tape) {
  for (int k = 0; k < kIsolations && !pieces_.empty(); ++k) {
    halved_.swap(pieces_);
    pieces_.clear();
    std::vector<Reading> middles;
    for (const Piece& piece : halved_) middles.push_back({middleOf(piece), 0.0f});
    read(tape, middles);
    for (std::size_t i = 0; i < middles.size(); ++i) {
      take({halved_[i].from, middles[i]});
      take({middles[i], halved_[i].to});
    }
  }
}

void CellRoots::bisect(const Tape& tape) {
  std::vector<Reading> middles(brackets_.size());
  for (int k = 0; k < kBisections && !middles.empty(); ++k) {
    for (std::size_t i = 0; i < middles.size(); ++i)
      middles[i].at = 0.5f * (brackets_[i].inside + brackets_[i].outside);
    read(tape, middles);
    for (std::size_t i = 0; i < middles.size(); ++i)
      (middles[i].value < 0.0f ? brackets_[i].inside : brackets_[i].outside) = middles[i].at;
  }
}

// Takes what has the outside on one side of it and the inside on the other, a film's width away.
void CellRoots::takePoints(const Tape& tape) {
  std::vector<Reading> beside;
  for (const Bracket& b : brackets_) {
    const glm::vec3 film = filmAt(b.outside, size_) * b.way;
    beside.push_back({b.inside - film, 0.0f});
    beside.push_back({b.outside + film, 0.0f});
  }
  read(tape, beside);
  for (std::size_t i = 0; i < brackets_.size(); ++i)
    if (beside[2 * i].value < 0.0f && !(beside[2 * i + 1].value < 0.0f))
      points_.push_back(brackets_[i].outside);
}

}  // namespace sdf
