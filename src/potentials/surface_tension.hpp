#pragma once
#include <span>

#include "potentials/shape_state.hpp"

namespace pliant {

/// W = sigma A: a liquid interface.
///
/// mesh_control = 0: the exact gradient, tangential part included.
/// mesh_control = k > 0: the shape moves by the normal part alone, and springs of rest length 0 and stiffness k on
/// every edge, projected on the tangent planes, keep the vertices even. At a vertex, with n along the gradient of the
/// enclosed volume, the force is (F.n) n + t, where F is the exact gradient force and t the tangential part of the
/// springs. What is exact: the normal component at every vertex is that of -grad(sigma A), and the net force and torque
/// are zero: the tangential field is corrected by the tangential part of a rigid motion. What is not: with the control
/// the force is no gradient, so energy() (always sigma A) is not conserved by it. Needs a closed surface. Springs of
/// rest length 0 even out every distortion of a mesh but a slide of all vertices towards one pole, which costs them
/// nothing: do not start with one.
struct SurfaceTension {
  static constexpr const char* name = "surface_tension";
  double sigma = 0;         ///< force / length
  double mesh_control = 0;  ///< force / length

  /// Stiffness whose springs pull an even mesh as sigma does: an equilateral network of rest length 0 has the tension
  /// sqrt(3) k.
  static double balanced_control(double sigma);

  double energy(const ShapeState& shape) const;
  void add_forces(const ShapeState& shape, std::span<Vec3> forces) const;
};

}  // namespace pliant
