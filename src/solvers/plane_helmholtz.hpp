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
  int unknowns() const { return n_; }

  /// In place on `width` columns of rows `stride` apart. `work` holds 2 * width doubles.
  void solve(double* plane, int width, std::ptrdiff_t stride, double* work) const;

  /// The same row by row, for callers that have other work at each: forward for j = 0 .. n - 1, then turn, then
  /// backward for j = n - 1 .. 0, with the row and the one treated before it.
  void forward_row(int j, double* row, const double* below, int width, double* work) const;
  void turn(const double* last_row, int width, double* work) const;
  void backward_row(int j, double* row, const double* above, int width, const double* work) const;

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
