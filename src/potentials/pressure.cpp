#include "potentials/pressure.hpp"

namespace pliant {

double Pressure::energy(const ShapeState& shape) const {
  if (shape.mesh().is_closed()) return -value * shape.volume();
  double six_volumes = 0;
  const auto faces = shape.mesh().vertices_of_face();
  for (std::size_t f = 0; f < faces.size(); ++f)
    six_volumes += dot(shape.positions()[faces[f][0]], shape.face_vector(f));
  return -value * six_volumes / 6.0;
}

void Pressure::add_stress(const ShapeState&, InnerStress& stress) const { stress.pressure += value; }

void Pressure::add_forces(const ShapeState& shape, std::span<Vec3> forces) const {
  add_forces_alone(*this, shape, forces);
}

}  // namespace pliant
