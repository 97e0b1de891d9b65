// Sums of doubles whose sign is right (Shewchuk 1997, Adaptive Precision Floating-Point Arithmetic and Fast
// Robust Geometric Predicates).
#pragma once
#include <array>
#include <cmath>

namespace sdf {

/// A sum that is never rounded: numbers that do not overlap, the smallest first (Shewchuk's grow-expansion).
class ExactSum {
 public:
  void add(double x) {
    int kept = 0;
    for (int i = 0; i < count_; ++i) {
      const double sum = x + part_[i], virtualX = sum - part_[i];
      const double lost = (x - virtualX) + (part_[i] - (sum - virtualX));
      if (lost != 0.0) part_[kept++] = lost;
      x = sum;
    }
    if (x != 0.0) part_[kept++] = x;
    count_ = kept;
  }
  /// Products of floats are exact in double, those of three are two doubles.
  void addProduct(double exact, double factor) {
    const double product = exact * factor;
    add(std::fma(exact, factor, -product));
    add(product);
  }
  int sign() const { return count_ == 0 ? 0 : part_[count_ - 1] > 0.0 ? 1 : -1; }

 private:
  std::array<double, 48> part_;
  int count_ = 0;
};

}  // namespace sdf
