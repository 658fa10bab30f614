#include "structure/interface_mesh.hpp"

#include <gtest/gtest.h>

#include <algorithm>

#include "mesh/geometry.hpp"
#include "mesh/shapes/icosphere.hpp"
#include "unit/structure/body_of.hpp"

namespace pliant {
namespace {

Surface ellipsoid() {
  Surface surface = make_icosphere(8, 1);
  for (Vec3& x : surface.positions) x = Vec3{1.3 * x.x + 0.2 * x.z, 0.9 * x.y, 0.8 * x.z} + Vec3{0.4, -2, 1};
  return surface;
}

double volume_rate(const Surface& surface, std::span<const Vec3> velocities) {
  const auto gradient = volume_gradient(surface.mesh, surface.positions);
  double rate = 0;
  for (std::size_t v = 0; v < gradient.size(); ++v) rate += dot(gradient[v], velocities[v]);
  return rate;
}

double largest_over_least_face(const Surface& surface) {
  const auto areas = face_areas(surface.mesh, surface.positions);
  const auto [least, most] = std::minmax_element(areas.begin(), areas.end());
  return *most / *least;
}

void even_out_on_sphere(Surface& surface, int times) {
  for (int n = 0; n < times; ++n) {
    even_out(surface.mesh, surface.positions, 0.1);
    for (Vec3& x : surface.positions) x = normalized(x);
  }
}

TEST(InterfaceMesh, TranslationHasTheCentroidsVelocityAndStays) {
  const Surface surface = ellipsoid();
  const Vec3 velocity{0.3, -1, 2};
  std::vector<Vec3> velocities(surface.positions.size(), velocity);
  EXPECT_LT(norm(centroid_velocity(surface.mesh, surface.positions, velocities) - velocity), 1e-13);
  keep_normal_part(surface.mesh, surface.positions, velocities);
  for (const Vec3& v : velocities) ASSERT_LT(norm(v - velocity), 1e-13);
}

TEST(InterfaceMesh, NormalPartChangesTheVolumeAtTheSameRate) {
  const Surface surface = ellipsoid();
  std::vector<Vec3> velocities;
  for (const Vec3& x : surface.positions) velocities.push_back({x.x * x.y, 0.5 * x.y * x.y, x.z * x.x + 1});
  const double before = volume_rate(surface, velocities);
  keep_normal_part(surface.mesh, surface.positions, velocities);
  EXPECT_NEAR(volume_rate(surface, velocities), before, 1e-13 * std::abs(before));
}

TEST(InterfaceMesh, SlidingOfASphereOnItselfIsNoMotion) {
  const Surface surface = make_icosphere(8, 1);
  std::vector<Vec3> velocities;
  for (const Vec3& x : surface.positions) velocities.push_back(cross({0.2, 1, -0.5}, x));
  keep_normal_part(surface.mesh, surface.positions, velocities);
  for (const Vec3& v : velocities) ASSERT_LT(norm(v), 0.02);
}

TEST(InterfaceMesh, AMeshThatWasDrawnToOneSideBecomesAsEvenAsOneThatWasNot) {
  Surface even = make_icosphere(4, 1), drawn = even;
  for (Vec3& x : drawn.positions) x = normalized(x + Vec3{0.4, 0, 0});
  ASSERT_GT(largest_over_least_face(drawn), 4);
  even_out_on_sphere(even, 4000);
  even_out_on_sphere(drawn, 4000);
  EXPECT_NEAR(largest_over_least_face(drawn), largest_over_least_face(even), 0.01);
}

TEST(InterfaceMesh, SurfaceTensionAloneInAFlowThatFeelsItMakesAnInterface) {
  BodyConfig config;
  config.name = "drop";
  config.surface = SphereSurface{3, 1.0};
  config.potentials.surface_tension = SurfaceTensionConfig{1, 0};
  config.coupling = CouplingKind::force_spreading;
  EXPECT_TRUE(body_of(config).is_interface);
  config.coupling = CouplingKind::one_way;
  EXPECT_FALSE(body_of(config).is_interface);
  config.coupling = CouplingKind::automatic;
  EXPECT_TRUE(body_of(config).is_interface);
  config.potentials.surface_tension->mesh_control = 0.5;
  EXPECT_FALSE(body_of(config).is_interface);
  config.potentials.surface_tension->mesh_control = 0;
  config.potentials.edge = EdgeConfig{1, 1};
  EXPECT_FALSE(body_of(config).is_interface);
}

}  // namespace
}  // namespace pliant
