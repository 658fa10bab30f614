#include "potentials/area_penalty.hpp"

namespace pliant {

double FaceAreaPenalty::energy(const ShapeState& shape) const {
  double sum = 0;
  for (std::size_t f = 0; f < reference_area.size(); ++f) {
    const double change = 0.5 * norm(shape.face_vector(f)) - reference_area[f];
    sum += 0.5 * stiffness * change * change / reference_area[f];
  }
  return sum;
}

void FaceAreaPenalty::add_stress(const ShapeState& shape, InnerStress& stress) const {
  const double* areas = shape.face_areas();
  for (std::size_t f = 0; f < reference_area.size(); ++f)
    stress.tension[f] += stiffness * (areas[f] / reference_area[f] - 1.0);
}

void FaceAreaPenalty::add_forces(const ShapeState& shape, std::span<Vec3> forces) const {
  add_forces_alone(*this, shape, forces);
}

double TotalAreaPenalty::energy(const ShapeState& shape) const {
  const double change = shape.area() - reference_area;
  return 0.5 * stiffness * change * change / reference_area;
}

void TotalAreaPenalty::add_stress(const ShapeState& shape, InnerStress& stress) const {
  const double tension = stiffness * (shape.area() / reference_area - 1.0);
  for (double& t : stress.tension) t += tension;
}

void TotalAreaPenalty::add_forces(const ShapeState& shape, std::span<Vec3> forces) const {
  add_forces_alone(*this, shape, forces);
}

}  // namespace pliant
