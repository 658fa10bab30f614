#include "flow/projection.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "core/loops.hpp"

namespace pliant {

DivergenceRows::DivergenceRows(const Grid& grid, ConstView<FaceX> u, ConstView<FaceY> v, ConstView<FaceZ> w,
                               double scale, Plane<Center> out, int k)
    : u_(u.at_plane(k)),
      v_(v.at_plane(k)),
      w_(w.at_plane(k)),
      w_below_(w.at_plane(k - 1)),
      out_(out),
      sx_(scale / grid.dx()),
      sy_(scale / grid.dy()),
      sz_(scale / grid.dz_c()[k]),
      nx_(grid.nx()) {}

void DivergenceRows::operator()(int j) const {
  const double* __restrict a = u_.at_row(j);
  const double* __restrict b = v_.at_row(j);
  const double* __restrict bs = v_.at_row(j - 1);
  const double* __restrict c = w_.at_row(j);
  const double* __restrict cb = w_below_.at_row(j);
  double* __restrict out = out_.at_row(j);
  const double sx = sx_, sy = sy_, sz = sz_;
  for_each(nx_, [=](int i) { out[i] = sx * (a[i] - a[i - 1]) + sy * (b[i] - bs[i]) + sz * (c[i] - cb[i]); });
}

VelocityCorrection::VelocityCorrection(const Grid& grid, double dt_alpha, ConstPlane<Center> phi,
                                       ConstPlane<Center> phi_above, VelocityPlane<const double> from,
                                       VelocityPlane<double> to, int k)
    : phi_(phi),
      phi_above_(phi_above),
      from_(from),
      to_(to),
      gx_(dt_alpha / grid.dx()),
      gy_(dt_alpha / grid.dy()),
      gz_(dt_alpha / grid.dz_f()[k]),
      nx_(grid.nx()) {}

void VelocityCorrection::operator()(int j) const {
  const double* __restrict c = phi_.at_row(j);
  const double* __restrict n = phi_.at_row(j + 1);
  const double* __restrict t = phi_above_.at_row(j);
  // Not restricted: source and target may be the same row.
  const double *u_from = from_.u.at_row(j), *v_from = from_.v.at_row(j), *w_from = from_.w.at_row(j);
  double *u = to_.u.at_row(j), *v = to_.v.at_row(j), *w = to_.w.at_row(j);
  const double gx = gx_, gy = gy_, gz = gz_;
  for_each(nx_, [=](int i) {
    u[i] = u_from[i] - gx * (c[i + 1] - c[i]);
    v[i] = v_from[i] - gy * (n[i] - c[i]);
    w[i] = w_from[i] - gz * (t[i] - c[i]);
  });
}

PressureCorrection::PressureCorrection(const Grid& grid, CorrectionTerms terms, double lap_weight, const Phi& phi,
                                       Plane<Center> p, int k)
    : terms_(terms),
      phi_(phi),
      p_(p),
      lx_(lap_weight / (grid.dx() * grid.dx())),
      ly_(lap_weight / (grid.dy() * grid.dy())),
      up_(lap_weight / (grid.dz_c()[k] * grid.dz_f()[k])),
      down_(lap_weight / (grid.dz_c()[k] * grid.dz_f()[k - 1])),
      nx_(grid.nx()) {}

template <CorrectionTerms terms>
void PressureCorrection::row(int j) const {
  double* __restrict p = p_.at_row(j);
  const double* __restrict c = phi_.here.at_row(j);
  if constexpr (terms == CorrectionTerms::none) {
    for_each(nx_, [=](int i) { p[i] += c[i]; });
  } else {
    const double* __restrict n = phi_.here.at_row(j + 1);
    const double* __restrict s = phi_.here.at_row(j - 1);
    const double* __restrict t = phi_.above.at_row(j);
    const double* __restrict b = phi_.below.at_row(j);
    const double lx = lx_, ly = ly_, up = up_, down = down_;
    for_each(nx_, [=](int i) {
      double change = c[i];
      if constexpr (terms == CorrectionTerms::all)
        change -= lx * (c[i + 1] - 2 * c[i] + c[i - 1]) + ly * (n[i] - 2 * c[i] + s[i]);
      change -= up * (t[i] - c[i]) - down * (c[i] - b[i]);
      p[i] += change;
    });
  }
}

void PressureCorrection::operator()(int j) const {
  switch (terms_) {
    case CorrectionTerms::none:
      return row<CorrectionTerms::none>(j);
    case CorrectionTerms::z:
      return row<CorrectionTerms::z>(j);
    case CorrectionTerms::all:
      return row<CorrectionTerms::all>(j);
  }
}

double convective_rate(const Grid& grid, ConstView<FaceX> u, ConstView<FaceY> v, ConstView<FaceZ> w, int k,
                       double largest) {
  const double ix = 1 / grid.dx(), iy = 1 / grid.dy(), iz = 1 / grid.dz_c()[k];
  const int nx = grid.nx();
  constexpr int lanes = 8;
  double best[lanes];
  for (double& b : best) b = largest;
  for (int j = 0; j < grid.ny(); ++j) {
    const double* __restrict a = u.at_row(j, k);
    const double* __restrict b = v.at_row(j, k);
    const double* __restrict bs = v.at_row(j - 1, k);
    const double* __restrict c = w.at_row(j, k);
    const double* __restrict cb = w.at_row(j, k - 1);
    // A larger face of a cell counts, so that a wall's tangential neighbour is not missed. NaN must come through.
    const auto rate = [=](int i) {
      return ix * std::max(std::abs(a[i]), std::abs(a[i - 1])) + iy * std::max(std::abs(b[i]), std::abs(bs[i])) +
             iz * std::max(std::abs(c[i]), std::abs(cb[i]));
    };
    const int whole = nx / lanes * lanes;
    for (int i = 0; i < whole; i += lanes)
      for (int l = 0; l < lanes; ++l) {
        const double r = rate(i + l);
        best[l] = r <= best[l] ? best[l] : r;
      }
    for (int i = whole; i < nx; ++i) {
      const double r = rate(i);
      best[0] = r <= best[0] ? best[0] : r;
    }
  }
  for (const double b : best)
    if (!(b <= largest)) largest = b;
  return std::isnan(largest) ? std::numeric_limits<double>::infinity() : largest;
}

double convective_rate(const Grid& grid, ConstView<FaceX> u, ConstView<FaceY> v, ConstView<FaceZ> w) {
  double largest = 0;
  for (int k = 0; k < grid.nz(); ++k) largest = convective_rate(grid, u, v, w, k, largest);
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
