#include "potentials/volume_penalty.hpp"

namespace pliant {

double VolumePenalty::energy(const ShapeState& shape) const {
  const double change = shape.volume() - reference_volume;
  return 0.5 * stiffness * change * change / reference_volume;
}

void VolumePenalty::add_forces(const ShapeState& shape, std::span<Vec3> forces) const {
  const auto faces = shape.mesh().vertices_of_face();
  const double sixth_of_pressure = -stiffness * (shape.volume() - reference_volume) / reference_volume / 6.0;
  for (std::size_t f = 0; f < faces.size(); ++f) {
    const Vec3 share = sixth_of_pressure * shape.face_vectors()[f];
    for (int v : faces[f]) forces[v] += share;
  }
}

}  // namespace pliant
