#pragma once
#include <array>

#include "structure/rigid_load.hpp"
#include "structure/rigid_state.hpp"

namespace pliant {

enum class AxisMotion { free, locked };

/// Which of the six motions the body may make, along and about the world's x, y and z. The velocity in a locked
/// direction keeps its value to the bit, so that one of 0 holds the body where it is.
struct Freedom {
  std::array<AxisMotion, 3> translation{};
  std::array<AxisMotion, 3> rotation{};
};

struct RigidModel {
  double mass = 0;
  Mat3 inertia;  ///< tensor about the centre, along the axes of the reference shape
  /// Virtual mass and isotropic virtual inertia, of about the fluid's added mass; 0: none. They make loose coupling
  /// stable for light bodies and vanish as the acceleration becomes steady (Schwarz, Kempe & Froehlich, J. Comput.
  /// Phys. 281 (2015) 591-613).
  double virtual_mass = 0;
  double virtual_inertia = 0;
  Freedom freedom;
};

/// Moves a body through `step` under a load that stays constant in the world's frame.
///
/// Translation: (m + m_v) a' = F + m_v a_old, exact for this load. Rotation: with K = (R I R^T + I_v) omega,
/// K' = K + step (T + I_v alpha_old) and R' = exp(step (omega + omega')/2) R, solved for R' and omega' by iteration;
/// symmetric in time. Hence, without virtual inertia, angular momentum changes by step T to round-off, for any step;
/// orientation and energy are second order. Virtual terms lag by one step and are first order.
///
/// `acceleration` holds the mean over the last step on entry (only virtual terms read it) and that over this one on
/// return. m + m_v must be positive, and R I R^T + I_v positive definite in the free directions.
void advance_rigid(RigidState& state, RigidAcceleration& acceleration, const RigidModel& model, const RigidLoad& load,
                   double step);

/// The same inside an iteration: always from the state at the start of the step, with the mean of the loads at its
/// start and at the last guess of its end. `acceleration` is that of the last guess on entry, so that virtual terms
/// vanish as the iteration converges and only its path depends on them; the new one on return.
/// A load that is a mean over the step, like the reaction of an added mass r times the body's, belongs to both ends
/// alike: in the mean with its forerunner it would ring with -r / (2 + r).
RigidState advance_rigid_trapezoidal(const RigidState& start, RigidAcceleration& acceleration, const RigidModel& model,
                                     const RigidLoad& load_at_start, const RigidLoad& load_at_end, double step);

/// Under a load at one moment: a = F/m and R I R^T alpha = T - omega x (R I R^T omega) in the free directions, 0 in the
/// locked ones; without virtual mass and inertia.
RigidAcceleration rigid_acceleration(const RigidModel& model, const RigidState& state, const RigidLoad& load);

/// R I R^T omega: angular momentum about the centre, in the world's frame.
Vec3 angular_momentum(const RigidState& state, const Mat3& inertia);

/// m v^2 / 2 + omega . L / 2.
double kinetic_energy(const RigidState& state, const RigidModel& model);

}  // namespace pliant
