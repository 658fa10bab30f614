#include <gtest/gtest.h>

#include "mpi/coupling/small_cases.hpp"
#include "mpi/io/shared_folder.hpp"

namespace pliant {
namespace {

struct Outcome {
  std::vector<double> flow, vertices, loads;
};

Outcome run(const CaseConfig& config, const Communicator& ranks, const std::filesystem::path& folder) {
  Simulation simulation(config, ranks, silent(folder));
  simulation.run();
  Outcome outcome{whole_flow(simulation.flow()), all_vertices(simulation.bodies()), {}};
  for (const Vec3 f : all_vectors(simulation.bodies(), [](const Body& b) { return b.loads.balance.force; }))
    outcome.loads.insert(outcome.loads.end(), {f.x, f.y, f.z});
  return outcome;
}

CaseConfig twenty_steps(CouplingKind coupling, StrongScheme scheme = StrongScheme::automatic) {
  auto config = all_motions();
  config.time.max_steps = 20;
  config.coupling.scheme = scheme;
  for (auto& body : config.bodies)
    if (body.motion == MotionKind::rigid || body.motion == MotionKind::hinge) body.coupling = coupling;
  return config;
}

void expect_same_on_any_ranks(const CaseConfig& config) {
  const Communicator world, alone(MPI_COMM_SELF);
  const SharedFolder owner;
  const auto together = run(config, world, owner.path() / "together");
  const auto again = run(config, world, owner.path() / "again");
  EXPECT_TRUE(together.flow == again.flow) << "the same bits, run after run";
  EXPECT_TRUE(together.vertices == again.vertices);
  EXPECT_TRUE(together.loads == again.loads);
  const auto single = run(config, alone, owner.path() / ("alone-" + std::to_string(world.rank())));
  EXPECT_LT(relative_difference(together.flow, single.flow), 1e-11);
  EXPECT_LT(relative_difference(together.vertices, single.vertices), 1e-11);
  EXPECT_LT(relative_difference(together.loads, single.loads), 1e-11);
}

TEST(AllMotions, LooseCouplingIsTheSameOnAnyNumberOfRanks) {
  expect_same_on_any_ranks(twenty_steps(CouplingKind::loose));
}

TEST(AllMotions, AitkenIsTheSameOnAnyNumberOfRanks) { expect_same_on_any_ranks(twenty_steps(CouplingKind::strong)); }

TEST(AllMotions, HammingIsTheSameOnAnyNumberOfRanks) {
  expect_same_on_any_ranks(twenty_steps(CouplingKind::strong, StrongScheme::hamming));
}

// With the drop, which looks at the flow after every step, and without it.
TEST(AllMotions, FusedSweepsAreThePlainOnesWithBodies) {
  const SharedFolder owner;
  for (const bool with_drop : {true, false}) {
    auto config = twenty_steps(CouplingKind::loose);
    if (!with_drop) config.bodies.pop_back();
    const auto fused = run(config, Communicator(), owner.path() / "fused");
    config.time.sweeps = Sweeps::plain;
    const auto plain = run(config, Communicator(), owner.path() / "plain");
    EXPECT_LT(relative_difference(fused.flow, plain.flow), 1e-11);
    EXPECT_LT(relative_difference(fused.vertices, plain.vertices), 1e-11);
    EXPECT_LT(relative_difference(fused.loads, plain.loads), 1e-11);
  }
}

TEST(AllMotions, EveryBodyMovesAsItIsToldOrFree) {
  const SharedFolder owner;
  auto config = twenty_steps(CouplingKind::loose);
  Simulation simulation(config, Communicator(), silent(owner.path()));
  const auto centers = [&] { return all_vectors(simulation.bodies(), [](const Body& b) { return b.pose.center; }); };
  const auto before = centers();
  const auto vertices_before = all_vertices(simulation.bodies());
  simulation.run();
  const auto after = centers();
  const double t = simulation.time();
  EXPECT_NEAR(t, 0.4, 1e-12);
  EXPECT_EQ(before[0], after[0]) << "the rock stays";
  EXPECT_LT(norm(after[1] - before[1] - Vec3{0.2 * std::sin(3 * t), 0, t}), 1e-12);
  EXPECT_LT(after[2].z - before[2].z, -0.5) << "thrown down, and falls";
  const auto turns = all_vectors(simulation.bodies(), [](const Body& b) {
    return Vec3{b.hinge.angle, b.hinge.rate, 0};
  });
  EXPECT_GT(turns[3].x, 0.05) << "the leaflet swings";
  EXPECT_LE(turns[3].x, 20 * 3.14159265358979 / 180 + 1e-12) << "between its stops";
  EXPECT_GT(relative_difference(all_vertices(simulation.bodies()), vertices_before), 0.05);
}

}  // namespace
}  // namespace pliant
