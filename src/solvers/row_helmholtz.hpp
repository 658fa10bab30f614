#pragma once
#include <vector>

namespace pliant {

/// How the unknowns of a one-dimensional problem continue beyond its ends.
enum class LineEnds {
  periodic,
  bounded  ///< x_{-1} = low x_0 and x_n = high x_{n-1}
};

/// Solves (1 - a d2) x = d along contiguous rows of n unknowns, d2 the second difference with unit spacing.
///
/// The constant operator factors into two first-order recursions of ratio r, run as 8-lane prefix scans, which give the
/// solution of a row that continues freely at both ends; two decaying powers of r then satisfy the ends.
class RowHelmholtz {
 public:
  RowHelmholtz() = default;
  /// a >= 0. `low` and `high` are used by bounded ends: 0 value at the neighbouring node, -1 value 0 half a cell away,
  /// +1 zero gradient.
  RowHelmholtz(int n, double a, LineEnds ends, double low, double high);
  /// In place.
  void solve(double* row) const;

 private:
  int n_ = 0;
  int reach_ = 0;  // cells from an end beyond which the power is below round-off
  double r_ = 0, gain_ = 1;
  double c_[2][4] = {};        // the two amplitudes from x at 0, n - 1 of the free solution
  std::vector<double> power_;  // r^(i + 1)
};

}  // namespace pliant
