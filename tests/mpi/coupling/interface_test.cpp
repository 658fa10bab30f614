#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "mesh/geometry.hpp"
#include "mpi/coupling/small_cases.hpp"
#include "mpi/io/shared_folder.hpp"

// A liquid interface in a flow that feels it.
namespace pliant {
namespace {

constexpr double radius = 0.8;

CaseConfig with_drop(double sigma) {
  auto config = small_box({20, 20, 20});
  config.fluid.viscosity = 0.01;
  auto body = ball("drop", MotionKind::deformable, {0.03, -0.02, 0.01}, radius);
  body.surface = SphereSurface{8, radius};
  body.coupling = CouplingKind::force_spreading;
  body.potentials.surface_tension = SurfaceTensionConfig{sigma, 0};
  config.bodies = {body};
  return config;
}

Vec3 centroid(const Bodies& bodies) {
  return all_vectors(
      bodies, [](const Body& body) { return enclosed_moments(body.surface.mesh, body.surface.positions).centroid; })[0];
}

TEST(Interface, ADropAtRestDoesNotStirTheFluid) {
  const SharedFolder owner;
  auto config = with_drop(1);
  config.time.max_steps = 50;
  Simulation simulation(config, Communicator(), silent(owner.path() / "run"));
  simulation.run();
  // Less than the inside has at a hundredth of sqrt(sigma / (rho R)), the speed that the tension could give.
  const double speed = 1e-2 * std::sqrt(1 / radius);
  const double volume = 4 * std::numbers::pi / 3 * std::pow(radius, 3);
  EXPECT_LT(simulation.flow().kinetic_energy(), 0.5 * volume * speed * speed);
}

TEST(Interface, AHeldDropStaysWhereItIsInAStream) {
  const SharedFolder owner;
  auto config = with_drop(4);
  config.initial.flow = InitialFlow::uniform;
  config.initial.velocity = {1, 0, 0};
  config.bodies[0].held = true;
  config.time.max_steps = 60;
  Simulation simulation(config, Communicator(), silent(owner.path() / "run"));
  const Vec3 start = centroid(simulation.bodies());
  simulation.run();
  EXPECT_GT(simulation.time(), 0.4);
  EXPECT_LT(norm(centroid(simulation.bodies()) - start), 0.02 * radius);
  const Vec3 force = all_vectors(simulation.bodies(), [](const Body& body) { return body.loads.balance.force; })[0];
  EXPECT_GT(force.x, 0);
  EXPECT_LT(std::hypot(force.y, force.z), 0.1 * force.x);
}

TEST(Interface, AFreeDropDriftsWithTheStream) {
  const SharedFolder owner;
  auto config = with_drop(4);
  config.initial.flow = InitialFlow::uniform;
  config.initial.velocity = {1, 0.3, -0.2};
  config.time.max_steps = 30;
  Simulation simulation(config, Communicator(), silent(owner.path() / "run"));
  const Vec3 start = centroid(simulation.bodies());
  simulation.run();
  const Vec3 way = centroid(simulation.bodies()) - start;
  EXPECT_LT(norm(way - simulation.time() * config.initial.velocity), 1e-3 * norm(way));
}

}  // namespace
}  // namespace pliant
