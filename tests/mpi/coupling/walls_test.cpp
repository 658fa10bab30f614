#include <gtest/gtest.h>

#include "mpi/coupling/small_cases.hpp"
#include "mpi/io/shared_folder.hpp"

// Surfaces that part a periodic box in two: walls under a load that lasts, and membranes under an even pressure.
namespace pliant {
namespace {

CaseConfig driven_along_z() {
  auto config = small_box({12, 12, 14});
  config.forcing.acceleration = {0, 0, 1};
  config.time.max_steps = 60;
  return config;
}

/// A plate across the box, in between two planes of the grid.
BodyConfig partition(MotionKind motion) {
  auto body = ball("partition", motion, {0, 0, 0.1}, 1);
  body.surface = PlateSurface{{4, 4}, 0.25};
  return body;
}

double largest(const std::vector<double>& values) {
  double most = 0;
  for (double v : values) most = std::max(most, std::abs(v));
  return most;
}

/// Mean velocity along z at the end.
double leak(const CaseConfig& config, const std::filesystem::path& folder) {
  Simulation simulation(config, Communicator(), silent(folder));
  simulation.run();
  return std::abs(simulation.flow().bulk_velocity().z);
}

TEST(Walls, DoNotLeakUnderALoadThatLasts) {
  const SharedFolder owner;
  auto config = driven_along_z();
  config.bodies = {partition(MotionKind::fixed)};
  config.bodies[0].marker_refinement = 2;
  config.immersed_boundary.carry_forces = true;
  const double carried = leak(config, owner.path() / "carried");
  config.immersed_boundary.carry_forces = false;
  const double forgotten = leak(config, owner.path() / "forgotten");
  // Each substep accelerates the fluid by about the step; what one comparison of velocities leaves of it passes.
  EXPECT_GT(forgotten, 1e-2 * *config.time.step);
  EXPECT_LT(carried, 1e-3 * forgotten);
}

TEST(Walls, AreTheSameOnAnyNumberOfRanksAndByBothSweeps) {
  const SharedFolder owner;
  auto config = driven_along_z();
  config.time.max_steps = 10;
  config.immersed_boundary.carry_forces = true;
  config.bodies = {partition(MotionKind::fixed), ball("stone", MotionKind::fixed, {1, 1, -1.2}, 0.5)};
  Simulation alone(config, Communicator(MPI_COMM_SELF),
                   silent(owner.path() / ("alone-" + std::to_string(Communicator().rank()))));
  alone.run();
  config.time.sweeps = Sweeps::plain;
  Simulation together(config, Communicator(), silent(owner.path() / "together"));
  together.run();
  const auto one = whole_flow(alone.flow()), all = whole_flow(together.flow());
  ASSERT_EQ(one.size(), all.size());
  for (std::size_t i = 0; i < one.size(); ++i) ASSERT_NEAR(one[i], all[i], 1e-11) << i;
}

TEST(Membranes, ThatSeparateLeaveAFluidAtRestUnderAnEvenPressure) {
  const SharedFolder owner;
  for (const auto coupling : {CouplingKind::force_spreading, CouplingKind::local_mass}) {
    auto config = small_box({12, 12, 14});
    config.time.max_steps = 10;
    auto membrane = partition(MotionKind::deformable);
    membrane.coupling = coupling;
    membrane.mass_per_vertex = 0.01;
    membrane.potentials.edge = EdgeConfig{1, 1.0};
    membrane.potentials.pressure = PressureConfig{3};
    membrane.selections.resize(1);
    membrane.selections[0].name = "rim";
    membrane.selections[0].border = true;
    membrane.pinned = {"rim"};
    for (const bool separates : {true, false}) {
      membrane.separates = separates;
      config.bodies = {membrane};
      Simulation simulation(config, Communicator(), silent(owner.path() / (separates ? "with" : "without")));
      simulation.run();
      const double moved = largest(whole_flow(simulation.flow()));
      if (separates) EXPECT_LT(moved, 1e-12);
      else EXPECT_GT(moved, 1e-3);
    }
  }
}

TEST(Contact, PassesOverBodiesThatAreToldNotToTakePart) {
  const SharedFolder owner;
  auto config = small_box({12, 12, 14});
  config.initial.flow = InitialFlow::perturbed;
  config.initial.amplitude = 0.5;
  config.time.max_steps = 8;
  auto soft = drop({0, 0, 0.1}, 0.6);
  soft.coupling = CouplingKind::force_spreading;
  config.bodies = {soft, ball("stone", MotionKind::rigid, {1.15, 0, 0.1}, 0.5)};
  config.bodies[1].material.density = 3;
  const auto run = [&](const char* name) {
    Simulation simulation(config, Communicator(), silent(owner.path() / name));
    simulation.run();
    return whole_flow(simulation.flow());
  };
  const auto without = run("without");
  config.repulsion.range = 0.25;
  config.repulsion.strength = 5;
  const auto touching = run("touching");
  for (auto& body : config.bodies) body.contact = false;
  EXPECT_TRUE(run("aloof") == without);
  EXPECT_FALSE(touching == without);
}

}  // namespace
}  // namespace pliant
