#include "sdf/expr/vec.h"

#include <algorithm>
#include <cmath>

#include "sdf/base/box.h"

namespace sdf {
namespace {

using Matrix = std::array<std::array<double, 3>, 3>;

// M^T M.
Matrix gramOf(const Matrix& m) {
  Matrix g{};
  for (int i = 0; i < 3; ++i)
    for (int j = 0; j < 3; ++j)
      for (int k = 0; k < 3; ++k) g[i][j] += m[k][i] * m[k][j];
  return g;
}

// Largest eigenvalue of a positive symmetric matrix, not rounded down by more than its digits. A matrix's
// Frobenius norm is at least its largest eigenvalue and at most sqrt(3) times that, and squaring the matrix
// takes the root of the factor.
double largestEigenvalue(Matrix g) {
  if (g[0][1] == 0.0 && g[0][2] == 0.0 && g[1][2] == 0.0) return std::max({g[0][0], g[1][1], g[2][2]});
  constexpr int kSquarings = 50;  // 3^(2^-51) is 1 to double's digits
  double result = 1.0;
  for (int i = 0; i <= kSquarings; ++i) {
    double sum = 0.0;
    for (const auto& row : g)
      for (double v : row) sum += v * v;
    const double norm = std::sqrt(sum);
    result *= std::pow(norm, std::ldexp(1.0, -i));
    for (auto& row : g)
      for (double& v : row) v /= norm;
    g = gramOf(g);
  }
  return result;
}

// sqrt of the largest row sum times the largest column sum is no less than the spectral norm.
double normBound(const Matrix& m) {
  double rows = 0.0, columns = 0.0;
  for (int i = 0; i < 3; ++i) {
    rows = std::max(rows, m[i][0] + m[i][1] + m[i][2]);
    columns = std::max(columns, m[0][i] + m[1][i] + m[2][i]);
  }
  return std::sqrt(rows * columns);
}

}  // namespace

double stretchOf(const Vec3E& a) {
  const double apart = std::hypot(a.x.lipschitz(), a.y.lipschitz(), a.z.lipschitz());
  if (!(apart < kInfinity)) return kInfinity;
  Matrix middle{}, off{};
  for (int i = 0; i < 3; ++i)
    for (int k = 0; k < 3; ++k) {
      const Interval& d = (i == 0 ? a.x : i == 1 ? a.y : a.z).partials()[k];
      middle[i][k] = 0.5 * (d.lo + d.hi);
      off[i][k] = 0.5 * (d.hi - d.lo);
    }
  return std::min(apart, std::sqrt(largestEigenvalue(gramOf(middle))) + normBound(off));
}

}  // namespace sdf
