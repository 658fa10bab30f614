#include "potentials/shape_state.hpp"

#include <cmath>

#include "mesh/geometry.hpp"

namespace pliant {

void ShapeState::update(std::span<const Vec3> positions) {
  positions_ = positions;
  const auto faces = mesh_->vertices_of_face();
  const std::span<Vec3> face_vectors(face_vectors_);
  const std::span<double> inverse_lengths(inverse_lengths_);
  double twice_area = 0, six_volumes = 0;
  const Vec3 apex = positions.empty() ? Vec3{} : positions[0];
  for (std::size_t f = 0; f < faces.size(); ++f) {
    const Vec3 vector = face_vector(faces[f], positions);
    const double length = norm(vector);
    face_vectors[f] = vector;
    inverse_lengths[f] = 1.0 / length;
    twice_area += length;
    six_volumes += dot(positions[faces[f][0]] - apex, vector);
  }
  area_ = 0.5 * twice_area;
  volume_ = six_volumes / 6.0;
}

}  // namespace pliant
