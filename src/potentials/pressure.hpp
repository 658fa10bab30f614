#pragma once
#include <span>

#include "potentials/shape_state.hpp"

namespace pliant {

/// W = -p V: a constant pressure inside. The force on a vertex is a sixth of p times the face vectors around it, so on
/// an open surface the pressure pushes along the normals; V is then the volume of the cone over it from the origin, and
/// W an energy only as long as its border does not move.
struct Pressure {
  static constexpr const char* name = "pressure";
  double value = 0;  ///< p, inside over outside

  double energy(const ShapeState& shape) const;
  void add_stress(const ShapeState& shape, InnerStress& stress) const;
  void add_forces(const ShapeState& shape, std::span<Vec3> forces) const;
};

}  // namespace pliant
