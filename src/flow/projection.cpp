#include "flow/projection.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "core/loops.hpp"

namespace pliant {

void divergence_plane(const Grid& grid, ConstView<FaceX> u, ConstView<FaceY> v, ConstView<FaceZ> w, double scale,
                      View<Center> phi, int k) {
  const double sx = scale / grid.dx(), sy = scale / grid.dy(), sz = scale / grid.dz_c()[k];
  const int nx = grid.nx();
  for_rows(grid.ny(), [&](int j) {
    const double* __restrict a = u.at_row(j, k);
    const double* __restrict b = v.at_row(j, k);
    const double* __restrict bs = v.at_row(j - 1, k);
    const double* __restrict c = w.at_row(j, k);
    const double* __restrict cb = w.at_row(j, k - 1);
    double* __restrict out = phi.at_row(j, k);
    for_each(nx, [=](int i) { out[i] = sx * (a[i] - a[i - 1]) + sy * (b[i] - bs[i]) + sz * (c[i] - cb[i]); });
  });
}

namespace {

template <CorrectionTerms terms>
void correct(const Grid& grid, double dt_alpha, double weight, ConstView<Center> phi, const CorrectedFields& f, int k) {
  const int nx = grid.nx();
  const auto dz_c = grid.dz_c(), dz_f = grid.dz_f();
  const double gx = dt_alpha / grid.dx(), gy = dt_alpha / grid.dy(), gz = dt_alpha / dz_f[k];
  const double lx = weight / (grid.dx() * grid.dx()), ly = weight / (grid.dy() * grid.dy());
  const double up = weight / (dz_c[k] * dz_f[k]), down = weight / (dz_c[k] * dz_f[k - 1]);
  for_rows(grid.ny(), [&](int j) {
    const double* __restrict c = phi.at_row(j, k);
    const double* __restrict n = phi.at_row(j + 1, k);
    const double* __restrict s = phi.at_row(j - 1, k);
    const double* __restrict t = phi.at_row(j, k + 1);
    const double* __restrict b = phi.at_row(j, k - 1);
    double* __restrict u = f.u.at_row(j, k);
    double* __restrict v = f.v.at_row(j, k);
    double* __restrict w = f.w.at_row(j, k);
    double* __restrict p = f.p.at_row(j, k);
    for_each(nx, [=](int i) {
      u[i] -= gx * (c[i + 1] - c[i]);
      v[i] -= gy * (n[i] - c[i]);
      w[i] -= gz * (t[i] - c[i]);
      double change = c[i];
      if constexpr (terms == CorrectionTerms::all)
        change -= lx * (c[i + 1] - 2 * c[i] + c[i - 1]) + ly * (n[i] - 2 * c[i] + s[i]);
      if constexpr (terms != CorrectionTerms::none) change -= up * (t[i] - c[i]) - down * (c[i] - b[i]);
      p[i] += change;
    });
  });
}

}  // namespace

void correct_plane(const Grid& grid, CorrectionTerms terms, double dt_alpha, double lap_weight, ConstView<Center> phi,
                   const CorrectedFields& fields, int k) {
  switch (terms) {
    case CorrectionTerms::none:
      return correct<CorrectionTerms::none>(grid, dt_alpha, lap_weight, phi, fields, k);
    case CorrectionTerms::z:
      return correct<CorrectionTerms::z>(grid, dt_alpha, lap_weight, phi, fields, k);
    case CorrectionTerms::all:
      return correct<CorrectionTerms::all>(grid, dt_alpha, lap_weight, phi, fields, k);
  }
}

double convective_rate(const Grid& grid, ConstView<FaceX> u, ConstView<FaceY> v, ConstView<FaceZ> w) {
  const double ix = 1 / grid.dx(), iy = 1 / grid.dy();
  double largest = 0;
  for (int k = 0; k < grid.nz(); ++k) {
    const double iz = 1 / grid.dz_c()[k];
    for (int j = 0; j < grid.ny(); ++j) {
      const double* a = u.at_row(j, k);
      const double* b = v.at_row(j, k);
      const double* bs = v.at_row(j - 1, k);
      const double* c = w.at_row(j, k);
      const double* cb = w.at_row(j, k - 1);
      // A larger face of a cell counts, so that a wall's tangential neighbour is not missed. NaN must come through.
      for (int i = 0; i < grid.nx(); ++i) {
        const double rate = ix * std::max(std::abs(a[i]), std::abs(a[i - 1])) +
                            iy * std::max(std::abs(b[i]), std::abs(bs[i])) +
                            iz * std::max(std::abs(c[i]), std::abs(cb[i]));
        if (!(rate <= largest)) largest = rate;
      }
      if (std::isnan(largest)) return std::numeric_limits<double>::infinity();
    }
  }
  return largest;
}

double largest_divergence(const Grid& grid, ConstView<FaceX> u, ConstView<FaceY> v, ConstView<FaceZ> w) {
  double largest = 0;
  for (int k = 0; k < grid.nz(); ++k) {
    const double iz = 1 / grid.dz_c()[k];
    for (int j = 0; j < grid.ny(); ++j)
      for (int i = 0; i < grid.nx(); ++i) {
        const double divergence = (u(i, j, k) - u(i - 1, j, k)) / grid.dx() +
                                  (v(i, j, k) - v(i, j - 1, k)) / grid.dy() + (w(i, j, k) - w(i, j, k - 1)) * iz;
        const double size = std::abs(divergence);
        if (!(size <= largest)) largest = size;
        if (std::isnan(size)) return std::numeric_limits<double>::infinity();
      }
  }
  return largest;
}

}  // namespace pliant
