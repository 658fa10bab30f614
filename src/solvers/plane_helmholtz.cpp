#include "solvers/plane_helmholtz.hpp"

#include <algorithm>

#include "core/loops.hpp"

namespace pliant {

PlaneHelmholtz::PlaneHelmholtz(int n, double a, LineEnds ends, double low, double high)
    : n_(n), off_diagonal_(-a), ends_(ends) {
  double pivot_inverse = 0, below = 0, weight = 1, first_below = 0;
  for (int j = 0; j < n; ++j) {
    double diagonal = 1 + 2 * a;
    if (ends == LineEnds::bounded && j == 0) diagonal -= a * low;
    if (ends == LineEnds::bounded && j == n - 1) diagonal -= a * high;
    if (j > 0) weight *= a * pivot_inverse;
    pivot_inverse = 1 / (diagonal - (j == 0 ? 0.0 : a * a * pivot_inverse));
    below = a * pivot_inverse * (j == 0 ? 1.0 : below);
    if (below < 1e-200) below = 0;
    if (weight < 1e-200) weight = 0;
    inverse_.push_back(pivot_inverse);
    from_below_.push_back(below);
    weight_.push_back(weight);
    first_below += weight * below;
  }
  // last = y_last + below last + (a / pivot) first; first = y_first + first_below last + weight (a / pivot) first
  const double last_above = a * pivot_inverse, first_above = weight * last_above;
  const double m[2][2] = {{1 - below, -last_above}, {-first_below, 1 - first_above}};
  const double det = m[0][0] * m[1][1] - m[0][1] * m[1][0];
  closure_[0][0] = m[1][1] / det;
  closure_[0][1] = -m[0][1] / det;
  closure_[1][0] = -m[1][0] / det;
  closure_[1][1] = m[0][0] / det;
}

void PlaneHelmholtz::forward_row(int j, double* row, const double* row_below, int width, double* work) const {
  const auto at = static_cast<std::size_t>(j);
  double* __restrict first = work;
  double* __restrict d = row;
  const double inverse = inverse_[at], weight = weight_[at];
  if (j == 0) {
    std::fill_n(work, 2 * width, 0.0);
    for_each(width, [=](int i) { d[i] *= inverse; });
  } else {
    const double off = off_diagonal_;
    const double* __restrict below = row_below;
    for_each(width, [=](int i) { d[i] = (d[i] - off * below[i]) * inverse; });
  }
  if (ends_ == LineEnds::periodic && weight != 0) for_each(width, [=](int i) { first[i] += weight * d[i]; });
}

void PlaneHelmholtz::turn(const double* last_row, int width, double* work) const {
  if (ends_ != LineEnds::periodic) return;
  double* __restrict first = work;
  double* __restrict last = work + width;
  const double* __restrict d = last_row;
  const double ll = closure_[0][0], lf = closure_[0][1], fl = closure_[1][0], ff = closure_[1][1];
  for_each(width, [=](int i) {
    const double y_first = first[i];
    last[i] = ll * d[i] + lf * y_first;
    first[i] = fl * d[i] + ff * y_first;
  });
}

void PlaneHelmholtz::backward_row(int j, double* row, const double* row_above, int width, const double* work) const {
  const bool periodic = ends_ == LineEnds::periodic;
  if (j == n_ - 1 && !periodic) return;
  const auto at = static_cast<std::size_t>(j);
  double* __restrict d = row;
  const double factor = off_diagonal_ * inverse_[at];
  const double* __restrict above = j == n_ - 1 ? work : row_above;
  const double* __restrict last = work + width;
  const double from_below = periodic ? from_below_[at] : 0.0;
  if (from_below != 0) {
    for_each(width, [=](int i) { d[i] += from_below * last[i] - factor * above[i]; });
  } else {
    for_each(width, [=](int i) { d[i] -= factor * above[i]; });
  }
}

void PlaneHelmholtz::solve(double* plane, int width, std::ptrdiff_t stride, double* work) const {
  for (int j = 0; j < n_; ++j)
    forward_row(j, plane + j * stride, j == 0 ? nullptr : plane + (j - 1) * stride, width, work);
  turn(plane + (n_ - 1) * stride, width, work);
  for (int j = n_ - 1; j >= 0; --j)
    backward_row(j, plane + j * stride, j == n_ - 1 ? nullptr : plane + (j + 1) * stride, width, work);
}

}  // namespace pliant
