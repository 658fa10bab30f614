#pragma once
#include <cstddef>
#include <vector>

#include "solvers/row_helmholtz.hpp"

namespace pliant {

/// Solves (1 - a d2) x = d along the columns (j) of a plane, all columns at once; constants factorised once.
class PlaneHelmholtz {
 public:
  PlaneHelmholtz() = default;
  /// n unknowns a column; ends as RowHelmholtz.
  PlaneHelmholtz(int n, double a, LineEnds ends, double low, double high);
  /// In place on `width` columns of rows `stride` apart. `work` holds 2 * width doubles.
  void solve(double* plane, int width, std::ptrdiff_t stride, double* work) const;

 private:
  int n_ = 0;
  double off_diagonal_ = 0;
  LineEnds ends_ = LineEnds::bounded;
  std::vector<double> inverse_;     // 1 / pivot
  std::vector<double> from_below_;  // periodic: weight of the last unknown in the eliminated row
  std::vector<double> weight_;      // periodic: the first unknown is sum weight_j d'_j + ...
  double closure_[2][2] = {};       // periodic: (last, first) from (y_last, y_first)
};

}  // namespace pliant
