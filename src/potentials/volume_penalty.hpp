#pragma once
#include <span>

#include "potentials/shape_state.hpp"

namespace pliant {

/// W = k ((V - V0) / V0)^2 V0 / 2 with V the volume enclosed by the whole body. The surface must be closed: then the
/// gradient at a vertex is a sixth of the face vectors around it, whatever the origin.
struct VolumePenalty {
  static constexpr const char* name = "volume";
  double stiffness = 0;         ///< k, pressure
  double reference_volume = 0;  ///< V0

  double energy(const ShapeState& shape) const;
  void add_stress(const ShapeState& shape, InnerStress& stress) const;
  void add_forces(const ShapeState& shape, std::span<Vec3> forces) const;
};

}  // namespace pliant
