#include <algorithm>
#include <glm/geometric.hpp>

#include "sdf/mesh/refine/ring.h"

namespace sdf {
namespace {

// A centre of a smaller share has no say in a sample's colour.
constexpr float kNoShare = 1e-3f;
// What is nearer counts as so near, in aims: powers that are no normal floats take a hundred times as long.
constexpr float kLeastDistance = 3e-5f;
// Bounds of linear channels, from 0 to 1 and more, are off by their rounding.
constexpr float kRounding = 0x1p-18f;

// Where a channel may be for all samples to be near, and what the samples are.
struct Bounds {
  float lo = -HUGE_VALF, hi = HUGE_VALF, least = HUGE_VALF, most = -HUGE_VALF;
  // The middle of that and of what is so near to what was; of what is empty the middle, too: there the two
  // that are the farthest from each other are as far. No colour is far from all samples: a small share of one
  // would ask for any.
  float middle(float was, float near) const {
    const float root = perceived(was), low = std::max(root - near, 0.0f), high = root + near;
    const float from = std::max(lo, low * low - kDark), to = std::min(hi, high * high - kDark);
    const float at = lo > hi ? 0.5f * (lo + hi) : from <= to ? 0.5f * (from + to) : was < lo ? lo : hi;
    return std::max(least <= most ? std::clamp(at, least, most) : at, 0.0f);
  }
};

// A parabola over the plane, 1 x y x^2/2 x y y^2/2, fitted to values of several channels.
class Parabola {
 public:
  static constexpr int kTerms = 6;

  void add(double x, double y, const Tint& values, std::size_t channels) {
    const double terms[kTerms] = {1.0, x, y, 0.5 * x * x, x * y, 0.5 * y * y};
    for (int i = 0; i < kTerms; ++i) {
      for (int k = 0; k <= i; ++k) left_[i][k] += terms[i] * terms[k];
      for (std::size_t c = 0; c < channels; ++c) right_[c][i] += terms[i] * values[c];
    }
    ++count_;
  }
  // Cholesky's decomposition; false where values are too few, or all on one conic.
  bool solve(std::size_t channels) {
    if (count_ <= kTerms) return false;
    for (int i = 0; i < kTerms; ++i)
      for (int k = 0; k <= i; ++k) {
        double sum = left_[i][k];
        for (int j = 0; j < k; ++j) sum -= left_[i][j] * left_[k][j];
        if (i == k && !(sum > 1e-6 * left_[i][i])) return false;
        left_[i][k] = i == k ? std::sqrt(sum) : sum / left_[k][k];
      }
    for (std::size_t c = 0; c < channels; ++c) {
      auto& x = right_[c];
      for (int i = 0; i < kTerms; ++i) {
        for (int k = 0; k < i; ++k) x[i] -= left_[i][k] * x[k];
        x[i] /= left_[i][i];
      }
      for (int i = kTerms - 1; i >= 0; --i) {
        for (int k = i + 1; k < kTerms; ++k) x[i] -= left_[k][i] * x[k];
        x[i] /= left_[i][i];
      }
    }
    return true;
  }
  // Second derivatives: (x y; y z).
  glm::dvec3 form(std::size_t channel) const {
    return {right_[channel][3], right_[channel][4], right_[channel][5]};
  }

 private:
  double left_[kTerms][kTerms]{};
  std::array<std::array<double, kTerms>, std::tuple_size_v<Tint>> right_{};
  int count_ = 0;
};

}  // namespace

// How the colours bend over a smooth ring, as distances, in the channel in which they bend the most; 0 where
// there are too few samples.
glm::dvec3 Ring::tintForm() const {
  const Tints& tints = sampled_.tints;
  if (!tints.any()) return glm::dvec3(0.0);
  const Sector& s = sectors_[0];
  const double size = std::sqrt(1.0 / static_cast<double>(areas_[0]));  // about
  Parabola parabola;
  for (const Placed& p : placed_) {
    if (!tints.isKnown(p.sample)) continue;
    const glm::vec3 d = sampled_.samples[p.sample].at - centre_;
    parabola.add(glm::dot(d, s.x) / size, glm::dot(d, s.y) / size, tints.sample(p.sample), tints.channels());
  }
  glm::dvec3 most(0.0);
  if (!parabola.solve(tints.channels())) return most;
  for (std::size_t k = 0; k < tints.channels(); ++k)
    if (const glm::dvec3 form = absolute(parabola.form(k)); form.x + form.z > most.x + most.z) most = form;
  return tints.distance(1.0f) / (size * size) * most;
}

// Each sector's centre gets the colour in the middle of where all samples are seen at the aim, or stays as it
// is, if that is nearer to them on the whole. False: none has all samples within the limit.
bool Ring::chooseTints(float limit) {
  for (Placed& p : placed_) p.weights = clampedWeights(p.weights);
  for (const Sector& s : sectors_) {
    // The mean, exactly where all are one.
    const Tint first = centres_[s.first];
    Tint was = first;
    for (Index i = s.first; i < s.last; ++i)
      for (std::size_t k = 0; k < was.size(); ++k)
        was[k] += (centres_[i][k] - first[k]) / static_cast<float>(s.last - s.first);
    const std::optional<Tint> best = bestTint(s, was, limit);
    if (!best) return false;
    // The last that is seen stays.
    const float ofWas = seeTints(s, was), ofBest = seeTints(s, *best);
    if (ofWas <= ofBest) seeTints(s, was);
    for (Index i = s.first; i < s.last; ++i) centres_[i] = ofWas <= ofBest ? was : *best;
  }
  return std::ranges::all_of(placed_, [&](const Placed& p) { return p.tint <= limit; });
}

std::optional<Tint> Ring::bestTint(const Sector& s, const Tint& was, float limit) const {
  const Tints& tints = sampled_.tints;
  const float most = tints.difference(aim_);
  std::array<Bounds, std::tuple_size_v<Tint>> bounds;
  for (const Placed& p : placed_) {
    if (p.spoke < s.first || p.spoke >= s.last || !tints.isKnown(p.sample)) continue;
    const Tint &sample = tints.sample(p.sample), &a = rims_[p.spoke][0], &b = rims_[p.spoke][1];
    for (std::size_t k = 0; k < tints.channels(); ++k) {
      const float rim = p.weights.y * a[k] + p.weights.z * b[k] + kDark, high = sample[k] + most,
                  low = sample[k] - most;
      bounds[k].least = std::min(bounds[k].least, std::max(low * std::abs(low) - kDark, 0.0f));
      bounds[k].most = std::max(bounds[k].most, high * high - kDark);
      if (p.weights.x < kNoShare) continue;
      bounds[k].hi = std::min(bounds[k].hi, (high * high - rim) / p.weights.x);
      if (low > 0.0f) bounds[k].lo = std::max(bounds[k].lo, (low * low - rim) / p.weights.x);
    }
  }
  Tint chosen{};
  for (std::size_t k = 0; k < tints.channels(); ++k) {
    if (limit <= aim_ && bounds[k].lo > bounds[k].hi + kRounding) return {};
    chosen[k] = bounds[k].middle(was[k], most);
  }
  return chosen;
}

// Shows a sector's samples with this centre. Returns the sum of the eighth powers of how far they are from
// their colours, in aims.
float Ring::seeTints(const Sector& s, const Tint& centre) {
  float sum = 0.0f;
  for (Placed& p : placed_) {
    if (p.spoke < s.first || p.spoke >= s.last) continue;
    p.tint =
        sampled_.tints.distance(p.sample, mixed(centre, rims_[p.spoke][0], rims_[p.spoke][1], p.weights));
    float d = std::max(p.tint / aim_, kLeastDistance);
    d *= d, d *= d;
    sum += d * d;
  }
  return sum;
}

}  // namespace sdf
