#include "flow/momentum.hpp"

#include "core/loops.hpp"

namespace pliant {
namespace {

// The constants of a plane, by value for the row kernels.
struct PlaneFactors {
  double dt_gamma, dt_rho, dt_alpha;
  double x, y;                    // 1/4 of the inverse spacings: fluxes are products of two sums
  double grad_x, grad_y, grad_z;  // dt alpha over the spacing
  double visc_x, visc_y;          // nu over the square of the spacing
  double cell_z;                  // 1/4 over the thickness of the u and v cells
  double visc_z_up, visc_z_down;
  double face_z;  // 1/4 over the thickness of the w cell
  double visc_w_up, visc_w_down;
  double weight_low, weight_high;  // of the two cells that a w cell spans; they sum to 1
  Vec3 push;                       // dt alpha times the acceleration
};

template <ViscousMode mode, HistoryUse history>
struct Combine {
  // value from the advection term, the viscous terms by direction, the pressure difference and the old velocity
  static inline double apply(const PlaneFactors& f, double advection, double visc_xy, double visc_z, double pressure,
                             double push, double old, double& h) {
    double explicit_terms = -advection, implicit_terms = 0;
    if constexpr (mode == ViscousMode::explicit_rk3) explicit_terms += visc_xy + visc_z;
    else if constexpr (mode == ViscousMode::implicit_z) explicit_terms += visc_xy, implicit_terms = visc_z;
    else implicit_terms = visc_xy + visc_z;
    double rhs = f.dt_gamma * explicit_terms - pressure + push;
    if constexpr (mode != ViscousMode::explicit_rk3) rhs += f.dt_alpha * implicit_terms;
    if constexpr (history != HistoryUse::write) rhs += f.dt_rho * h;
    if constexpr (history != HistoryUse::read) h = explicit_terms;
    return mode == ViscousMode::explicit_rk3 ? old + rhs : rhs;
  }
};

template <ViscousMode mode, HistoryUse history>
void u_row(const PlaneFactors& f, const MomentumInput& in, const MomentumOutput& out, int nx, int j, int k) {
  const double* __restrict u = in.u.at_row(j, k);
  const double* __restrict us = in.u.at_row(j - 1, k);
  const double* __restrict un = in.u.at_row(j + 1, k);
  const double* __restrict ub = in.u.at_row(j, k - 1);
  const double* __restrict ut = in.u.at_row(j, k + 1);
  const double* __restrict v = in.v.at_row(j, k);
  const double* __restrict vs = in.v.at_row(j - 1, k);
  const double* __restrict w = in.w.at_row(j, k);
  const double* __restrict wb = in.w.at_row(j, k - 1);
  const double* __restrict p = in.p.at_row(j, k);
  double* __restrict h = out.history_u.at_row(j, k);
  double* __restrict result = out.u.at_row(j, k);
  for_each(nx, [=](int i) {
    const double c = u[i], e = u[i + 1], o = u[i - 1], n = un[i], s = us[i], t = ut[i], b = ub[i];
    const double advection = f.x * ((e + c) * (e + c) - (c + o) * (c + o)) +
                             f.y * ((v[i] + v[i + 1]) * (n + c) - (vs[i] + vs[i + 1]) * (c + s)) +
                             f.cell_z * ((w[i] + w[i + 1]) * (t + c) - (wb[i] + wb[i + 1]) * (c + b));
    const double visc_xy = f.visc_x * (e - 2 * c + o) + f.visc_y * (n - 2 * c + s);
    const double visc_z = f.visc_z_up * (t - c) - f.visc_z_down * (c - b);
    result[i] =
        Combine<mode, history>::apply(f, advection, visc_xy, visc_z, f.grad_x * (p[i + 1] - p[i]), f.push.x, c, h[i]);
  });
}

template <ViscousMode mode, HistoryUse history>
void v_row(const PlaneFactors& f, const MomentumInput& in, const MomentumOutput& out, int nx, int j, int k) {
  const double* __restrict v = in.v.at_row(j, k);
  const double* __restrict vs = in.v.at_row(j - 1, k);
  const double* __restrict vn = in.v.at_row(j + 1, k);
  const double* __restrict vb = in.v.at_row(j, k - 1);
  const double* __restrict vt = in.v.at_row(j, k + 1);
  const double* __restrict u = in.u.at_row(j, k);
  const double* __restrict un = in.u.at_row(j + 1, k);
  const double* __restrict w = in.w.at_row(j, k);
  const double* __restrict wn = in.w.at_row(j + 1, k);
  const double* __restrict wb = in.w.at_row(j, k - 1);
  const double* __restrict wnb = in.w.at_row(j + 1, k - 1);
  const double* __restrict p = in.p.at_row(j, k);
  const double* __restrict pn = in.p.at_row(j + 1, k);
  double* __restrict h = out.history_v.at_row(j, k);
  double* __restrict result = out.v.at_row(j, k);
  for_each(nx, [=](int i) {
    const double c = v[i], e = v[i + 1], o = v[i - 1], n = vn[i], s = vs[i], t = vt[i], b = vb[i];
    const double advection = f.x * ((u[i] + un[i]) * (e + c) - (u[i - 1] + un[i - 1]) * (c + o)) +
                             f.y * ((n + c) * (n + c) - (c + s) * (c + s)) +
                             f.cell_z * ((w[i] + wn[i]) * (t + c) - (wb[i] + wnb[i]) * (c + b));
    const double visc_xy = f.visc_x * (e - 2 * c + o) + f.visc_y * (n - 2 * c + s);
    const double visc_z = f.visc_z_up * (t - c) - f.visc_z_down * (c - b);
    result[i] =
        Combine<mode, history>::apply(f, advection, visc_xy, visc_z, f.grad_y * (pn[i] - p[i]), f.push.y, c, h[i]);
  });
}

template <ViscousMode mode, HistoryUse history>
void w_row(const PlaneFactors& f, const MomentumInput& in, const MomentumOutput& out, int nx, int j, int k) {
  const double* __restrict w = in.w.at_row(j, k);
  const double* __restrict ws = in.w.at_row(j - 1, k);
  const double* __restrict wn = in.w.at_row(j + 1, k);
  const double* __restrict wb = in.w.at_row(j, k - 1);
  const double* __restrict wt = in.w.at_row(j, k + 1);
  const double* __restrict u = in.u.at_row(j, k);
  const double* __restrict ut = in.u.at_row(j, k + 1);
  const double* __restrict v = in.v.at_row(j, k);
  const double* __restrict vt = in.v.at_row(j, k + 1);
  const double* __restrict vs = in.v.at_row(j - 1, k);
  const double* __restrict vst = in.v.at_row(j - 1, k + 1);
  const double* __restrict p = in.p.at_row(j, k);
  const double* __restrict pt = in.p.at_row(j, k + 1);
  double* __restrict h = out.history_w.at_row(j, k);
  double* __restrict result = out.w.at_row(j, k);
  const double low = 2 * f.weight_low, high = 2 * f.weight_high;
  for_each(nx, [=](int i) {
    const double c = w[i], e = w[i + 1], o = w[i - 1], n = wn[i], s = ws[i], t = wt[i], b = wb[i];
    const double advection =
        f.x * ((low * u[i] + high * ut[i]) * (e + c) - (low * u[i - 1] + high * ut[i - 1]) * (c + o)) +
        f.y * ((low * v[i] + high * vt[i]) * (n + c) - (low * vs[i] + high * vst[i]) * (c + s)) +
        f.face_z * ((t + c) * (t + c) - (c + b) * (c + b));
    const double visc_xy = f.visc_x * (e - 2 * c + o) + f.visc_y * (n - 2 * c + s);
    const double visc_z = f.visc_w_up * (t - c) - f.visc_w_down * (c - b);
    result[i] =
        Combine<mode, history>::apply(f, advection, visc_xy, visc_z, f.grad_z * (pt[i] - p[i]), f.push.z, c, h[i]);
  });
}

template <ViscousMode mode, HistoryUse history>
void plane(const PlaneFactors& f, const Grid& grid, const MomentumInput& in, const MomentumOutput& out, int k) {
  const int nx = grid.nx(), ny = grid.ny();
  for_rows(ny, [&](int j) {
    u_row<mode, history>(f, in, out, nx, j, k);
    v_row<mode, history>(f, in, out, nx, j, k);
    w_row<mode, history>(f, in, out, nx, j, k);
  });
}

template <ViscousMode mode>
void plane(HistoryUse history, const PlaneFactors& f, const Grid& grid, const MomentumInput& in,
           const MomentumOutput& out, int k) {
  switch (history) {
    case HistoryUse::write:
      return plane<mode, HistoryUse::write>(f, grid, in, out, k);
    case HistoryUse::read_write:
      return plane<mode, HistoryUse::read_write>(f, grid, in, out, k);
    case HistoryUse::read:
      return plane<mode, HistoryUse::read>(f, grid, in, out, k);
  }
}

PlaneFactors plane_factors(const Grid& grid, const MomentumFactors& m, int k) {
  const auto dz_c = grid.dz_c(), dz_f = grid.dz_f();
  const double nu = m.viscosity, span = dz_c[k] + dz_c[k + 1];
  PlaneFactors f{};
  f.dt_gamma = m.dt_gamma;
  f.dt_rho = m.dt_rho;
  f.dt_alpha = m.dt_alpha;
  f.x = 0.25 / grid.dx();
  f.y = 0.25 / grid.dy();
  f.grad_x = m.dt_alpha / grid.dx();
  f.grad_y = m.dt_alpha / grid.dy();
  f.grad_z = m.dt_alpha / dz_f[k];
  f.visc_x = nu / (grid.dx() * grid.dx());
  f.visc_y = nu / (grid.dy() * grid.dy());
  f.cell_z = 0.25 / dz_c[k];
  f.visc_z_up = nu / (dz_c[k] * dz_f[k]);
  f.visc_z_down = nu / (dz_c[k] * dz_f[k - 1]);
  f.face_z = 0.25 / dz_f[k];
  f.visc_w_up = nu / (dz_f[k] * dz_c[k + 1]);
  f.visc_w_down = nu / (dz_f[k] * dz_c[k]);
  f.weight_low = dz_c[k] / span;
  f.weight_high = dz_c[k + 1] / span;
  f.push = m.dt_alpha * m.acceleration;
  return f;
}

}  // namespace

void momentum_plane(const Grid& grid, ViscousMode mode, HistoryUse history, const MomentumFactors& factors,
                    const MomentumInput& in, const MomentumOutput& out, int k) {
  const PlaneFactors f = plane_factors(grid, factors, k);
  switch (mode) {
    case ViscousMode::explicit_rk3:
      return plane<ViscousMode::explicit_rk3>(history, f, grid, in, out, k);
    case ViscousMode::implicit_z:
      return plane<ViscousMode::implicit_z>(history, f, grid, in, out, k);
    case ViscousMode::implicit:
      return plane<ViscousMode::implicit>(history, f, grid, in, out, k);
  }
}

}  // namespace pliant
