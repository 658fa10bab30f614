#include "potentials/area_penalty.hpp"

#include "potentials/area_gradient.hpp"

namespace pliant {

double FaceAreaPenalty::energy(const ShapeState& shape) const {
  double sum = 0;
  for (std::size_t f = 0; f < reference_area.size(); ++f) {
    const double change = 0.5 * norm(shape.face_vectors()[f]) - reference_area[f];
    sum += 0.5 * stiffness * change * change / reference_area[f];
  }
  return sum;
}

void FaceAreaPenalty::add_forces(const ShapeState& shape, std::span<Vec3> forces) const {
  const auto faces = shape.mesh().vertices_of_face();
  for (std::size_t f = 0; f < faces.size(); ++f) {
    const Vec3 normal = shape.inverse_lengths()[f] * shape.face_vectors()[f];
    const double area = 0.5 * dot(normal, shape.face_vectors()[f]);
    add_face_tension(faces[f], shape.positions(), normal, stiffness * (area / reference_area[f] - 1.0), forces);
  }
}

double TotalAreaPenalty::energy(const ShapeState& shape) const {
  const double change = shape.area() - reference_area;
  return 0.5 * stiffness * change * change / reference_area;
}

void TotalAreaPenalty::add_forces(const ShapeState& shape, std::span<Vec3> forces) const {
  const auto faces = shape.mesh().vertices_of_face();
  const double tension = stiffness * (shape.area() / reference_area - 1.0);
  for (std::size_t f = 0; f < faces.size(); ++f)
    add_face_tension(faces[f], shape.positions(), shape.inverse_lengths()[f] * shape.face_vectors()[f], tension,
                     forces);
}

}  // namespace pliant
