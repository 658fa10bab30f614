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
