#include "flow/momentum.hpp"

#include "core/packs.hpp"

namespace pliant {
namespace {

using Constants = MomentumRows::Constants;

inline Pack at(const double* row, int i) { return load_pack(row + i); }
inline Pack east_of(const double* row, int i) { return load_one_on(row + i); }
inline Pack west_of(const double* row, int i) { return load_one_back(row + i); }

struct RowsAround {
  template <class Location>
  RowsAround(const PlaneTriple<Location>& f, int j)
      : south(f.here.at_row(j - 1)),
        here(f.here.at_row(j)),
        north(f.here.at_row(j + 1)),
        below(f.below.at_row(j)),
        above(f.above.at_row(j)) {}
  const double *south, *here, *north, *below, *above;
};

// What the three components do not share: their neighbours in the other fields. Twice the velocity that carries
// momentum through the faces of a cell around u, v or w, and the pressure over it.
struct AroundU {
  AroundU(const Constants&, const MomentumInput& in, int j)
      : own(in.u, j),
        v(in.v.here.at_row(j)),
        w(in.w.here.at_row(j)),
        w_below(in.w.below.at_row(j)),
        p(in.p.at_row(j)) {}
  Pack east(int i) const { return at(own.here, i) + east_of(own.here, i); }
  Pack north(int i) const { return at(v, i) + east_of(v, i); }
  Pack up(int i) const { return at(w, i) + east_of(w, i); }
  Pack down(int i) const { return at(w_below, i) + east_of(w_below, i); }
  Pack pressure_step(int i) const { return east_of(p, i) - at(p, i); }

  RowsAround own;
  const double *v, *w, *w_below, *p;
};
struct AroundV {
  AroundV(const Constants&, const MomentumInput& in, int j)
      : own(in.v, j),
        u(in.u, j),
        w(in.w, j),
        w_below_north(in.w.below.at_row(j + 1)),
        p(in.p.at_row(j)),
        p_north(in.p.at_row(j + 1)) {}
  Pack east(int i) const { return at(u.here, i) + at(u.north, i); }
  Pack north(int i) const { return at(own.here, i) + at(own.north, i); }
  Pack up(int i) const { return at(w.here, i) + at(w.north, i); }
  Pack down(int i) const { return at(w.below, i) + at(w_below_north, i); }
  Pack pressure_step(int i) const { return at(p_north, i) - at(p, i); }

  RowsAround own, u, w;
  const double *w_below_north, *p, *p_north;
};
struct AroundW {
  AroundW(const Constants& f, const MomentumInput& in, int j)
      : own(in.w, j),
        u(in.u, j),
        v(in.v, j),
        p(in.p.at_row(j)),
        p_above(in.p_above.at_row(j)),
        low(2 * f.weight_low),
        high(2 * f.weight_high) {}
  Pack east(int i) const { return low * at(u.here, i) + high * at(u.above, i); }
  Pack north(int i) const { return low * at(v.here, i) + high * at(v.above, i); }
  Pack up(int i) const { return at(own.here, i) + at(own.above, i); }
  Pack down(int i) const { return at(own.here, i) + at(own.below, i); }
  Pack pressure_step(int i) const { return at(p_above, i) - at(p, i); }

  RowsAround own, u, v;
  const double *p, *p_above;
  double low, high;
};

struct Target {
  double *result, *history, *flux;
  const RowsAhead& ahead;  // of which each component takes its share
  std::size_t first_ahead;
};
constexpr std::size_t share_ahead = RowsAhead::most / 3;

// One component of a row, in packs of cells from i on. What passes a face is found once for both of its sides: to the
// east it is kept for the next pack, to the north for the next row. It holds the viscous stress where that is explicit.
template <ViscousMode mode, HistoryUse history, class Around>
class ComponentRow {
 public:
  using Factors = Constants::OfComponent;
  ComponentRow(const Constants& c, const Factors& f, const Around& around)
      : c_(c), f_(f), around_(around), own_(around.own) {}

  void store_north(double* flux, int nx) const {
    for (int i = 0; i < nx; i += pack_size) store_pack(north(i), flux + i);
  }
  void run(const Target& to, int nx) const {
    Pack last_east = east(-pack_size);
    const double* ahead[share_ahead];
    for (std::size_t r = 0; r < share_ahead; ++r) ahead[r] = to.ahead[to.first_ahead + r];
    const auto cells = [&](int i, int count) {
      for (const double* row : ahead) prefetch(row + i);
      const Pack old = at(own_.here, i), to_east = east(i), to_north = north(i);
      const Pack inflow =
          (one_back(last_east, to_east) - to_east) + (at(to.flux, i) - to_north) + (below(i) - above(i));
      Pack rhs = f_.push - f_.gradient * around_.pressure_step(i) + c_.dt_gamma * inflow;
      if constexpr (mode != ViscousMode::explicit_rk3) rhs += c_.dt_alpha * implicit_terms(i);
      if constexpr (history != HistoryUse::write) rhs += c_.dt_rho * at(to.history, i);
      if constexpr (mode == ViscousMode::explicit_rk3) rhs += old;
      last_east = to_east;
      store_pack(to_north, to.flux + i);
      if constexpr (history != HistoryUse::read) store_pack(inflow, to.history + i, count);
      store_pack(rhs, to.result + i, count);
    };
    const int whole = nx / pack_size * pack_size;
    for (int i = 0; i < whole; i += pack_size) cells(i, pack_size);
    if (whole < nx) cells(whole, nx - whole);
  }

 private:
  static constexpr bool stress_in_plane = mode != ViscousMode::implicit;
  static constexpr bool stress_in_z = mode == ViscousMode::explicit_rk3;

  template <bool with_stress>
  static Pack flux(double factor, Pack carrier, Pack sum, double viscosity, Pack difference) {
    const Pack momentum = factor * (carrier * sum);
    return with_stress ? momentum - viscosity * difference : momentum;
  }
  Pack east(int i) const {
    const Pack c = at(own_.here, i), e = east_of(own_.here, i);
    return flux<stress_in_plane>(c_.x, around_.east(i), e + c, c_.visc_x, e - c);
  }
  Pack north(int i) const {
    const Pack c = at(own_.here, i), n = at(own_.north, i);
    return flux<stress_in_plane>(c_.y, around_.north(i), n + c, c_.visc_y, n - c);
  }
  Pack above(int i) const {
    const Pack c = at(own_.here, i), t = at(own_.above, i);
    return flux<stress_in_z>(f_.z, around_.up(i), t + c, f_.visc_up, t - c);
  }
  Pack below(int i) const {
    const Pack c = at(own_.here, i), b = at(own_.below, i);
    return flux<stress_in_z>(f_.z, around_.down(i), c + b, f_.visc_down, c - b);
  }
  Pack implicit_terms(int i) const {
    const Pack c = at(own_.here, i);
    const Pack z = f_.visc_up * (at(own_.above, i) - c) - f_.visc_down * (c - at(own_.below, i));
    if (stress_in_plane) return z;
    return z + c_.visc_x * (east_of(own_.here, i) - 2 * c + west_of(own_.here, i)) +
           c_.visc_y * (at(own_.north, i) - 2 * c + at(own_.south, i));
  }

  Constants c_;
  Factors f_;
  Around around_;
  RowsAround own_;
};

template <class Row, class Around>
[[gnu::always_inline]] inline void component_row(const Constants& c, const Constants::OfComponent& f,
                                                 const MomentumInput& in, const Target& to, int nx, int j) {
  // The southern faces of the first row have no row before them.
  if (j == 0) Row(c, f, Around(c, in, -1)).store_north(to.flux, nx);
  Row(c, f, Around(c, in, j)).run(to, nx);
}

// Flattened: every call within is a few instructions of a loop over cells.
template <ViscousMode mode, HistoryUse history>
[[gnu::flatten]] void all_rows(const Constants& c, const MomentumInput& in, const MomentumOutput& out,
                               const FluxRows::Rows& fluxes, const RowsAhead& ahead, int nx, int j) {
  component_row<ComponentRow<mode, history, AroundU>, AroundU>(
      c, c.u, in, {out.u.at_row(j), out.history_u.at_row(j), fluxes.u, ahead, 0}, nx, j);
  component_row<ComponentRow<mode, history, AroundV>, AroundV>(
      c, c.v, in, {out.v.at_row(j), out.history_v.at_row(j), fluxes.v, ahead, share_ahead}, nx, j);
  component_row<ComponentRow<mode, history, AroundW>, AroundW>(
      c, c.w, in, {out.w.at_row(j), out.history_w.at_row(j), fluxes.w, ahead, 2 * share_ahead}, nx, j);
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
  f.visc_x = nu / (grid.dx() * grid.dx());
  f.visc_y = nu / (grid.dy() * grid.dy());
  f.weight_low = dz_c[k] / span;
  f.weight_high = dz_c[k + 1] / span;
  const Vec3 push = m.dt_alpha * m.acceleration;
  const double z = 0.25 / dz_c[k], up = nu / (dz_c[k] * dz_f[k]), down = nu / (dz_c[k] * dz_f[k - 1]);
  f.u = {z, up, down, m.dt_alpha / grid.dx(), push.x};
  f.v = {z, up, down, m.dt_alpha / grid.dy(), push.y};
  f.w = {0.25 / dz_f[k], nu / (dz_f[k] * dz_c[k + 1]), nu / (dz_f[k] * dz_c[k]), m.dt_alpha / dz_f[k], push.z};
  return f;
}

}  // namespace

MomentumRows::MomentumRows(const Grid& grid, ViscousMode mode, HistoryUse history, const MomentumFactors& factors,
                           const MomentumInput& in, const MomentumOutput& out, FluxRows& fluxes, int k)
    : constants_(constants_of(grid, factors, k)),
      in_(in),
      out_(out),
      fluxes_(fluxes.rows()),
      nx_(grid.nx()),
      row_(row_of(mode, history)) {}

FluxRows::FluxRows(const Grid& grid)
    : row_(PlaneLayout(grid).row), memory_(allocate_aligned(3 * static_cast<std::size_t>(row_))) {}

}  // namespace pliant
