#pragma once
#include <array>
#include <cstddef>
#include <span>

#include "core/vec3.hpp"

namespace pliant {

/// A point that stands for a piece of a body's surface.
struct SurfacePoint {
  Vec3 position;
  double area = 0;
  int body = 0;  ///< points of one body do not repel each other
};

enum class RepulsionSide { open, wall, periodic };

struct RepulsionBox {
  Vec3 origin;
  Vec3 size{1, 1, 1};
  std::array<RepulsionSide, 6> sides{};  ///< x-, x+, y-, y+, z-, z+; periodic at both ends of a direction or at none
};

/// Short-range repulsion as a double integral over the surfaces, so that it converges with the mesh.
///
/// Two points at distance d = s range < range have the energy p A_i A_j / range psi(s) and the force
/// p A_i A_j / range^2 w(s) along the line that joins them, w = -psi',
///   w(s) = c s (1 - s)^2 / (s^2 + e^2)^(3/2),  e = 0.1:
/// Coulomb's law, which between parallel surfaces gives a pressure that does not depend on the mesh, cut off smoothly
/// at the range and softened near 0. c makes p the greatest pressure between two parallel surfaces, at a gap of 0.11
/// ranges; contact should be designed for less. A wall at distance d presses on a point with p A (1 - s)^2, also from
/// behind (s < 0); energy p A range (1 - s)^3 / 3.
/// Sums over points are sums over the surface if their spacing is not above the gap.
struct Repulsion {
  double strength = 0;  ///< p, a pressure
  double range = 0;     ///< distance at which the repulsion ends
};

/// w(s) and psi(s), both 0 from s = 1 on.
double repulsion_weight(double s);
double repulsion_potential(double s);

/// Adds to forces[i], i < n_own, the force on point i from all points of other bodies and from the walls. Points from
/// n_own on are copies of other ranks' points, each given once; any periodic image will do, the nearest is taken.
/// Pairs are found through cells of about the range. F_ij = -F_ji to the bit, and the sum for a point runs in an order
/// that only positions decide, so it does not depend on how points are numbered or shared out.
/// Points that are not finite repel nothing. Throws InputError if the range is not positive or above half a periodic
/// direction.
void add_repulsion(std::span<const SurfacePoint> points, std::size_t n_own, const RepulsionBox& box,
                   const Repulsion& repulsion, std::span<Vec3> forces);

/// Energy of the first n_own points: that with walls, and half of that with each other point. Over all ranks it adds up
/// to the whole.
double repulsion_energy(std::span<const SurfacePoint> points, std::size_t n_own, const RepulsionBox& box,
                        const Repulsion& repulsion);

}  // namespace pliant
