#pragma once
#include <functional>
#include <memory>

#include "boundary/open_sides.hpp"
#include "config/case_config.hpp"
#include "core/timer.hpp"
#include "field/field.hpp"
#include "signals/signal.hpp"

namespace pliant {

/// The fluid's unknowns. Ghosts are filled at every moment a caller can see.
struct FlowState {
  explicit FlowState(const Grid& grid) : u(grid), v(grid), w(grid), p(grid) {}
  Field<FaceX> u;
  Field<FaceY> v;
  Field<FaceZ> w;
  Field<Center> p;  ///< pressure over density
};

/// The coefficients of one Runge-Kutta substep (numerics.md, section 1).
struct Substep {
  int index;
  double gamma, rho, alpha;
};

/// Called between the prediction and the projection of a substep: the place of the immersed boundary, which changes the
/// predicted velocity.
using PredictedFlowHook = std::function<void(const Substep&, double dt, View<FaceX>, View<FaceY>, View<FaceZ>)>;

/// What the flow solver needs to know of a case.
struct FlowParameters {
  double density = 1.0;
  double viscosity = 1.0;  ///< kinematic
  ViscousMode viscous = ViscousMode::implicit;
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
  FlowState& state();
  const FlowState& state() const;

  /// Fills the ghosts of the state, after a caller has changed its interior (an initial field, a restart).
  void fill_ghosts();
  /// Makes the velocity of the state solenoidal (used once, after an initial field that is not). Open sides take their
  /// values from the field next to them and from the time.
  void project_initial();

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
  void advance(double dt, const PredictedFlowHook& hook = nullptr);

  /// max over cells of |u|/dx + |v|/dy + |w|/dz: the Courant number is dt times this. Collective.
  double convective_rate() const;
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

/// The time-step limit of the explicitly treated viscous terms, without building a solver; infinity if none are.
double viscous_step_limit(const Grid& grid, double kinematic_viscosity, ViscousMode mode);

}  // namespace pliant
