#include <gtest/gtest.h>

#include <numbers>

#include "deformed.hpp"
#include "mesh/geometry.hpp"
#include "potentials/potential_set.hpp"

namespace pliant {
namespace {

struct InflatedSphere : testing::Test {
  Surface sphere = make_icosphere(4, 1.0);
  double factor = 1.1;
  std::vector<Vec3> grown = sphere.positions;
  void SetUp() override {
    for (Vec3& x : grown) x *= factor;
  }
  template <class Potential>
  double energy(const Potential& potential) const {
    return potential.energy(ShapeState(sphere.mesh, grown));
  }
};

TEST_F(InflatedSphere, HasTheKnownEnergies) {
  const double volume = enclosed_volume(sphere.mesh, sphere.positions),
               area = total_area(sphere.mesh, sphere.positions);
  const double volume_strain = std::pow(factor, 3) - 1, area_strain = std::pow(factor, 2) - 1;
  EXPECT_NEAR(energy(VolumePenalty{7.0, volume}), 3.5 * volume_strain * volume_strain * volume, 1e-12);
  EXPECT_NEAR(energy(TotalAreaPenalty{7.0, area}), 3.5 * area_strain * area_strain * area, 1e-12);
  EXPECT_NEAR(energy(FaceAreaPenalty{7.0, face_areas(sphere.mesh, sphere.positions)}),
              3.5 * area_strain * area_strain * area, 1e-12);
  EXPECT_NEAR(energy(SurfaceTension{7.0, 0.0}), 7.0 * factor * factor * area, 1e-12);
  double squares = 0;
  for (double l : edge_lengths(sphere.mesh, sphere.positions)) squares += l * l;
  EXPECT_NEAR(energy(EdgeSprings::uniform(sphere.mesh, sphere.positions, 7.0, 1.0)), 3.5 * 0.01 * squares, 1e-12);
  EXPECT_NEAR(energy(Bending::about_shape(sphere.mesh, sphere.positions, 7.0)), 0.0, 1e-12);
}

TEST_F(InflatedSphere, TensionBalancesTheLaplacePressure) {
  // At one radius the penalty's pressure is 2 sigma / R, up to the discretisation: the work of a uniform inflation says
  // so.
  const double sigma = 2.0;
  const auto forces = forces_of(SurfaceTension{sigma, 0.0}, sphere.mesh, sphere.positions);
  double work = 0;
  for (std::size_t v = 0; v < forces.size(); ++v) work += dot(forces[v], sphere.positions[v]);
  EXPECT_NEAR(work, -2.0 * sigma * total_area(sphere.mesh, sphere.positions), 1e-12);
}

TEST(Springs, ReferenceShapeIsFreeOfStress) {
  const auto sphere = make_icosphere(3, 1.0);
  PotentialSet set;
  set.add(EdgeSprings::uniform(sphere.mesh, sphere.positions, 10.0, 1.0));
  set.add(Bending::about_shape(sphere.mesh, sphere.positions, 10.0));
  set.add(VolumePenalty{10.0, enclosed_volume(sphere.mesh, sphere.positions)});
  set.add(FaceAreaPenalty{10.0, face_areas(sphere.mesh, sphere.positions)});
  std::vector<Vec3> forces(sphere.positions.size());
  set.add_forces(ShapeState(sphere.mesh, sphere.positions), forces);
  for (const Vec3& f : forces) EXPECT_LT(norm(f), 1e-12);
}

TEST(Springs, OfRestLengthZeroAreLinear) {
  const auto s = deformed_sphere(2, 1);
  const auto springs = EdgeSprings::uniform(s.mesh, s.reference, 2.0, 0.0);
  const auto forces = forces_of(springs, s.mesh, s.positions);
  for (int v = 0; v < s.mesh.n_vertices(); ++v) {
    Vec3 expected;
    for (int w : s.mesh.neighbours_of_vertex(v)) expected += 2.0 * (s.positions[w] - s.positions[v]);
    EXPECT_LT(norm(forces[v] - expected), 1e-13);
  }
}

TEST(Springs, OfRestLengthZeroSurviveAnEdgeOfLengthZero) {
  auto s = deformed_sphere(1, 1);
  const auto [a, b] = s.mesh.vertices_of_edge()[0];
  const auto springs = EdgeSprings::uniform(s.mesh, s.reference, 2.0, 0.0);
  s.positions[a] = s.positions[b];
  for (const Vec3& f : forces_of(springs, s.mesh, s.positions)) EXPECT_TRUE(std::isfinite(f.x + f.y + f.z));
}

TEST(Bending, OfARightAngleIsTheFormula) {
  const TriangleMesh mesh(4, {{0, 1, 2}, {1, 0, 3}});
  const std::vector<Vec3> folded{{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, 0, -1}};
  const ShapeState shape(mesh, folded);
  EXPECT_NEAR(Bending::about_flat(mesh, 3.0).energy(shape), 3.0, 1e-15);
  EXPECT_NEAR(Bending::about_shape(mesh, folded, 3.0).energy(shape), 0.0, 1e-15);
  // The free corners move along the normals of their faces with the moment k sin(theta) over their distance, 1.
  const auto forces = forces_of(Bending::about_flat(mesh, 3.0), mesh, folded);
  EXPECT_LT(norm(forces[2] - Vec3{0, 0, 3}), 1e-14);
  EXPECT_LT(norm(forces[3] - Vec3{0, -3, 0}), 1e-14);
}

TEST(Potentials, GiveTheSameBitsTwice) {
  const auto s = deformed_sphere(3, 4);
  PotentialSet set;
  set.add(EdgeSprings::uniform(s.mesh, s.reference, 3.0, 0.5));
  set.add(SurfaceTension{1.0, 0.5});
  std::vector<Vec3> first(s.positions.size()), second(s.positions.size());
  set.add_forces(ShapeState(s.mesh, s.positions), first);
  set.add_forces(ShapeState(s.mesh, s.positions), second);
  EXPECT_EQ(first, second);
}

}  // namespace
}  // namespace pliant
