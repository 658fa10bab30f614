#pragma once
#include <array>
#include <utility>
#include <vector>

#include "boundary/fill_ghosts.hpp"
#include "boundary/open_sides.hpp"
#include "flow/flow_solver.hpp"
#include "flow/helmholtz_adi.hpp"
#include "flow/momentum.hpp"
#include "flow/projection.hpp"
#include "solvers/poisson_solver.hpp"

namespace pliant {

struct VelocityFields {
  Field<FaceX>& u;
  Field<FaceY>& v;
  Field<FaceZ>& w;
};

inline HistoryUse history_use(const Substep& s) {
  return s.index == 0 ? HistoryUse::write : s.index == 1 ? HistoryUse::read_write : HistoryUse::read;
}

/// The arrays and solvers of a flow, and what every way of sweeping over them does alike.
struct FlowParts {
  FlowParts(const Grid& grid, const FlowParameters& parameters);
  FlowParts(const FlowParts&) = delete;
  FlowParts& operator=(const FlowParts&) = delete;

  Grid grid;
  FlowParameters parameters;
  FlowState state;
  Field<FaceX> history_u;  // explicit terms of the last substep
  Field<FaceY> history_v;
  Field<FaceZ> history_w;
  FluxRows momentum_fluxes;
  Field<Center> phi;  // pressure increment
  std::array<FieldRules, 3> rules;
  FieldRules rules_p;
  OpenSides open;
  SlabHalo halo;
  PoissonSolver poisson;
  std::vector<HelmholtzAdi> adi;  // [substep][component]; empty if all terms are explicit
  PhaseTimer timer;
  HelmholtzAdi* unfinished = nullptr;  // the viscous solves whose substitution is left

  VelocityFields state_velocity() { return {state.u, state.v, state.w}; }
  bool is_implicit() const { return !adi.empty(); }
  CorrectionTerms correction_terms() const;

  /// Adds the forces at rows j_begin to j_end - 1 of plane k to right-hand sides.
  static void add_forces(NodalForces& forces, const MomentumFactors& factors, const VelocityPlane<double>& rows,
                         int j_begin, int j_end, int k) {
    for (int j = j_begin; j < j_end; ++j)
      forces.take_row(factors.dt_alpha, rows.u.at_row(j), rows.v.at_row(j), rows.w.at_row(j), j, k);
  }

  /// The three implicit solves of a substep, made ready.
  HelmholtzAdi* begin_viscous(const Substep& s, double dt);
  /// Row j of the right-hand sides of plane k goes into the solves; plane k + 1 is as end_viscous_plane() left it.
  static void begin_viscous_row(HelmholtzAdi* solve, const VelocityFields& predicted, const MomentumInput& old, int j,
                                int k);
  /// The plane is complete; `predicted` is the whole field and holds plane k + 1 as this left it.
  void end_viscous_plane(HelmholtzAdi* solve, const VelocityFields& predicted, const MomentumInput& old, int k) const;
  /// After all planes. What is left is the substitution from the lowest plane upwards. Collective.
  void couple_viscous(HelmholtzAdi* solve);
  /// Makes it, if it is left, and fills the ghosts in the planes.
  void finish_viscous(const VelocityFields& predicted);
  /// True if begin_projection() may make it on its way: no rank wants the highest plane before.
  bool may_finish_late() const { return !poisson.is_coupled(); }

  void fill_plane(const VelocityFields& velocity, int k) const;  ///< x and y ghosts
  /// The same in parts: x ghosts of a row, and the ghost rows of a plane whose rows are complete.
  void fill_row(const VelocityPlane<double>& velocity, int j, int k) const;
  void fill_rows_beyond(const VelocityPlane<double>& velocity, int k) const;
  /// Ghost planes in z, and the faces on the sides, of a predicted velocity. Collective.
  void fill_predicted_ends(const VelocityFields& predicted, GhostPlanes which);
  /// The same of the state, all fields. Collective.
  void fill_state_ends();
  void fill_state_ghosts();  ///< x and y ghosts as well

  /// From the predicted velocity to the eliminated modes of the pressure increment. Returns the largest convective rate
  /// of this rank's part of that velocity if it is wanted, else 0.
  double begin_projection(const VelocityFields& predicted, double dt_alpha, bool wants_rate);

  std::size_t bytes() const;

 private:
  template <class Visit>
  void finish_viscous_plane(const VelocityFields& predicted, int k, Visit visit) const;
};

/// One way through the fields.
class FlowSweeps {
 public:
  virtual ~FlowSweeps() = default;
  /// From the state at the beginning of the substep to the predicted velocity, with the ghosts that the projection
  /// and `ends` want. Collective.
  virtual void predict(const Substep& s, const MomentumFactors& factors, double dt, NodalForces* forces) = 0;
  virtual VelocityFields predicted() = 0;
  /// Which ghost planes predicted() must have before it is projected.
  virtual GhostPlanes wanted_ends() const = 0;
  /// From predicted() to the state, at once or when it is next wanted. Collective. Returns begin_projection()'s rate.
  virtual double project(const CorrectionFactors& factors, bool wants_rate) = 0;
  /// Makes the state what it stands for. Collective.
  virtual void settle() = 0;
  /// Forgets what settle() would do: the state is about to be given anew.
  virtual void discard() = 0;
  /// Takes the velocity of a settled state as predicted().
  virtual void adopt_state() = 0;
  virtual std::size_t bytes() const = 0;
};

}  // namespace pliant
