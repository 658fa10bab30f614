#include "potentials/bending.hpp"

#include <cmath>

#include "mesh/geometry.hpp"
#include "potentials/lane_records.hpp"

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
    const Vec3 first = shape.face_vector(faces[e][0]), second = shape.face_vector(faces[e][1]);
    const double scale = shape.inverse_length(faces[e][0]) * shape.inverse_length(faces[e][1]);
    const double cosine = dot(first, second) * scale;
    const double sine = dot(cross(first, second), axis) * scale / norm(axis);
    sum += stiffness[e] * (1.0 - cosine * cosine0[e] - sine * sine0[e]);
  }
  return sum;
}

// dW/dtheta = k sin(theta - theta0) with the sine expanded, so that no angle is ever formed.
void Bending::add_stress(const ShapeState& shape, InnerStress& stress) const {
  for_each_batch(shape.mesh().faces_of_edge(), [&](std::size_t begin, const std::array<int, 2>* faces, int count) {
    const LaneRecords first = gather_records(shape.face_records(), [&](int l) { return faces[l][0]; });
    const LaneRecords second = gather_records(shape.face_records(), [&](int l) { return faces[l][faces[l][1] >= 0]; });
    const auto along = [&](int c) { return load_lanes(shape.edge_vectors(c) + begin); };
    const LaneVec axis = {along(0), along(1), along(2)};
    const Lanes inverse_length = load_lanes(shape.inverse_edge_lengths() + begin);
    const LaneVec n1 = first.number * first.vector, n2 = second.number * second.vector;
    const Lanes cosine = dot(n1, n2), sine = dot(cross(n1, n2), axis) * inverse_length;
    const auto of_edges = [&](const std::vector<double>& all) { return load_lanes(all.data() + begin, count); };
    const Lanes sine_from_rest = sine * of_edges(cosine0) - cosine * of_edges(sine0);
    double* moment = stress.moment.data() + begin;
    store(load_lanes(moment) + of_edges(stiffness) * sine_from_rest * inverse_length, moment);
  });
}

void Bending::add_forces(const ShapeState& shape, std::span<Vec3> forces) const {
  add_forces_alone(*this, shape, forces);
}

}  // namespace pliant
