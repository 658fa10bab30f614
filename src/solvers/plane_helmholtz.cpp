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

void PlaneHelmholtz::solve(double* plane, int width, std::ptrdiff_t stride, double* work) const {
  const bool periodic = ends_ == LineEnds::periodic;
  double* __restrict first = work;
  double* __restrict last = work + width;
  for (int j = 0; j < n_; ++j) {
    const auto at = static_cast<std::size_t>(j);
    double* __restrict d = plane + j * stride;
    const double inverse = inverse_[at], off = j == 0 ? 0.0 : off_diagonal_, weight = weight_[at];
    const double* __restrict below = j == 0 ? last : d - stride;
    if (j == 0) std::fill_n(work, 2 * width, 0.0);
    if (periodic && weight != 0) {
      for_each(width, [=](int i) {
        d[i] = (d[i] - off * below[i]) * inverse;
        first[i] += weight * d[i];
      });
    } else {
      for_each(width, [=](int i) { d[i] = (d[i] - off * below[i]) * inverse; });
    }
  }
  if (periodic) {
    const double* __restrict d = plane + (n_ - 1) * stride;
    const double ll = closure_[0][0], lf = closure_[0][1], fl = closure_[1][0], ff = closure_[1][1];
    for_each(width, [=](int i) {
      const double y_first = first[i];
      last[i] = ll * d[i] + lf * y_first;
      first[i] = fl * d[i] + ff * y_first;
    });
  }
  for (int j = n_ - 1; j >= 0; --j) {
    const auto at = static_cast<std::size_t>(j);
    double* __restrict d = plane + j * stride;
    const double factor = off_diagonal_ * inverse_[at];
    const double* __restrict above = j == n_ - 1 ? first : d + stride;
    const double from_below = periodic ? from_below_[at] : 0.0;
    if (j == n_ - 1 && !periodic) continue;
    if (from_below != 0) {
      for_each(width, [=](int i) { d[i] += from_below * last[i] - factor * above[i]; });
    } else {
      for_each(width, [=](int i) { d[i] -= factor * above[i]; });
    }
  }
}

}  // namespace pliant
