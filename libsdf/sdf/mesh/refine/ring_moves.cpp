#include "sdf/mesh/refine/ring.h"

#include <algorithm>
#include <glm/geometric.hpp>
#include <glm/mat2x2.hpp>
#include <glm/mat3x3.hpp>
#include <glm/matrix.hpp>

namespace sdf {
namespace {

// Weights below this are none.
constexpr float kNoWeight = 1e-3f;
// What is nearer counts as so near, in limits: powers that are no normal floats take a hundred times as long.
constexpr float kLeastSquare = 3e-5f;
// Halvings of the largest distance in search of the least.
constexpr int kBalancings = 5;

}  // namespace

glm::dvec3 absolute(const glm::dvec3& form) {
  const double mean = 0.5 * (form.x + form.z), half = 0.5 * (form.x - form.z),
               radius = std::hypot(half, form.y);
  if (!(radius > 0.0)) return {std::abs(form.x), 0.0, std::abs(form.z)};
  const double high = std::abs(mean + radius), low = std::abs(mean - radius),
               scale = 0.5 * (high - low) / radius;
  return {0.5 * (high + low) + scale * half, scale * form.y, 0.5 * (high + low) - scale * half};
}

Range feasibleAlong(const glm::vec3& off, float weight, const glm::vec3& way, float limit) {
  const float along = glm::dot(off, way), root = along * along - glm::dot(off, off) + limit * limit;
  if (weight < kNoWeight || way == glm::vec3(0.0f))
    return glm::dot(off, off) <= limit * limit ? Range{} : Range{1.0f, 0.0f};
  if (root < 0.0f) return {1.0f, 0.0f};
  return {(along - std::sqrt(root)) / weight, (along + std::sqrt(root)) / weight};
}

Range feasibleAlong(float height, float weight, float limit) {
  if (std::abs(weight) < kNoWeight) return std::abs(height) <= limit ? Range{} : Range{1.0f, 0.0f};
  const float a = (height - limit) / weight, b = (height + limit) / weight;
  return {std::min(a, b), std::max(a, b)};
}

// The neighbours on the crease that passes through the centre.
std::array<glm::vec3, 2> Ring::creaseEnds() const {
  std::array<glm::vec3, 2> ends{};
  int count = 0;
  for (const Spoke& s : spokes_)
    if (s.crease) ends[count++] = s.at;
  return ends;
}

// Along a crease the way is where its samples are on the whole, across the line through its neighbours.
void Ring::findWay() {
  way_ = creases_ == 0 && !isTip_ ? sectors_[0].normal : glm::vec3(0.0f);
  chord_ = glm::vec3(0.0f);
  if (creases_ != 2) return;
  const auto ends = creaseEnds();
  const glm::vec3 chord = ends[1] - ends[0], out = centre_ - ends[0];
  const float square = glm::dot(chord, chord);
  if (!(square > 0.0f)) return;
  chord_ = chord / std::sqrt(square);
  glm::vec3 sum = out - glm::dot(out, chord) / square * chord;
  for (const PlacedOnCrease& p : placedOnCreases_) sum += p.weight * p.off;
  sum -= glm::dot(sum, chord) / square * chord;
  // Of the chord: a crease that bends less is straight but for rounding.
  if (const float size = glm::length(sum); size * size > 0x1p-40f * square) way_ = sum / size;
}

// A centre between samples is seen by none of them: the tangent of the next one tells of it.
void Ring::findNearest() {
  centreOff_ = glm::vec3(0.0f);
  if (isTip_ || creases_ == 1 || creases_ > 2) return;
  float least = HUGE_VALF;
  Index nearest = kNone;
  const auto look = [&](Index sample) {
    const glm::vec3 d = sampled_.samples[sample].at - centre_;
    if (const float square = glm::dot(d, d); square < least) least = square, nearest = sample;
  };
  if (creases_ == 0)
    for (const Placed& p : placed_) look(p.sample);
  for (const PlacedOnCrease& p : placedOnCreases_) look(p.sample);
  if (nearest == kNone) return;
  const glm::vec3 d = sampled_.samples[nearest].at - centre_;
  const glm::vec3& along = creases_ == 0 ? sampled_.samples[nearest].normal : chord_;
  centreOff_ = glm::dot(d, along) * along;
  if (creases_ == 2) centreOff_ = d - centreOff_;
}

Range Ring::feasible(float limit) const {
  Range range = feasibleAlong(centreOff_, 1.0f, way_, std::min(limit, tolerance_));
  for (const PlacedOnCrease& p : placedOnCreases_) {
    const Range own = feasibleAlong(p.off, p.weight, way_, limit);
    range.cut(own.lo, own.hi);
  }
  for (const Placed& p : placed_) {
    const Range own = feasibleAlong(p.height, p.weight, limit);
    range.cut(own.lo, own.hi);
    if (range.empty()) break;
  }
  return range;
}

float Ring::balanced() const {
  float most = std::max(largest(), centreDistance()), least = 0.0f, way = 0.0f;
  for (int i = 0; i < kBalancings; ++i) {
    const float middle = 0.5f * (least + most);
    const Range range = feasible(middle);
    if (range.empty())
      least = middle;
    else
      most = middle, way = range.middle();
  }
  return way;
}

float Ring::largest() const {
  float most = 0.0f;
  for (const Placed& p : placed_) most = std::max({most, std::abs(p.height), p.tint});
  for (const PlacedOnCrease& p : placedOnCreases_) most = std::max(most, glm::length(p.off));
  return most;
}

float Ring::energy(float limit, float along) const {
  const float scale = 1.0f / (limit * limit);
  const auto power = [&](float square) {
    square = std::max(square * scale, kLeastSquare);
    square *= square, square *= square;
    return square * square;
  };
  const auto of = [&](const glm::vec3& off, float weight) {
    const glm::vec3 there = off - weight * along * way_;
    return power(glm::dot(there, there));
  };
  float sum = of(centreOff_, 1.0f);
  for (const Placed& p : placed_) {
    const float height = p.height - p.weight * along;
    sum += power(height * height) + power(p.tint * p.tint);
  }
  for (const PlacedOnCrease& p : placedOnCreases_) sum += of(p.off, p.weight);
  return sum;
}

glm::vec3 Ring::optimalMove(const glm::vec3& normal) const {
  // The second fundamental form (a b; b c) that turns the normal best as the vertices' around are turned.
  const Sector& s = sectors_[0];
  glm::dmat3 left(0.0);
  glm::dvec3 right(0.0);
  for (std::size_t i = 0; i < spokes_.size(); ++i) {
    if (!sampled_.isSmooth(spokes_[i].vertex)) continue;
    const glm::dvec2 d(rim_[i].x, rim_[i].y);
    const glm::vec3 turn = sampled_.normals[spokes_[i].vertex] - normal;
    const double weight = 1.0 / glm::dot(d, d);
    const glm::dvec3 rows[2] = {{d.x, d.y, 0.0}, {0.0, d.x, d.y}};
    const double turns[2] = {glm::dot(turn, s.x), glm::dot(turn, s.y)};
    for (int k = 0; k < 2; ++k) {
      left += weight * glm::outerProduct(rows[k], rows[k]);
      right += weight * turns[k] * rows[k];
    }
  }
  if (!(std::abs(glm::determinant(left)) > 1e-6)) return glm::vec3(0.0f);
  const glm::dvec3 form = absolute(glm::inverse(left) * right) + tintForm();
  const double mean = 0.5 * (form.x + form.z), half = 0.5 * (form.x - form.z),
               radius = std::hypot(half, form.y), angle = 0.5 * std::atan2(form.y, half);
  const double largest = std::max(std::abs(mean + radius), std::abs(mean - radius));
  if (!(largest > 0.0)) return glm::vec3(0.0f);
  // Flat directions count as somewhat curved, so that triangles stay a thousand times as long as wide at
  // most.
  const double least = 1e-6 * largest, first = std::sqrt(std::max(std::abs(mean + radius), least)),
               second = std::sqrt(std::max(std::abs(mean - radius), least));
  const glm::dmat2 turn(std::cos(angle), -std::sin(angle), std::sin(angle), std::cos(angle));
  const auto inMetric = [&](const glm::vec3& d) {
    return glm::dvec2(first, second) * (turn * glm::dvec2(d.x, d.y));
  };
  glm::dvec2 sum(0.0);
  double area = 0.0, reach = 0.0;
  for (std::size_t i = 0; i < spokes_.size(); ++i) {
    reach = std::max<double>(reach, glm::length(rim_[i]));
    const glm::dvec2 p = inMetric(rim_[i]), q = inMetric(rim_[i + 1]);
    area += p.x * q.y - p.y * q.x;
    sum += glm::dvec2(q.y - p.y, p.x - q.x) * (glm::dot(p, p) + glm::dot(q, q));
  }
  if (!(area > 0.0)) return glm::vec3(0.0f);
  const glm::dvec2 move = glm::transpose(turn) * (sum / (2.0 * area) / glm::dvec2(first, second));
  // The circumcentres of slivers are anywhere.
  if (!(glm::length(move) <= 2.0 * reach)) return glm::vec3(0.0f);
  return static_cast<float>(move.x) * s.x + static_cast<float>(move.y) * s.y;
}

glm::vec3 Ring::moveAlongCrease() const {
  const auto ends = creaseEnds();
  const glm::vec3 sum = (ends[0] - centre_) + (ends[1] - centre_);
  const glm::vec3 chord = ends[1] - ends[0];
  return 0.5f * glm::dot(sum, chord) / glm::dot(chord, chord) * chord;
}

}  // namespace sdf
