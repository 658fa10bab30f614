#include <gtest/gtest.h>

#include "mpi/against_one_rank.hpp"

// A three-dimensional flow after 20 steps on all ranks against the same run on one rank: each rank computes the whole
// box by itself as well and compares its slab.
namespace pliant::test {
namespace {

double largest_relative_difference(const BoundaryConfig& sides, ViscousMode mode, StretchingConfig stretching) {
  BoxConfig box;
  box.cells = {24, 18, 17};
  box.size = {1.5, 1, 1.2};
  box.stretching_z = stretching;
  InitialConfig initial;
  initial.flow = InitialFlow::perturbed;
  initial.velocity = {0.4, 0.1, -0.2};
  FlowParameters parameters;
  parameters.viscosity = 2e-3;
  parameters.viscous = mode;
  parameters.boundary = sides;

  const Grid shared_grid(box, sides, Communicator()), own_grid(box, sides, Communicator(MPI_COMM_SELF));
  FlowSolver shared(shared_grid, parameters), own(own_grid, parameters);
  for (FlowSolver* solver : {&shared, &own}) {
    set_initial_flow(*solver, initial);
    for (int n = 0; n < 20; ++n) solver->advance(5e-3);
  }
  const auto [difference, scale] = against_one_rank(shared, own);
  return difference / scale;
}

TEST(RankIndependence, SlabsGiveTheResultOfOneRank) {
  BoundaryConfig along_x = walls_along(2), along_z = walls_along(1);
  along_x[0] = InflowSide{{1, 0, 0}, InflowProfile::parabolic, 0.05};
  along_x[1] = OutflowSide{};
  along_z[5] = InflowSide{{0.2, 0, -1}};
  along_z[4] = OutflowSide{};
  const BoundaryConfig boxes[] = {
      periodic_box(), walls_along(2, {-0.5, 0, 0}, {0.5, 0, 0}), walls_along(0), walls_along(1), along_x, along_z};
  for (const auto& sides : boxes)
    for (ViscousMode mode : viscous_modes)
      for (StretchingLaw law : {StretchingLaw::uniform, StretchingLaw::tanh})
        EXPECT_LT(largest_relative_difference(sides, mode, {law, 1.0}), 1e-11) << "mode " << static_cast<int>(mode);
}

}  // namespace
}  // namespace pliant::test
