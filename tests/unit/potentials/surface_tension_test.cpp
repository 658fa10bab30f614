#include "potentials/surface_tension.hpp"

#include <gtest/gtest.h>

#include <algorithm>

#include "deformed.hpp"
#include "mesh/geometry.hpp"

namespace pliant {
namespace {

std::vector<Vec3> volume_normals(const DeformedSurface& s) {
  std::vector<Vec3> normals(s.positions.size());
  for (const Face& face : s.mesh.vertices_of_face())
    for (int v : face) normals[v] += face_vector(face, s.positions);
  for (Vec3& n : normals) n = normalized(n);
  return normals;
}

TEST(MeshControl, LeavesTheNormalForceOfTheTensionAlone) {
  const auto s = deformed_sphere(3, 7);
  const auto exact = forces_of(SurfaceTension{2.0, 0.0}, s.mesh, s.positions);
  const auto controlled = forces_of(SurfaceTension{2.0, 1.5}, s.mesh, s.positions);
  const auto normals = volume_normals(s);
  for (std::size_t v = 0; v < exact.size(); ++v)
    EXPECT_NEAR(dot(exact[v], normals[v]), dot(controlled[v], normals[v]), 1e-12);
}

TEST(MeshControl, AddsNoNetForceAndTorque) {
  for (unsigned seed : {1u, 2u, 3u}) {
    const auto s = deformed_sphere(3, seed);
    Vec3 force, torque;
    const auto forces = forces_of(SurfaceTension{2.0, 1.5}, s.mesh, s.positions);
    for (std::size_t v = 0; v < forces.size(); ++v) {
      force += forces[v];
      torque += cross(s.positions[v], forces[v]);
    }
    EXPECT_LT(norm(force), 1e-12);
    EXPECT_LT(norm(torque), 1e-11);
  }
}

TEST(MeshControl, EvensOutAMeshWithoutMovingTheShape) {
  // Slide the vertices of a sphere along it to the equator; then relax along the tangential part alone.
  auto s = deformed_sphere(4, 1);
  s.positions = s.reference;
  for (Vec3& x : s.positions) x = normalized({x.x, x.y, 0.5 * x.z});
  const auto spread = [&] {
    const auto areas = face_areas(s.mesh, s.positions);
    const auto [least, most] = std::minmax_element(areas.begin(), areas.end());
    return *most / *least;
  };
  const double before = spread();
  for (int i = 0; i < 200; ++i) {
    const auto forces = forces_of(SurfaceTension{1.0, SurfaceTension::balanced_control(1.0)}, s.mesh, s.positions);
    const auto normals = volume_normals(s);
    for (std::size_t v = 0; v < forces.size(); ++v)
      s.positions[v] += 0.1 * (forces[v] - dot(forces[v], normals[v]) * normals[v]);
  }
  EXPECT_GT(before, 5);
  EXPECT_LT(spread(), 2);
}

TEST(MeshControl, BalancedStiffnessHasTheTensionOfTheSurface) {
  // Energy of an even flat sheet of springs of rest length 0 per area, against sigma.
  const auto patch = make_lattice_patch(20);
  const double k = SurfaceTension::balanced_control(3.0);
  double energy = 0, area = total_area(patch.mesh, patch.positions);
  for (const auto& [a, b] : patch.mesh.vertices_of_edge())
    energy += 0.5 * k * dot(patch.positions[a] - patch.positions[b], patch.positions[a] - patch.positions[b]);
  for (int e = 0; e < patch.mesh.n_edges(); ++e)
    if (patch.mesh.faces_of_edge()[e][1] < 0) energy -= 0.25 * k;  // border edges belong half to the sheet
  EXPECT_NEAR(energy / area, 3.0, 1e-12);
}

}  // namespace
}  // namespace pliant
