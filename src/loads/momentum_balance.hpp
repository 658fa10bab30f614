#pragma once
#include "core/mat3.hpp"
#include "structure/rigid_load.hpp"
#include "mesh/geometry.hpp"

namespace pliant {

/// How a closed body moved during a step, as a rigid whole.
struct InnerMotion {
  Vec3 linear;            ///< of the point about which torques are taken: (v_new - v_old)/dt
  Vec3 angular;           ///< (omega_new - omega_old)/dt
  Vec3 angular_velocity;  ///< in the middle of the step
};

/// The fluid that a closed surface encloses.
struct InnerFluid {
  double density = 1.0;
  SolidMoments moments;  ///< of the enclosed volume where the body is now
  Vec3 acceleration;     ///< uniform force per unit mass that drives the fluid everywhere, the inside included
};

/// Force and torque (about `center`) of the outer fluid on a closed rigid body, from the momentum of all fluid on the
/// inner side of the outer flow. `of_markers` is what the fluid exerts on the markers (DirectForcing::add_forces: minus
/// the force on the fluid, mean of the step), its torque about the same center. With f that load, a the acceleration of
/// the inner fluid, which moves as the body does, and g the uniform acceleration of the fluid:
///
///   d/dt integral_V rho u dV = -f + F_outer + rho V g, hence F = f + rho V (a_centroid - g), and
///   T = t + rho [ V r x (a_center - g) + I alpha + omega x (I omega) ], r = centroid - center,
///
/// I the inertia tensor of the volume about `center` at unit density. An open body encloses nothing: its load is
/// `of_markers` itself. (Uhlmann, J. Comput. Phys. 209, 2005.)
RigidLoad momentum_balance(const RigidLoad& of_markers, const InnerFluid& fluid, const InnerMotion& body,
                           Vec3 center);

}  // namespace pliant
