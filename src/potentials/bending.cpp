#include "potentials/bending.hpp"

#include <cmath>

#include "mesh/geometry.hpp"

namespace pliant {

Bending Bending::about_shape(const TriangleMesh& mesh, std::span<const Vec3> reference, double stiffness) {
  Bending bending = about_flat(mesh, stiffness);
  const auto angles = hinge_angles(mesh, reference);
  for (std::size_t e = 0; e < angles.size(); ++e) {
    bending.cosine0[e] = std::cos(angles[e]);
    bending.sine0[e] = std::sin(angles[e]);
  }
  return bending;
}

Bending Bending::about_flat(const TriangleMesh& mesh, double stiffness) {
  const std::size_t n = mesh.n_edges();
  return {std::vector<double>(n, stiffness), std::vector<double>(n, 1.0), std::vector<double>(n, 0.0)};
}

double Bending::energy(const ShapeState& shape) const {
  const auto hinges = shape.mesh().hinge_of_edge();
  const auto faces = shape.mesh().faces_of_edge();
  double sum = 0;
  for (std::size_t e = 0; e < hinges.size(); ++e) {
    if (hinges[e][3] < 0) continue;
    const Vec3 axis = shape.positions()[hinges[e][1]] - shape.positions()[hinges[e][0]];
    const Vec3 first = shape.face_vectors()[faces[e][0]], second = shape.face_vectors()[faces[e][1]];
    const double scale = shape.inverse_lengths()[faces[e][0]] * shape.inverse_lengths()[faces[e][1]];
    const double cosine = dot(first, second) * scale;
    const double sine = dot(cross(first, second), axis) * scale / norm(axis);
    sum += stiffness[e] * (1.0 - cosine * cosine0[e] - sine * sine0[e]);
  }
  return sum;
}

// With N1, N2 the face vectors, e the edge of length L, m_i = N_i / |N_i|^2, vertices 0 1 of the edge, 2 3 opposite:
// d theta / d x2 = -L m1, d theta / d x3 = -L m2,
// d theta / d x0 = ((x1 - x2).e m1 + (x1 - x3).e m2) / L, d theta / d x1 = ((x2 - x0).e m1 + (x3 - x0).e m2) / L,
// and F = -k sin(theta - theta0) d theta / d x with the sine expanded, so that no angle is ever formed.
void Bending::add_forces(const ShapeState& shape, std::span<Vec3> forces) const {
  const auto hinges = shape.mesh().hinge_of_edge();
  const auto faces = shape.mesh().faces_of_edge();
  const auto positions = shape.positions();
  const auto face_vectors = shape.face_vectors();
  const auto inverse_lengths = shape.inverse_lengths();
  for (std::size_t e = 0; e < hinges.size(); ++e) {
    const auto [a, b, c, d] = hinges[e];
    if (d < 0) continue;
    const auto [face1, face2] = faces[e];
    const Vec3 origin = positions[a];
    const Vec3 axis = positions[b] - origin, to_c = positions[c] - origin, to_d = positions[d] - origin;
    const double length_squared = dot(axis, axis), inverse_length = 1.0 / std::sqrt(length_squared);
    const double inverse1 = inverse_lengths[face1], inverse2 = inverse_lengths[face2];
    const Vec3 n1 = inverse1 * face_vectors[face1], n2 = inverse2 * face_vectors[face2];
    const double cosine = dot(n1, n2);
    const double sine = dot(cross(n1, n2), axis) * inverse_length;
    const double moment = stiffness[e] * (sine * cosine0[e] - cosine * sine0[e]) * inverse_length;
    const Vec3 m1 = (moment * inverse1) * n1, m2 = (moment * inverse2) * n2;
    const double share_c = dot(to_c, axis), share_d = dot(to_d, axis);
    const Vec3 on_a = (share_c - length_squared) * m1 + (share_d - length_squared) * m2;
    const Vec3 on_b = -share_c * m1 - share_d * m2;
    forces[a] += on_a;
    forces[b] += on_b;
    forces[c] += length_squared * m1;
    forces[d] += length_squared * m2;
  }
}

}  // namespace pliant
