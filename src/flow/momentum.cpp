#include "flow/momentum.hpp"

#include "core/loops.hpp"

namespace pliant {
namespace {

using Constants = MomentumRows::Constants;

template <ViscousMode mode, HistoryUse history>
struct Combine {
  // value from the advection term, the viscous terms by direction, the pressure difference and the old velocity
  static inline double apply(const Constants& f, double advection, double visc_xy, double visc_z, double pressure,
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
void u_row(const Constants& f, const MomentumInput& in, const MomentumOutput& out, int nx, int j) {
  const double* __restrict u = in.u.here.at_row(j);
  const double* __restrict us = in.u.here.at_row(j - 1);
  const double* __restrict un = in.u.here.at_row(j + 1);
  const double* __restrict ub = in.u.below.at_row(j);
  const double* __restrict ut = in.u.above.at_row(j);
  const double* __restrict v = in.v.here.at_row(j);
  const double* __restrict vs = in.v.here.at_row(j - 1);
  const double* __restrict w = in.w.here.at_row(j);
  const double* __restrict wb = in.w.below.at_row(j);
  const double* __restrict p = in.p.at_row(j);
  double* __restrict h = out.history_u.at_row(j);
  double* __restrict result = out.u.at_row(j);
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
void v_row(const Constants& f, const MomentumInput& in, const MomentumOutput& out, int nx, int j) {
  const double* __restrict v = in.v.here.at_row(j);
  const double* __restrict vs = in.v.here.at_row(j - 1);
  const double* __restrict vn = in.v.here.at_row(j + 1);
  const double* __restrict vb = in.v.below.at_row(j);
  const double* __restrict vt = in.v.above.at_row(j);
  const double* __restrict u = in.u.here.at_row(j);
  const double* __restrict un = in.u.here.at_row(j + 1);
  const double* __restrict w = in.w.here.at_row(j);
  const double* __restrict wn = in.w.here.at_row(j + 1);
  const double* __restrict wb = in.w.below.at_row(j);
  const double* __restrict wnb = in.w.below.at_row(j + 1);
  const double* __restrict p = in.p.at_row(j);
  const double* __restrict pn = in.p.at_row(j + 1);
  double* __restrict h = out.history_v.at_row(j);
  double* __restrict result = out.v.at_row(j);
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
void w_row(const Constants& f, const MomentumInput& in, const MomentumOutput& out, int nx, int j) {
  const double* __restrict w = in.w.here.at_row(j);
  const double* __restrict ws = in.w.here.at_row(j - 1);
  const double* __restrict wn = in.w.here.at_row(j + 1);
  const double* __restrict wb = in.w.below.at_row(j);
  const double* __restrict wt = in.w.above.at_row(j);
  const double* __restrict u = in.u.here.at_row(j);
  const double* __restrict ut = in.u.above.at_row(j);
  const double* __restrict v = in.v.here.at_row(j);
  const double* __restrict vt = in.v.above.at_row(j);
  const double* __restrict vs = in.v.here.at_row(j - 1);
  const double* __restrict vst = in.v.above.at_row(j - 1);
  const double* __restrict p = in.p.at_row(j);
  const double* __restrict pt = in.p_above.at_row(j);
  double* __restrict h = out.history_w.at_row(j);
  double* __restrict result = out.w.at_row(j);
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
void all_rows(const Constants& f, const MomentumInput& in, const MomentumOutput& out, int nx, int j) {
  u_row<mode, history>(f, in, out, nx, j);
  v_row<mode, history>(f, in, out, nx, j);
  w_row<mode, history>(f, in, out, nx, j);
}

template <ViscousMode mode>
auto row_of(HistoryUse history) {
  return history == HistoryUse::write        ? all_rows<mode, HistoryUse::write>
         : history == HistoryUse::read_write ? all_rows<mode, HistoryUse::read_write>
                                             : all_rows<mode, HistoryUse::read>;
}

auto row_of(ViscousMode mode, HistoryUse history) {
  return mode == ViscousMode::explicit_rk3 ? row_of<ViscousMode::explicit_rk3>(history)
         : mode == ViscousMode::implicit_z ? row_of<ViscousMode::implicit_z>(history)
                                           : row_of<ViscousMode::implicit>(history);
}

Constants constants_of(const Grid& grid, const MomentumFactors& m, int k) {
  const auto dz_c = grid.dz_c(), dz_f = grid.dz_f();
  const double nu = m.viscosity, span = dz_c[k] + dz_c[k + 1];
  Constants f{};
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

MomentumRows::MomentumRows(const Grid& grid, ViscousMode mode, HistoryUse history, const MomentumFactors& factors,
                           const MomentumInput& in, const MomentumOutput& out, int k)
    : constants_(constants_of(grid, factors, k)), in_(in), out_(out), nx_(grid.nx()), row_(row_of(mode, history)) {}

}  // namespace pliant
