#include "potentials/moduli.hpp"

#include <cmath>

#include "mesh/geometry.hpp"

namespace pliant {
namespace {

double area_beside(const TriangleMesh& mesh, std::span<const double> areas, int edge) {
  const auto [first, second] = mesh.faces_of_edge()[edge];
  return areas[first] + (second < 0 ? 0.0 : areas[second]);
}

}  // namespace

std::vector<double> van_gelder_stiffness(const TriangleMesh& mesh, std::span<const Vec3> reference, double young,
                                         double thickness) {
  const auto areas = face_areas(mesh, reference);
  auto stiffness = edge_lengths(mesh, reference);
  for (int e = 0; e < mesh.n_edges(); ++e)
    stiffness[e] = young * thickness * area_beside(mesh, areas, e) / (stiffness[e] * stiffness[e]);
  return stiffness;
}

FibreStiffness fibre_stiffness(Vec3 direction, double young_along, double young_across) {
  const double e1 = young_along, e2 = young_across;
  const double at30 = 8 * e1 * e2 / (9 * e2 - e1), at60 = 8 * e1 * e2 / (9 * e1 - e2);
  return {normalized(direction),
          {(e1 + 2 * at30 + 2 * at60 + e2) / 6, (e1 + at30 - at60 - e2) / 3, (e1 - at30 - at60 + e2) / 3,
           (e1 - 2 * at30 + 2 * at60 - e2) / 6}};
}

std::vector<double> fibre_network_stiffness(const TriangleMesh& mesh, std::span<const Vec3> reference,
                                            const FibreStiffness& fibre, double thickness) {
  auto stiffness = van_gelder_stiffness(mesh, reference, 1.0, thickness);
  const auto faces = mesh.vertices_of_face();
  for (int e = 0; e < mesh.n_edges(); ++e) {
    const auto [a, b] = mesh.vertices_of_edge()[e];
    const auto [first, second] = mesh.faces_of_edge()[e];
    Vec3 normal = normalized(face_vector(faces[first], reference));
    if (second >= 0) normal += normalized(face_vector(faces[second], reference));
    normal = normalized(normal);
    const Vec3 in_plane = fibre.direction - dot(fibre.direction, normal) * normal;
    const double length = norm(in_plane);
    const double cosine =
        length > 1e-6 ? dot(in_plane, reference[b] - reference[a]) / (length * norm(reference[b] - reference[a])) : 0;
    const double c = 2.0 * cosine * cosine - 1.0;  // of twice the angle
    const auto& h = fibre.harmonics;
    stiffness[e] *= length > 1e-6 ? h[0] + h[1] * c + h[2] * (2 * c * c - 1) + h[3] * c * (4 * c * c - 3) : h[0];
  }
  return stiffness;
}

double bending_modulus(double young, double thickness, double poisson) {
  return young * thickness * thickness * thickness / (12.0 * (1.0 - poisson * poisson));
}

std::vector<double> hinge_stiffness(const TriangleMesh& mesh, std::span<const Vec3> reference, double bending_modulus) {
  const auto areas = face_areas(mesh, reference);
  auto stiffness = edge_lengths(mesh, reference);
  for (int e = 0; e < mesh.n_edges(); ++e) {
    const bool border = mesh.faces_of_edge()[e][1] < 0;
    stiffness[e] = border ? 0.0 : bending_modulus * stiffness[e] * stiffness[e] / area_beside(mesh, areas, e);
  }
  return stiffness;
}

NetworkModuli equilateral_moduli(double stiffness) {
  const double root3 = std::sqrt(3.0);
  return {root3 * stiffness / 4.0, root3 * stiffness / 2.0, 2.0 * stiffness / root3};
}

}  // namespace pliant
