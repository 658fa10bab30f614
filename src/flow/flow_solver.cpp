#include "flow/flow_solver.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

#include "boundary/fill_ghosts.hpp"
#include "boundary/open_sides.hpp"
#include "flow/flow_record.hpp"
#include "flow/helmholtz_adi.hpp"
#include "flow/momentum.hpp"
#include "flow/projection.hpp"
#include "solvers/poisson_solver.hpp"

namespace pliant {
namespace {

constexpr std::array<double, 3> rk_gamma{8.0 / 15, 5.0 / 12, 3.0 / 4};
constexpr std::array<double, 3> rk_rho{0, -17.0 / 60, -5.0 / 12};
// The real axis is stable up to here for this Runge-Kutta scheme.
constexpr double real_axis_limit = 2.5127;

HelmholtzAdi::Directions directions_of(ViscousMode mode) {
  return mode == ViscousMode::implicit ? HelmholtzAdi::Directions::all : HelmholtzAdi::Directions::z;
}

SlabHalo::Ends halo_ends(const Grid& grid) {
  return grid.is_periodic(2) ? SlabHalo::Ends::periodic : SlabHalo::Ends::bounded;
}

}  // namespace

struct FlowSolver::Impl {
  Impl(const Grid& g, const FlowParameters& p)
      : grid(g),
        parameters(p),
        state(g),
        u_next(g),
        v_next(g),
        w_next(g),
        history_u(g),
        history_v(g),
        history_w(g),
        phi(g),
        rules{velocity_rules(p.boundary, 0), velocity_rules(p.boundary, 1), velocity_rules(p.boundary, 2)},
        rules_p(pressure_rules(p.boundary)),
        open(g, p.boundary, p.signals),
        halo(g.ranks(), halo_ends(g), g.nz()),
        poisson(g, phi) {
    for (int c = 0; c < 3; ++c) open.lend_values(rules[static_cast<std::size_t>(c)], c);
    if (p.viscous == ViscousMode::explicit_rk3) return;
    // One set of factors for each substep and component, kept while the time step stays.
    for (int l = 0; l < 3; ++l)
      for (int c = 0; c < 3; ++c)
        adi.emplace_back(g, rules[static_cast<std::size_t>(c)], c, directions_of(p.viscous), phi.row());
  }

  Substep substep(int l) const {
    const auto at = static_cast<std::size_t>(l);
    return {l, rk_gamma[at], rk_rho[at], rk_gamma[at] + rk_rho[at]};
  }

  VelocityViews velocity() { return {state.u.view(), state.v.view(), state.w.view()}; }
  MomentumInput momentum_input() { return {state.u.view(), state.v.view(), state.w.view(), state.p.view()}; }
  MomentumOutput momentum_output() {
    return {u_next.view(), v_next.view(), w_next.view(), history_u.view(), history_v.view(), history_w.view()};
  }
  void predict(const Substep& s, double dt);
  void predict_explicit(const MomentumFactors& factors, HistoryUse use);
  void predict_implicit(const Substep& s, const MomentumFactors& factors, HistoryUse use, double dt);
  void hold_bulk_velocity();
  void fill_predicted_ghosts(GhostPlanes which);
  void project(double dt_alpha, double lap_weight);
  void fill_state_ghosts();
  void fill_velocity_end_planes();
  FlowRecord record() { return {grid, state, open, time, forcing_of_step}; }

  template <class Location>
  void fill_in_plane(Field<Location>& f, const FieldRules& r, int k) {
    fill_plane_ghosts(f.view(), r, grid.nx(), grid.ny(), k);
  }

  Grid grid;
  FlowParameters parameters;
  FlowState state;
  Field<FaceX> u_next;  // the predicted velocity; changes places with the state when it is corrected
  Field<FaceY> v_next;
  Field<FaceZ> w_next;
  Field<FaceX> history_u;  // explicit terms of the last substep
  Field<FaceY> history_v;
  Field<FaceZ> history_w;
  Field<Center> phi;
  std::array<FieldRules, 3> rules;
  FieldRules rules_p;
  OpenSides open;
  SlabHalo halo;
  PoissonSolver poisson;
  std::vector<HelmholtzAdi> adi;  // [substep][component]
  PhaseTimer timer;
  double forcing_of_step = 0;
  double time = 0;
};

void FlowSolver::Impl::predict(const Substep& s, double dt) {
  const MomentumFactors factors{dt * s.gamma, dt * s.rho, dt * s.alpha, parameters.viscosity,
                                parameters.forcing.acceleration};
  const HistoryUse use = s.index == 0 ? HistoryUse::write : s.index == 1 ? HistoryUse::read_write : HistoryUse::read;
  if (parameters.viscous == ViscousMode::explicit_rk3) predict_explicit(factors, use);
  else predict_implicit(s, factors, use, dt);
  if (parameters.forcing.bulk_velocity) hold_bulk_velocity();
}

void FlowSolver::Impl::predict_explicit(const MomentumFactors& factors, HistoryUse use) {
  const auto scope = timer.measure("momentum");
  const MomentumInput in = momentum_input();
  const MomentumOutput out = momentum_output();
  for (int k = 0; k < grid.nz(); ++k) {
    momentum_plane(grid, parameters.viscous, use, factors, in, out, k);
    fill_in_plane(u_next, rules[0], k);
    fill_in_plane(v_next, rules[1], k);
    fill_in_plane(w_next, rules[2], k);
  }
}

void FlowSolver::Impl::predict_implicit(const Substep& s, const MomentumFactors& factors, HistoryUse use, double dt) {
  const MomentumInput in = momentum_input();
  const MomentumOutput out = momentum_output();
  HelmholtzAdi* solve = &adi[static_cast<std::size_t>(3 * s.index)];
  for (int c = 0; c < 3; ++c) {
    solve[c].set_coefficient(0.5 * s.alpha * dt * parameters.viscosity);
    if (open.any()) solve[c].set_side_changes(open.changes(c));
  }
  const auto u = u_next.view();
  const auto v = v_next.view();
  const auto w = w_next.view();
  for (int k = 0; k < grid.nz(); ++k) {
    {
      const auto scope = timer.measure("momentum");
      momentum_plane(grid, parameters.viscous, use, factors, in, out, k);
    }
    const auto scope = timer.measure("viscous solves");
    solve[0].begin_plane(u.at_row(0, k), u.at_row(0, k - 1), k);
    solve[1].begin_plane(v.at_row(0, k), v.at_row(0, k - 1), k);
    solve[2].begin_plane(w.at_row(0, k), w.at_row(0, k - 1), k);
  }
  {
    const auto scope = timer.measure("viscous coupling of slabs");
    for (int c = 0; c < 3; ++c) solve[c].couple();
  }
  const auto scope = timer.measure("viscous solves");
  // A plane of increments is wanted by the one below it, so the old velocity is added one plane later.
  const auto finish = [&](int k) {
    add_plane(u_next.view(), state.u.view(), grid, k);
    add_plane(v_next.view(), state.v.view(), grid, k);
    add_plane(w_next.view(), state.w.view(), grid, k);
    fill_in_plane(u_next, rules[0], k);
    fill_in_plane(v_next, rules[1], k);
    fill_in_plane(w_next, rules[2], k);
  };
  for (int k = grid.nz() - 1; k >= 0; --k) {
    solve[0].finish_plane(u.at_row(0, k), u.at_row(0, k + 1), k);
    solve[1].finish_plane(v.at_row(0, k), v.at_row(0, k + 1), k);
    solve[2].finish_plane(w.at_row(0, k), w.at_row(0, k + 1), k);
    if (k < grid.nz() - 1) finish(k + 1);
  }
  finish(0);
}

// Adds the uniform acceleration that returns the predicted velocity to the prescribed mean.
void FlowSolver::Impl::hold_bulk_velocity() {
  const auto scope = timer.measure("bulk forcing");
  const auto& target = *parameters.forcing.bulk_velocity;
  const auto shift = [&](auto field, const FieldRules& r) {
    const double missing = target.value - grid.ranks().sum(integral(grid, field)) / grid.volume();
    for (int k = 0; k < grid.nz(); ++k) {
      for (int j = 0; j < grid.ny(); ++j)
        for (int i = 0; i < grid.nx(); ++i) field(i, j, k) += missing;
      fill_plane_ghosts(field, r, grid.nx(), grid.ny(), k);
    }
    forcing_of_step += missing;
  };
  if (target.axis == Axis::x) shift(u_next.view(), rules[0]);
  else if (target.axis == Axis::y) shift(v_next.view(), rules[1]);
  else shift(w_next.view(), rules[2]);
}

void FlowSolver::Impl::fill_predicted_ghosts(GhostPlanes which) {
  const auto scope = timer.measure("halo");
  // The face plane on the upper side is set before neighbours or the divergence see it.
  fill_end_planes(w_next.view(), rules[2], grid);
  if (which == GhostPlanes::both) {
    halo.fill({plane_stack(u_next), plane_stack(v_next), plane_stack(w_next)});
    fill_end_planes(u_next.view(), rules[0], grid);
    fill_end_planes(v_next.view(), rules[1], grid);
  } else {
    halo.fill({plane_stack(w_next)}, which);
  }
}

void FlowSolver::Impl::project(double dt_alpha, double lap_weight) {
  {
    const auto scope = timer.measure("poisson");
    const double scale = poisson.rhs_scale() / dt_alpha;
    poisson.solve(
        phi.view(),
        [&](int k) { divergence_plane(grid, u_next.view(), v_next.view(), w_next.view(), scale, phi.view(), k); },
        [&](int k) { fill_in_plane(phi, rules_p, k); });
  }
  {
    const auto scope = timer.measure("halo");
    halo.fill({plane_stack(phi)});
    fill_end_planes(phi.view(), rules_p, grid);
  }
  {
    const auto scope = timer.measure("correction");
    const CorrectionTerms terms = parameters.viscous == ViscousMode::explicit_rk3 ? CorrectionTerms::none
                                  : parameters.viscous == ViscousMode::implicit_z ? CorrectionTerms::z
                                                                                  : CorrectionTerms::all;
    for (int k = 0; k < grid.nz(); ++k) {
      correct_plane(grid, terms, dt_alpha, lap_weight, phi.view(),
                    {u_next.view(), v_next.view(), w_next.view(), state.p.view()}, k);
      fill_in_plane(u_next, rules[0], k);
      fill_in_plane(v_next, rules[1], k);
      fill_in_plane(w_next, rules[2], k);
      fill_in_plane(state.p, rules_p, k);
    }
  }
  state.u.swap(u_next);
  state.v.swap(v_next);
  state.w.swap(w_next);
  const auto scope = timer.measure("halo");
  fill_velocity_end_planes();
}

void FlowSolver::Impl::fill_velocity_end_planes() {
  // The normal face of the top must be in place before it travels as a periodic or neighbouring ghost; then the ends.
  fill_end_planes(state.w.view(), rules[2], grid);
  halo.fill({plane_stack(state.u), plane_stack(state.v), plane_stack(state.w), plane_stack(state.p)});
  fill_end_planes(state.u.view(), rules[0], grid);
  fill_end_planes(state.v.view(), rules[1], grid);
  fill_end_planes(state.w.view(), rules[2], grid);
  fill_end_planes(state.p.view(), rules_p, grid);
}

void FlowSolver::Impl::fill_state_ghosts() {
  for (int k = 0; k < grid.nz(); ++k) {
    fill_in_plane(state.u, rules[0], k);
    fill_in_plane(state.v, rules[1], k);
    fill_in_plane(state.w, rules[2], k);
    fill_in_plane(state.p, rules_p, k);
  }
  fill_velocity_end_planes();
}

FlowSolver::FlowSolver(const Grid& grid, const FlowParameters& parameters)
    : impl_(std::make_unique<Impl>(grid, parameters)) {
  impl_->open.start(impl_->velocity(), 0);
  fill_ghosts();
}
FlowSolver::~FlowSolver() = default;
FlowSolver::FlowSolver(FlowSolver&&) noexcept = default;

const Grid& FlowSolver::grid() const { return impl_->grid; }
const FlowParameters& FlowSolver::parameters() const { return impl_->parameters; }
FlowState& FlowSolver::state() { return impl_->state; }
const FlowState& FlowSolver::state() const { return impl_->state; }
PhaseTimer& FlowSolver::timer() { return impl_->timer; }
double FlowSolver::time() const { return impl_->time; }
void FlowSolver::set_time(double time) { impl_->time = time; }
bool FlowSolver::has_open_sides() const { return impl_->open.any(); }
double FlowSolver::net_outward_flux() const { return impl_->open.net_outward_flux(); }
std::vector<PatchFlowRate> FlowSolver::patch_flow_rates() const { return impl_->open.patch_flow_rates(); }
double FlowSolver::largest_side_rate(double end) const { return impl_->open.largest_rate(end); }
double FlowSolver::bulk_forcing() const { return impl_->forcing_of_step; }
void FlowSolver::fill_ghosts() { impl_->fill_state_ghosts(); }

void FlowSolver::save_state(Snapshot& snapshot) const { impl_->record().save(snapshot); }
void FlowSolver::restore_state(const Snapshot& snapshot) { impl_->record().restore(snapshot); }
std::vector<RowTable> FlowSolver::state_tables() const { return impl_->record().tables(); }
void FlowSolver::save_table(std::size_t t, std::span<double> values) const { impl_->record().save_table(t, values); }
void FlowSolver::load_table(std::size_t t, std::span<const double> values) { impl_->record().load_table(t, values); }
std::vector<std::byte> FlowSolver::state_numbers() const { return impl_->record().numbers(); }
void FlowSolver::finish_loading(std::span<const std::byte> numbers) {
  impl_->record().finish_loading(numbers);
  impl_->fill_state_ghosts();
}

void FlowSolver::project_initial() {
  auto& m = *impl_;
  m.open.start(m.velocity(), m.time);
  m.fill_state_ghosts();
  m.u_next.swap(m.state.u);
  m.v_next.swap(m.state.v);
  m.w_next.swap(m.state.w);
  // The pressure of an initial field is not known: the increment of this projection must not count as one.
  Field<Center> pressure(m.grid);
  pressure.swap(m.state.p);
  m.project(1.0, 0.0);
  pressure.swap(m.state.p);
  m.fill_state_ghosts();
}

void FlowSolver::advance(double dt, const PredictedFlowHook& hook) {
  auto& m = *impl_;
  m.forcing_of_step = 0;
  double elapsed = 0;
  for (int l = 0; l < 3; ++l) {
    const Substep s = m.substep(l);
    elapsed += s.alpha * dt;
    if (m.open.any()) m.open.advance(m.velocity(), m.time + elapsed, s.alpha * dt);
    m.predict(s, dt);
    m.fill_predicted_ghosts(hook ? GhostPlanes::both : GhostPlanes::lower);
    if (hook) {
      hook(s, dt, m.u_next.view(), m.v_next.view(), m.w_next.view());
      for (int k = 0; k < m.grid.nz(); ++k) {
        m.fill_in_plane(m.u_next, m.rules[0], k);
        m.fill_in_plane(m.v_next, m.rules[1], k);
        m.fill_in_plane(m.w_next, m.rules[2], k);
      }
      m.fill_predicted_ghosts(GhostPlanes::lower);
    }
    m.project(s.alpha * dt, 0.5 * s.alpha * dt * m.parameters.viscosity);
  }
  m.forcing_of_step /= dt;
  m.time += dt;
}

double FlowSolver::convective_rate() const {
  const auto& m = *impl_;
  return m.grid.ranks().max(pliant::convective_rate(m.grid, m.state.u.view(), m.state.v.view(), m.state.w.view()));
}

double FlowSolver::viscous_step_limit() const {
  return pliant::viscous_step_limit(impl_->grid, impl_->parameters.viscosity, impl_->parameters.viscous);
}

double FlowSolver::largest_divergence() const {
  const auto& m = *impl_;
  return m.grid.ranks().max(pliant::largest_divergence(m.grid, m.state.u.view(), m.state.v.view(), m.state.w.view()));
}

double FlowSolver::kinetic_energy() const {
  const auto& m = *impl_;
  const auto dz_c = m.grid.dz_c(), dz_f = m.grid.dz_f();
  const auto u = m.state.u.view();
  const auto v = m.state.v.view();
  const auto w = m.state.w.view();
  double sum = 0;
  for (int k = 0; k < m.grid.nz(); ++k) {
    double cells = 0, faces = 0;
    for (int j = 0; j < m.grid.ny(); ++j)
      for (int i = 0; i < m.grid.nx(); ++i) {
        cells += u(i, j, k) * u(i, j, k) + v(i, j, k) * v(i, j, k);
        faces += w(i, j, k) * w(i, j, k);
      }
    sum += cells * dz_c[k] + faces * dz_f[k];
  }
  const double total = m.grid.ranks().sum(sum) * m.grid.dx() * m.grid.dy();
  return 0.5 * m.parameters.density * total / m.grid.volume();
}

Vec3 FlowSolver::bulk_velocity() const {
  const auto& m = *impl_;
  std::array<double, 3> sums{integral(m.grid, m.state.u.view()), integral(m.grid, m.state.v.view()),
                             integral(m.grid, m.state.w.view())};
  m.grid.ranks().sum(sums);
  return Vec3{sums[0], sums[1], sums[2]} / m.grid.volume();
}

std::size_t FlowSolver::bytes() const {
  const auto& m = *impl_;
  std::size_t bytes = 11 * m.phi.bytes() + m.poisson.bytes();
  for (const auto& solve : m.adi) bytes += solve.bytes();
  return bytes;
}

double viscous_step_limit(const Grid& grid, double kinematic_viscosity, ViscousMode mode) {
  const double dz = grid.smallest_dz();
  const double xy = 4 / (grid.dx() * grid.dx()) + 4 / (grid.dy() * grid.dy());
  const double rate = kinematic_viscosity * (mode == ViscousMode::explicit_rk3 ? xy + 4 / (dz * dz)
                                             : mode == ViscousMode::implicit_z ? xy
                                                                               : 0.0);
  return rate > 0 ? real_axis_limit / rate : std::numeric_limits<double>::infinity();
}

}  // namespace pliant
