#pragma once
#include <span>

#include "core/vec3.hpp"

namespace pliant {

/// How far the flow misses the velocity of a surface. Sums, so that parts of a surface may be put together.
struct Slip {
  double squares = 0;  ///< sum of |U - V|^2 A
  double area = 0;
  double largest = 0;  ///< of |U - V|
  double flux = 0;     ///< sum of (U - V).n A: volume a unit time that passes a closed surface outwards

  /// Root mean square over the area of |U - V|; 0 without markers.
  double rms() const;
};

/// Of the markers of a surface: U the flow's velocity after the projection (DirectForcing::add_velocities, whole), V
/// the surface's, unit normals, areas; all of the same size.
Slip measure_slip(std::span<const Vec3> flow_velocities, std::span<const Vec3> surface_velocities,
                  std::span<const Vec3> normals, std::span<const double> areas);

Slip operator+(const Slip& a, const Slip& b);

}  // namespace pliant
