#pragma once
#include <cstddef>
#include <functional>
#include <memory>
#include <span>
#include <vector>

#include "boundary/open_sides.hpp"
#include "config/case_config.hpp"
#include "core/timer.hpp"
#include "field/field.hpp"
#include "field/row_table.hpp"
#include "signals/signal.hpp"

namespace pliant {

/// The fluid's unknowns. Ghosts are filled at every moment that a caller can see.
struct FlowState {
  explicit FlowState(const Grid& grid) : u(grid), v(grid), w(grid), p(grid) {}
  Field<FaceX> u;
  Field<FaceY> v;
  Field<FaceZ> w;
  Field<Center> p;  ///< pressure over density
};

/// What FlowSolver::save_state keeps: four fields with their ghosts, and what open sides remember.
struct FlowSnapshot {
  std::vector<double> u, v, w, p;
  OpenSides::Snapshot open;
  double time = 0, forcing = 0, rate = 0;
};

/// The coefficients of one Runge-Kutta substep (numerics.md, section 1).
struct Substep {
  int index;
  double gamma, rho, alpha;
};

/// The alpha of the longest substep, the first.
inline constexpr double largest_alpha = 8.0 / 15;

/// Called between the prediction and the projection of a substep: the place of the immersed boundary, which changes the
/// predicted velocity.
using PredictedFlowHook = std::function<void(const Substep&, double dt, View<FaceX>, View<FaceY>, View<FaceZ>)>;

/// Forces at nodes that enter the right-hand sides of the predicted velocity, before the viscous solves.
class NodalForces {
 public:
  virtual ~NodalForces() = default;
  /// Adds `factor` times the force per unit mass to row j of plane k of u, v and w, and forgets it: every row of the
  /// slab is asked for once a substep.
  virtual void take_row(double factor, double* u, double* v, double* w, int j, int k) = 0;
};

/// Those who act on the flow within a step.
struct FlowHooks {
  PredictedFlowHook predicted;                               ///< between prediction and projection
  std::function<void(const Substep&, double dt)> before;     ///< a substep begins
  std::function<void(const Substep&, double dt)> corrected;  ///< it ends: state() is the flow at its end
  NodalForces* forces = nullptr;                             ///< set by `before`
};

/// What the flow solver needs to know of a case.
struct FlowParameters {
  double density = 1.0;
  double viscosity = 1.0;  ///< kinematic
  ViscousMode viscous = ViscousMode::implicit;
  Sweeps sweeps = Sweeps::fused;
  BoundaryConfig boundary;
  Signals signals;  ///< those that the boundary names
  ForcingConfig forcing;
};

/// Advances the incompressible Navier-Stokes equations in time: three-substep Runge-Kutta, staggered second-order
/// differences, direct projection.
class FlowSolver {
 public:
  /// Collective. Allocates everything a step needs.
  FlowSolver(const Grid& grid, const FlowParameters& parameters);
  ~FlowSolver();
  FlowSolver(FlowSolver&&) noexcept;

  const Grid& grid() const;
  const FlowParameters& parameters() const;
  /// The state, settled: collective after a step.
  FlowState& state();
  const FlowState& state() const;
  /// A step leaves the last correction of the velocity and the pressure to the step after it, which makes it on its
  /// way. This makes it now, for those who look at the fields of the state in between by themselves; all functions that
  /// look at them do. Does not change what the run computes. Collective.
  void settle() const;

  /// Fills the ghosts of the state, after a caller has changed its interior (an initial field, a restart).
  void fill_ghosts();
  /// Makes the velocity of the state solenoidal (used once, after an initial field that is not). Open sides take their
  /// values from the field next to them and from the time.
  void project_initial();
  /// phi with lap phi = div of a velocity whose ghosts are filled and which is zero at the sides of the box: in the
  /// interior, up to a constant. Settles. Collective.
  void find_potential(ConstView<FaceX> u, ConstView<FaceY> v, ConstView<FaceZ> w, View<Center> potential);

  /// Time of the state; inflows with a ramp depend on it. Every step adds to it.
  double time() const;
  void set_time(double time);
  /// True if fluid passes a side of the box.
  bool has_open_sides() const;
  /// Net flux out of the box through its open sides. Collective.
  double net_outward_flux() const;
  /// What flows into the box through the patches of its sides now, in the order of the case. Collective.
  std::vector<PatchFlowRate> patch_flow_rates() const;
  /// The largest convective rate that patches and inflows with a signal ask for until `end`; 0 if there are none.
  double largest_side_rate(double end) const;

  /// One full step. Collective. Leaves the divergence at round-off and all ghosts filled.
  void advance(double dt, const PredictedFlowHook& hook = nullptr) { advance(dt, FlowHooks{hook, {}, {}, nullptr}); }
  /// With hooks.corrected every substep is settled, which costs a pass more.
  void advance(double dt, const FlowHooks& hooks);

  /// max over cells of |u|/dx + |v|/dy + |w|/dz: the Courant number is dt times this. Collective.
  double convective_rate() const;
  /// The same for choosing the next step: of the velocity that the last step predicted, before its last correction, so
  /// that nothing has to be settled; of the state if there was no step. Collective.
  double step_rate() const;
  /// False if this rank sees that the flow is not finite; some rank does after a step. Not collective.
  bool may_be_finite() const;
  /// Largest step of the explicitly treated viscous terms; infinity if there are none.
  double viscous_step_limit() const;
  /// Largest absolute divergence over the cells. Collective.
  double largest_divergence() const;
  /// Kinetic energy per unit volume of the box, density included. Collective.
  double kinetic_energy() const;
  /// Mean velocity of the box. Collective.
  Vec3 bulk_velocity() const;
  /// The acceleration that the constant-mass-flux forcing applied in the last step; 0 if there is none.
  double bulk_forcing() const;

  /// All that a step needs of the steps before it, in memory: fields with their ghosts, open sides, time, forcing.
  using Snapshot = FlowSnapshot;
  /// A snapshot may be used again and again; only the first time allocates. Collective.
  void save_state(Snapshot& snapshot) const;
  /// Takes this solver back, bit for bit, to where it was when the snapshot was made. Not collective.
  void restore_state(const Snapshot& snapshot);

  /// The same for a file that any number of ranks may read: tables that are shared out by rows, and a few numbers that
  /// are the same on all ranks.
  std::vector<RowTable> state_tables() const;
  /// Copies table `t` of state_tables(), this rank's rows of it, out of the state or into it.
  void save_table(std::size_t t, std::span<double> values) const;
  void load_table(std::size_t t, std::span<const double> values);
  std::vector<std::byte> state_numbers() const;
  /// After all tables are loaded: takes the numbers, as state_numbers() gave them, and fills the ghosts. Collective.
  /// Throws ByteStreamError if they are of another kind of flow.
  void finish_loading(std::span<const std::byte> numbers);

  PhaseTimer& timer();
  std::size_t bytes() const;  ///< of this rank's arrays and tables

 private:
  struct Impl;
  std::unique_ptr<Impl> impl_;
};

/// The Courant number up to which the scheme is stable on its own, for checks of the input: sqrt(3).
inline constexpr double largest_stable_cfl = 1.7320508;

/// Sets the state of a solver to an initial flow, ghosts included. Collective. `wall` velocities give Couette its
/// profile.
void set_initial_flow(FlowSolver& solver, const InitialConfig& initial);

/// Those that a flow uses when it is asked for `wanted`: where slabs hang together, fused sweeps need two planes each.
Sweeps sweeps_in_use(Sweeps wanted, int planes_in_z, bool is_periodic_in_z, int ranks);

/// The time-step limit of the explicitly treated viscous terms, without building a solver; infinity if none are.
double viscous_step_limit(const Grid& grid, double kinematic_viscosity, ViscousMode mode);

}  // namespace pliant
