#include "structure/make_body.hpp"

#include <gtest/gtest.h>

#include <numbers>

#include "core/error.hpp"
#include "mesh/geometry.hpp"
#include "potentials/moduli.hpp"
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

TEST(MakeBody, WatchesTheMeanOfASelection) {
  auto config = drop();
  SelectionConfig upper;
  upper.name = "upper";
  upper.plane =
      SelectionConfig::Plane{.point = {0, 0, 3}, .normal = {0, 0, 1}, .side = PlaneSide::beyond, .tolerance = {}};
  config.selections = {upper};
  config.watch = {"upper"};
  auto body = body_of(config);
  ASSERT_EQ(body.watches.size(), 1u);
  EXPECT_EQ(body.watches[0].name, "upper");
  Vec3 sum;
  int count = 0;
  for (const Vec3& x : body.positions)
    if (x.z > 3 - 1e-9) sum += x, ++count;
  EXPECT_EQ(static_cast<int>(body.watches[0].vertices.size()), count);
  EXPECT_LT(norm(body.watches[0].mean_of(body.positions) - sum / count), 1e-13);
  // In a rigid rotation about the origin the mean velocity is that of the mean position.
  const Vec3 omega{1, -2, 3};
  for (std::size_t v = 0; v < body.positions.size(); ++v) body.velocities[v] = cross(omega, body.positions[v]);
  EXPECT_LT(norm(body.watches[0].mean_of(body.velocities) - cross(omega, sum / count)), 1e-12);
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

TEST(MakeBody, WithoutAMassHasNoFrequency) {
  auto config = drop();
  config.mass_per_vertex = 0;
  config.potentials.edge = EdgeConfig{7.0, 0.5};
  const auto body = body_of(config);
  EXPECT_EQ(body.masses[0], 0);
  EXPECT_EQ(body.largest_frequency, std::numeric_limits<double>::infinity());
  const std::vector<double> fluid(body.masses.size(), 0.25);
  config.mass_per_vertex = 0.25;
  EXPECT_EQ(find_largest_frequency(body, fluid), body_of(config).largest_frequency);
}

TEST(MakeBody, WeighsItsWall) {
  auto config = drop();
  config.mass_per_vertex.reset();
  EXPECT_EQ(body_of(config).masses[0], 0.0) << "a surface of the flow, unless it moves by itself";
  config.coupling = CouplingKind::one_way;
  EXPECT_EQ(body_of(config).masses[0], 1.0);
  config.coupling = CouplingKind::automatic;
  config.material.thickness = 0.1;
  config.material.density = 3.0;
  const auto body = body_of(config);
  double total = 0;
  for (double m : body.masses) total += m;
  EXPECT_NEAR(total, 0.3 * total_area(body.mesh, body.positions), 1e-12);
  config.material.density.reset();
  EXPECT_NEAR(body_of(config).masses[5], body.masses[5] / 3, 1e-15) << "the density of the fluid is 1";
  config.mass_per_vertex = 0.25;
  EXPECT_EQ(body_of(config).masses[5], 0.25);
}

TEST(MakeBody, MakesSpringsAndHingesOfItsMaterial) {
  auto config = drop();
  config.material.thickness = 0.1;
  config.material.young = 30.0;
  config.material.poisson = 0.2;
  const auto body = body_of(config);
  const auto potentials = body.potentials.potentials();
  ASSERT_EQ(potentials.size(), 2u);
  const auto& edges = std::get<EdgeSprings>(potentials[0]);
  EXPECT_EQ(edges.stiffness, van_gelder_stiffness(body.mesh, body.positions, 30.0, 0.1));
  EXPECT_EQ(edges.rest_length, edge_lengths(body.mesh, body.positions));
  EXPECT_EQ(std::get<Bending>(potentials[1]).stiffness,
            hinge_stiffness(body.mesh, body.positions, bending_modulus(30.0, 0.1, 0.2)));

  config.potentials.edge = EdgeConfig{7.0, 1.0};
  config.potentials.bending = BendingConfig{3.0, ReferenceAngle::initial};
  const auto given = body_of(config);
  ASSERT_EQ(given.potentials.potentials().size(), 2u);
  EXPECT_EQ(std::get<EdgeSprings>(given.potentials.potentials()[0]).stiffness[3], 7.0);
  EXPECT_EQ(std::get<Bending>(given.potentials.potentials()[1]).stiffness[3], 3.0);

  config.potentials.edge.reset();
  config.potentials.membrane = MembraneConfig{MembraneLaw::skalak, 2.0, 5.0};
  const auto membrane = body_of(config);
  ASSERT_EQ(membrane.potentials.potentials().size(), 2u);
  EXPECT_EQ(std::get<Skalak>(std::get<Membrane>(membrane.potentials.potentials()[0]).law).ratio, 5.0);
}

TEST(MakeBody, PinsAndAttachesItsSelections) {
  BodyConfig config;
  config.name = "flag";
  config.surface = PlateSurface{{2, 1}, 0.25};
  config.selections.resize(2);
  config.selections[0].name = "pole";
  config.selections[0].plane = {{-1, 0, 0}, {1, 0, 0}, PlaneSide::on, {}};
  config.selections[1].name = "tip";
  config.selections[1].plane = {{1, 0, 0}, {1, 0, 0}, PlaneSide::on, {}};
  config.pinned = {"pole"};
  config.tethers = {{"t", "tip", 2.0, 0.5}};
  config.cords = {{"across", "tip", "pole", {}, CordEnds::each, 1.0, {}, 0.5},
                  {"up", "tip", "", Vec3{1, 0, 3}, CordEnds::middle, 1.0, 2.5, 1.0}};
  config.pulls = {{"p", "tip", {0, 0, 1}}};
  const auto body = body_of(config);
  std::size_t n_pole = 0, n_tip = 0;
  for (std::size_t v = 0; v < body.positions.size(); ++v) {
    EXPECT_EQ(body.is_pinned(v), body.positions[v].x < -1 + 1e-9);
    n_pole += body.is_pinned(v) ? 1 : 0;
    n_tip += body.positions[v].x > 1 - 1e-9 ? 1 : 0;
  }
  ASSERT_GE(n_pole, 4u);
  EXPECT_EQ(body.attachments.tethers->size(), n_tip);
  ASSERT_EQ(body.attachments.cords->size(), n_tip + 1);
  for (std::size_t n = 0; n < n_tip; ++n) {
    const auto& cord = (*body.attachments.cords)[n];
    const Vec3 across = body.positions[cord.to[0]] - body.positions[cord.from[0]];
    EXPECT_NEAR(cord.rest_length, 0.5 * norm(across), 1e-15);
    EXPECT_NEAR(across.x, -2, 1e-12);
    EXPECT_LT(std::abs(across.y), 0.15) << "the nearest";
  }
  EXPECT_EQ(body.attachments.cords->back().from.size(), n_tip);
  EXPECT_EQ(body.attachments.cords->back().rest_length, 2.5);
  EXPECT_EQ(body.attachments.pulls->front().vertices.size(), n_tip);
}

TEST(LoadShape, RefusesAMissingFile) {
  auto config = drop();
  config.surface = FileSurface{"no-such-file.gts", 1.0};
  EXPECT_THROW(load_shape(config, "."), InputError);
}

}  // namespace
}  // namespace pliant
