#include "potentials/volume_penalty.hpp"

namespace pliant {

double VolumePenalty::energy(const ShapeState& shape) const {
  const double change = shape.volume() - reference_volume;
  return 0.5 * stiffness * change * change / reference_volume;
}

void VolumePenalty::add_stress(const ShapeState& shape, InnerStress& stress) const {
  stress.pressure -= stiffness * (shape.volume() - reference_volume) / reference_volume;
}

void VolumePenalty::add_forces(const ShapeState& shape, std::span<Vec3> forces) const {
  add_forces_alone(*this, shape, forces);
}

}  // namespace pliant
