#include "flow/flow_solver.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

#include "flow/flow_parts.hpp"
#include "flow/flow_record.hpp"
#include "flow/fused_sweeps.hpp"
#include "flow/plain_sweeps.hpp"

namespace pliant {
namespace {

constexpr std::array<double, 3> rk_gamma{largest_alpha, 5.0 / 12, 3.0 / 4};
constexpr std::array<double, 3> rk_rho{0, -17.0 / 60, -5.0 / 12};
// The real axis is stable up to here for this Runge-Kutta scheme.
constexpr double real_axis_limit = 2.5127;

std::unique_ptr<FlowSweeps> make_sweeps(FlowParts& parts) {
  const auto& grid = parts.grid;
  const auto sweeps = sweeps_in_use(parts.parameters.sweeps, grid.cells()[2], grid.is_periodic(2), grid.ranks().size());
  if (sweeps == Sweeps::fused) return std::make_unique<FusedSweeps>(parts);
  return std::make_unique<PlainSweeps>(parts);
}

constexpr double unknown = -1;

}  // namespace

struct FlowSolver::Impl : FlowParts {
  Impl(const Grid& g, const FlowParameters& p) : FlowParts(g, p), sweeps(make_sweeps(*this)) {}

  Substep substep(int l) const {
    const auto at = static_cast<std::size_t>(l);
    return {l, rk_gamma[at], rk_rho[at], rk_gamma[at] + rk_rho[at]};
  }

  VelocityViews velocity() { return {state.u.view(), state.v.view(), state.w.view()}; }
  void predict(const Substep& s, double dt, bool wanted_by_hook, NodalForces* forces);
  void hold_bulk_velocity();
  // The state has changed by other means than a step.
  void forget_rate() { rate = unknown; }
  FlowRecord record() { return {grid, state, open, time, forcing_of_step, rate}; }

  std::unique_ptr<FlowSweeps> sweeps;
  double forcing_of_step = 0;
  double time = 0;
  double rate = unknown;  // convective, of the velocity predicted last; over all ranks
};

void FlowSolver::Impl::predict(const Substep& s, double dt, bool wanted_by_hook, NodalForces* forces) {
  const MomentumFactors factors{dt * s.gamma, dt * s.rho, dt * s.alpha, parameters.viscosity,
                                parameters.forcing.acceleration};
  sweeps->predict(s, factors, dt, forces);
  const bool wants_all = wanted_by_hook || parameters.forcing.bulk_velocity;
  if (wants_all || !may_finish_late()) finish_viscous(sweeps->predicted());
  if (parameters.forcing.bulk_velocity) hold_bulk_velocity();
}

// Adds the uniform acceleration that returns the predicted velocity to the prescribed mean.
void FlowSolver::Impl::hold_bulk_velocity() {
  const auto scope = timer.measure("bulk forcing");
  const auto& target = *parameters.forcing.bulk_velocity;
  const auto shift = [&](auto field, const FieldRules& r) {
    const double missing = target.value - grid.ranks().sum(integral(grid, field)) / grid.volume();
    for (int k = 0; k < grid.nz(); ++k) {
      for (int j = 0; j < grid.ny(); ++j) {
        double* row = field.at_row(j, k);
        for_each(grid.nx(), [=](int i) { row[i] += missing; });
      }
      fill_plane_ghosts(field, r, grid.nx(), grid.ny(), k);
    }
    forcing_of_step += missing;
  };
  const auto predicted = sweeps->predicted();
  if (target.axis == Axis::x) shift(predicted.u.view(), rules[0]);
  else if (target.axis == Axis::y) shift(predicted.v.view(), rules[1]);
  else shift(predicted.w.view(), rules[2]);
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
void FlowSolver::settle() const { impl_->sweeps->settle(); }
FlowState& FlowSolver::state() {
  settle();
  return impl_->state;
}
const FlowState& FlowSolver::state() const {
  settle();
  return impl_->state;
}
PhaseTimer& FlowSolver::timer() { return impl_->timer; }
double FlowSolver::time() const { return impl_->time; }
void FlowSolver::set_time(double time) { impl_->time = time; }
bool FlowSolver::has_open_sides() const { return impl_->open.any(); }
double FlowSolver::net_outward_flux() const { return impl_->open.net_outward_flux(); }
std::vector<PatchFlowRate> FlowSolver::patch_flow_rates() const { return impl_->open.patch_flow_rates(); }
double FlowSolver::largest_side_rate(double end) const { return impl_->open.largest_rate(end); }
double FlowSolver::bulk_forcing() const { return impl_->forcing_of_step; }
void FlowSolver::fill_ghosts() {
  settle();
  impl_->fill_state_ghosts();
  impl_->forget_rate();
}

void FlowSolver::save_state(Snapshot& snapshot) const {
  settle();
  impl_->record().save(snapshot);
}
void FlowSolver::restore_state(const Snapshot& snapshot) {
  impl_->sweeps->discard();
  impl_->record().restore(snapshot);
}
std::vector<RowTable> FlowSolver::state_tables() const { return impl_->record().tables(); }
void FlowSolver::save_table(std::size_t t, std::span<double> values) const {
  settle();
  impl_->record().save_table(t, values);
}
void FlowSolver::load_table(std::size_t t, std::span<const double> values) {
  impl_->sweeps->discard();
  impl_->record().load_table(t, values);
}
std::vector<std::byte> FlowSolver::state_numbers() const { return impl_->record().numbers(); }
void FlowSolver::finish_loading(std::span<const std::byte> numbers) {
  impl_->record().finish_loading(numbers);
  impl_->fill_state_ghosts();
}

void FlowSolver::project_initial() {
  auto& m = *impl_;
  settle();
  m.open.start(m.velocity(), m.time);
  m.fill_state_ghosts();
  // The pressure of an initial field is not known: the increment of this projection must not count as one.
  Field<Center> pressure(m.grid);
  pressure.swap(m.state.p);
  m.sweeps->adopt_state();
  m.sweeps->project({1.0, 0.0}, false);
  settle();
  pressure.swap(m.state.p);
  m.fill_state_ghosts();
  m.forget_rate();
}

void FlowSolver::find_potential(ConstView<FaceX> u, ConstView<FaceY> v, ConstView<FaceZ> w, View<Center> potential) {
  settle();
  auto& m = *impl_;
  const auto phi = m.phi.view();
  for (int k = 0; k < m.grid.nz(); ++k) for_rows(m.grid.ny(), DivergenceRows(m.grid, u, v, w, 1, phi.at_plane(k), k));
  m.poisson.solve(phi);
  for (int k = 0; k < m.grid.nz(); ++k)
    for (int j = 0; j < m.grid.ny(); ++j) std::copy_n(phi.at_row(j, k), m.grid.nx(), potential.at_row(j, k));
}

void FlowSolver::advance(double dt, const FlowHooks& hooks) {
  auto& m = *impl_;
  m.forcing_of_step = 0;
  double elapsed = 0, rate = 0;
  for (int l = 0; l < 3; ++l) {
    const Substep s = m.substep(l);
    elapsed += s.alpha * dt;
    if (m.open.any()) {
      settle();  // what flows out depends on the corrected velocity at the sides
      m.open.advance(m.velocity(), m.time + elapsed, s.alpha * dt);
    }
    if (hooks.before) hooks.before(s, dt);
    m.predict(s, dt, hooks.predicted != nullptr, hooks.forces);
    const auto predicted = m.sweeps->predicted();
    m.fill_predicted_ends(predicted, hooks.predicted ? GhostPlanes::both : m.sweeps->wanted_ends());
    if (hooks.predicted) {
      hooks.predicted(s, dt, predicted.u.view(), predicted.v.view(), predicted.w.view());
      for (int k = 0; k < m.grid.nz(); ++k) m.fill_plane(predicted, k);
      m.fill_predicted_ends(predicted, m.sweeps->wanted_ends());
    }
    rate = m.sweeps->project({s.alpha * dt, 0.5 * s.alpha * dt * m.parameters.viscosity}, l == 2);
    if (hooks.corrected) {
      settle();
      hooks.corrected(s, dt);
    }
  }
  m.rate = m.grid.ranks().max(rate);
  m.forcing_of_step /= dt;
  m.time += dt;
}

bool FlowSolver::may_be_finite() const {
  // The projection is global: what is not a number in one cell is in every mode of its plane, and so in all planes
  // that are eliminated after it.
  const auto& m = *impl_;
  double sum = m.phi.view()(0, 0, m.grid.nz() - 1);
  const auto add = [&](const auto& field) { sum += field.view()(0, 0, 0); };
  add(m.state.u);
  add(m.state.v);
  add(m.state.w);
  add(m.state.p);
  return std::isfinite(sum);
}

double FlowSolver::step_rate() const {
  auto& m = *impl_;
  if (m.rate < 0) m.rate = convective_rate();
  return m.rate;
}

double FlowSolver::convective_rate() const {
  settle();
  const auto& m = *impl_;
  return m.grid.ranks().max(pliant::convective_rate(m.grid, m.state.u.view(), m.state.v.view(), m.state.w.view()));
}

double FlowSolver::viscous_step_limit() const {
  return pliant::viscous_step_limit(impl_->grid, impl_->parameters.viscosity, impl_->parameters.viscous);
}

double FlowSolver::largest_divergence() const {
  settle();
  const auto& m = *impl_;
  return m.grid.ranks().max(pliant::largest_divergence(m.grid, m.state.u.view(), m.state.v.view(), m.state.w.view()));
}

double FlowSolver::kinetic_energy() const {
  settle();
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
  settle();
  const auto& m = *impl_;
  std::array<double, 3> sums{integral(m.grid, m.state.u.view()), integral(m.grid, m.state.v.view()),
                             integral(m.grid, m.state.w.view())};
  m.grid.ranks().sum(sums);
  return Vec3{sums[0], sums[1], sums[2]} / m.grid.volume();
}

std::size_t FlowSolver::bytes() const { return impl_->FlowParts::bytes() + impl_->sweeps->bytes(); }

Sweeps sweeps_in_use(Sweeps wanted, int planes_in_z, bool is_periodic_in_z, int ranks) {
  const bool coupled = is_periodic_in_z || ranks > 1;
  const bool served = !coupled || planes_in_z / ranks >= PoissonPlanes::least_planes;
  return wanted == Sweeps::fused && served ? Sweeps::fused : Sweeps::plain;
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
