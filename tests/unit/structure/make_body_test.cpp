#include "structure/make_body.hpp"

#include <gtest/gtest.h>

#include <numbers>

#include "core/error.hpp"
#include "mesh/geometry.hpp"
#include "structure/stable_time_step.hpp"
#include "unit/structure/body_of.hpp"

namespace pliant {
namespace {

BodyConfig drop() {
  BodyConfig config;
  config.name = "drop";
  config.surface = SphereSurface{3, 2.0};
  config.center = {1, 2, 3};
  config.mass_per_vertex = 0.25;
  return config;
}

TEST(MakeBody, PutsASphereAtRestAtItsPlace) {
  const auto body = body_of(drop());
  EXPECT_EQ(body.mesh.n_vertices(), 92);
  EXPECT_LT(norm(enclosed_moments(body.mesh, body.positions).centroid - Vec3{1, 2, 3}), 1e-13);
  EXPECT_NEAR(body.radius, std::cbrt(enclosed_volume(body.mesh, body.positions) * 3 / (4 * std::numbers::pi)), 1e-14);
  for (const Vec3& v : body.velocities) EXPECT_EQ(v, Vec3{});
  for (double m : body.masses) EXPECT_EQ(m, 0.25);
  EXPECT_TRUE(body.potentials.empty());
  EXPECT_EQ(body.largest_frequency, 0);
}

TEST(MakeBody, MakesThePotentialsOfTheConfiguration) {
  auto config = drop();
  config.potentials.edge = EdgeConfig{7.0, 0.5};
  config.potentials.bending = BendingConfig{3.0, ReferenceAngle::initial};
  config.potentials.volume = VolumeConfig{10.0};
  config.potentials.area = AreaConfig{10.0};
  config.potentials.total_area = AreaConfig{10.0};
  config.potentials.surface_tension = SurfaceTensionConfig{2.0, 0.0};
  const auto body = body_of(config);
  const auto energies = body.potentials.energies(body.mesh, body.positions);
  ASSERT_EQ(energies.size(), 6u);
  double squares = 0;
  for (double l : edge_lengths(body.mesh, body.positions)) squares += l * l;
  EXPECT_EQ(energies[0].first, "edge");
  EXPECT_NEAR(energies[0].second, 0.5 * 7.0 * 0.25 * squares, 1e-10);
  for (int i : {1, 2, 3, 4}) EXPECT_NEAR(energies[i].second, 0.0, 1e-12) << energies[i].first;
  EXPECT_NEAR(energies[5].second, 2.0 * total_area(body.mesh, body.positions), 1e-10);
  EXPECT_DOUBLE_EQ(std::get<SurfaceTension>(body.potentials.potentials()[5]).mesh_control, 2.0 / std::sqrt(3.0));
  EXPECT_EQ(body.largest_frequency, find_largest_frequency(body));
  EXPECT_GT(body.largest_frequency, 0);
}

TEST(MakeBody, RefusesStiffnessesBeyondNumbers) {
  auto config = drop();
  config.potentials.edge = EdgeConfig{1e308, 0.0};
  EXPECT_THROW(body_of(config), InputError);
}

TEST(MakeBody, ProbesAreOneSpacingLongUnlessGiven) {
  auto config = drop();
  EXPECT_EQ(body_of(config, 0.125).traction.probe_length, 0.125);
  config.traction.probe_length = 0.5;
  EXPECT_EQ(body_of(config, 0.125).traction.probe_length, 0.5);
}

TEST(MakeBody, RefusesAMassOfZero) {
  auto config = drop();
  config.mass_per_vertex = 0;
  EXPECT_THROW(body_of(config), InputError);
}

TEST(LoadShape, RefusesAMissingFile) {
  auto config = drop();
  config.surface = FileSurface{"no-such-file.gts", 1.0};
  EXPECT_THROW(load_shape(config, "."), InputError);
}

}  // namespace
}  // namespace pliant
