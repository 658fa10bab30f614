#pragma once
#include "config/case_config.hpp"
#include "field/field.hpp"

namespace pliant {

/// Where a substep stands in a step: the first has no history to read, the last none to leave.
enum class HistoryUse { write, read_write, read };

/// The factors of one substep.
struct MomentumFactors {
  double dt_gamma;   ///< dt gamma, weight of the explicit terms H
  double dt_rho;     ///< dt rho, weight of the last substep's H
  double dt_alpha;   ///< dt alpha, weight of the pressure gradient, of the implicit terms and of the acceleration
  double viscosity;  ///< kinematic
  Vec3 acceleration;
};

/// What the right-hand side reads.
struct MomentumInput {
  ConstView<FaceX> u;
  ConstView<FaceY> v;
  ConstView<FaceZ> w;
  ConstView<Center> p;
};

/// What it writes, and the explicit terms H carried from substep to substep in place.
struct MomentumOutput {
  View<FaceX> u;
  View<FaceY> v;
  View<FaceZ> w;
  View<FaceX> history_u;
  View<FaceY> history_v;
  View<FaceZ> history_w;
};

/// Right-hand side of the predicted velocity on plane k, all three components.
///
/// explicit_rk3:  out = u + dt [gamma H + rho H_old] + dt alpha (g - grad p),       H = -div(u u) + nu L u
/// implicit_z:    out =     dt [gamma H + rho H_old] + dt alpha (g - grad p + nu Lz u),  H = -div(u u) + nu (Lx + Ly) u
/// implicit:      out =     dt [gamma H + rho H_old] + dt alpha (g - grad p + nu L u),   H = -div(u u)
///
/// The implicit forms give the increment before the factored solves. Central differences in flux form; fluxes through
/// the sides of a w cell are weighted by the thickness of the two cells it spans, so that kinetic energy is conserved
/// on stretched grids too.
void momentum_plane(const Grid& grid, ViscousMode mode, HistoryUse history, const MomentumFactors& factors,
                    const MomentumInput& in, const MomentumOutput& out, int k);

}  // namespace pliant
