#include <gtest/gtest.h>

#include "mpi/coupling/small_cases.hpp"
#include "mpi/io/shared_folder.hpp"

// Bodies that are driven at each other, or at a wall, are turned back before they touch.
namespace pliant {
namespace {

constexpr double radius = 0.4;

CaseConfig quiet_box() {
  auto config = small_box({20, 20, 20});
  config.fluid.viscosity = 0.01;
  config.time.step = 0.01;
  // The pressure over the area within range stops a ball of this mass and speed well before it touches.
  config.repulsion = {0.2, 200};
  return config;
}

BodyConfig thrown(const std::string& name, Vec3 center, Vec3 velocity) {
  auto body = ball(name, MotionKind::rigid, center, radius);
  body.surface = SphereSurface{4, radius};  // vertices closer than the gap
  body.material.density = 5;
  body.rigid.velocity = velocity;
  return body;
}

struct Track {
  std::vector<std::vector<Vec3>> centers, velocities;  // by step, by body
  std::vector<double> vertices;                        // in the end
};

Track track(const CaseConfig& config, const Communicator& ranks, const std::filesystem::path& folder) {
  Track seen;
  Simulation simulation(config, ranks, silent(folder));
  simulation.run([&](const Simulation& now) {
    seen.centers.push_back(all_vectors(now.bodies(), [](const Body& b) { return b.pose.center; }));
    seen.velocities.push_back(all_vectors(now.bodies(), [](const Body& b) { return b.pose.velocity; }));
  });
  seen.vertices = all_vertices(simulation.bodies());
  return seen;
}

/// Two balls on the axis z about `middle`; their images if they are beyond a periodic side.
void expect_collision(double middle) {
  const SharedFolder owner;
  const Communicator world, alone(MPI_COMM_SELF);
  auto config = quiet_box();
  const double lower = middle - 0.55, upper = middle + 0.55 > 2 ? middle + 0.55 - 4 : middle + 0.55;
  const double period = middle + 0.55 > 2 ? 4 : 0;
  config.bodies = {thrown("lower", {0.1, 0, lower}, {0, 0, 1}), thrown("upper", {-0.1, 0, upper}, {0, 0, -1})};

  config.time.max_steps = 20;
  const auto together = track(config, world, owner.path() / "together");
  const auto single = track(config, alone, owner.path() / ("alone-" + std::to_string(world.rank())));
  EXPECT_LT(relative_difference(together.vertices, single.vertices), 1e-11);

  config.time.max_steps = 70;
  const auto whole = track(config, world, owner.path() / "whole");
  double nearest = 10;
  for (const auto& centers : whole.centers)
    nearest = std::min(nearest, norm(centers[1] + Vec3{0, 0, period} - centers[0]));
  EXPECT_GT(nearest, 2 * radius) << "they do not overlap";
  EXPECT_LT(nearest, 2 * radius + 0.2) << "they have met";
  const auto& last = whole.velocities.back();
  EXPECT_LT(last[0].z, -0.1) << "turned back";
  EXPECT_GT(last[1].z, 0.1);
  // The collision is not central; by symmetry they move as mirror images, as far as the grid lets them.
  EXPECT_NEAR(last[0].z, -last[1].z, 0.05);
  EXPECT_NEAR(last[0].x, -last[1].x, 0.05);
  EXPECT_GT(last[0].x, 0.01) << "the one at the side of positive x goes there";
}

TEST(Contact, TwoBallsTurnEachOtherBack) { expect_collision(0); }
TEST(Contact, AcrossAPeriodicSide) { expect_collision(2); }
TEST(Contact, WithinOneOfSeveralSlabs) { expect_collision(-1.1); }

TEST(Contact, ForcesOnTheTwoAreOppositeToRoundOff) {
  const SharedFolder owner;
  auto config = quiet_box();
  config.bodies = {thrown("lower", {0.1, 0, -0.45}, {0, 0, 1}), thrown("upper", {-0.1, 0, 0.45}, {0, 0, -1})};
  config.time.max_steps = 1;
  Simulation simulation(config, Communicator(), silent(owner.path()));
  simulation.run();
  const auto forces = all_vectors(simulation.bodies(), [](const Body& b) { return b.loads.contact.force; });
  EXPECT_LT(forces[0].z, -0.1);
  EXPECT_LT(norm(forces[0] + forces[1]), 1e-12 * norm(forces[0]));
}

TEST(Contact, AWallTurnsABallBack) {
  const SharedFolder owner;
  const Communicator world, alone(MPI_COMM_SELF);
  for (const int d : {0, 2}) {
    auto config = quiet_box();
    put_walls(config, d);
    Vec3 center, velocity;
    center[d] = 1.3;
    velocity[d] = 1.5;
    config.bodies = {thrown("ball", center, velocity)};
    config.time.max_steps = 60;
    const auto folder = owner.path() / std::to_string(d);
    const auto seen = track(config, world, folder / "together");
    double farthest = -10;
    for (const auto& centers : seen.centers) farthest = std::max(farthest, centers[0][d]);
    EXPECT_LT(farthest, 2 - radius) << "does not touch";
    EXPECT_GT(farthest, 2 - radius - 0.2) << "has met the wall";
    EXPECT_LT(seen.velocities.back()[0][d], -0.1) << "turned back";
    config.time.max_steps = 20;
    const auto first = track(config, world, folder / "first");
    const auto single = track(config, alone, folder / ("alone-" + std::to_string(world.rank())));
    EXPECT_LT(relative_difference(first.vertices, single.vertices), 1e-11);
  }
}

// Bodies that the flow does not feel have a pass of contact of their own, after those that act on it.
TEST(Contact, ADeformableBodyPressesOnARigidOneWhereAnotherIsOneWay) {
  const SharedFolder owner;
  auto config = quiet_box();
  config.repulsion.range = 0.15;
  auto cushion = drop({0, 0, -0.45}, radius);
  cushion.name = "cushion";
  cushion.coupling = CouplingKind::force_spreading;
  config.bodies = {thrown("stone", {0.05, 0, 0.45}, {0, 0, -1}), cushion};
  config.time.max_steps = 12;
  auto with_another = config;
  with_another.bodies.push_back(drop({1.4, 1.4, 1.4}, radius));
  std::vector<std::vector<Vec3>> centers, velocities, presses;
  for (const auto& scene : {config, with_another}) {
    Simulation simulation(scene, Communicator(), silent(owner.path() / std::to_string(centers.size())));
    simulation.run();
    const auto& bodies = simulation.bodies();
    centers.push_back(all_vectors(bodies, [](const Body& b) { return b.pose.center; }));
    velocities.push_back(all_vectors(bodies, [](const Body& b) { return b.pose.velocity; }));
    presses.push_back(all_vectors(bodies, [](const Body& b) { return b.loads.pressed.force; }));
  }
  EXPECT_GT(presses[0][0].z, 0.1) << "they have met";
  EXPECT_LT(norm(presses[1][0] - presses[0][0]), 1e-10 * norm(presses[0][0]));
  EXPECT_LT(norm(velocities[1][0] - velocities[0][0]), 1e-11);
  for (std::size_t b = 0; b < 2; ++b) EXPECT_LT(norm(centers[1][b] - centers[0][b]), 1e-12) << b;
}

}  // namespace
}  // namespace pliant
