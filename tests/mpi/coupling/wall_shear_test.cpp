#include <gtest/gtest.h>

#include "mpi/coupling/small_cases.hpp"
#include "mpi/io/shared_folder.hpp"
#include "simulation/surface_batch.hpp"

namespace pliant {
namespace {

/// Couette flow, and a sheet where it is at rest, which changes nothing.
CaseConfig sheet_in_couette_flow(MotionKind motion, CouplingKind coupling) {
  auto config = small_box({12, 12, 13});
  config.boundary[4] = WallSide{{-1, 0, 0}};
  config.boundary[5] = WallSide{{1, 0, 0}};
  config.initial.flow = InitialFlow::couette;
  config.time.step.reset();
  config.time.cfl = 0.1;
  config.time.max_steps = 4;
  BodyConfig sheet;
  sheet.name = "sheet";
  sheet.surface = PlateSurface{{2, 2}, 0.25};
  sheet.motion = motion;
  sheet.coupling = coupling;
  if (motion == MotionKind::deformable) {
    sheet.material.thickness = 0.05;
    sheet.material.density = 20;
    sheet.material.young = 10;
    SelectionConfig all;
    all.name = "all";
    all.border = true;
    sheet.selections = {all};
    sheet.pinned = {"all"};
  }
  config.bodies = {sheet};
  return config;
}

// mu dU/dz on the side that looks up, and against it on the other one.
TEST(WallShear, OfASheetInCouetteFlowIsExactForEveryCoupling) {
  const SharedFolder owner;
  const Communicator ranks;
  int n = 0;
  const std::pair<MotionKind, CouplingKind> kinds[] = {
      {MotionKind::fixed, CouplingKind::automatic},       {MotionKind::prescribed, CouplingKind::automatic},
      {MotionKind::deformable, CouplingKind::loose},      {MotionKind::deformable, CouplingKind::strong},
      {MotionKind::deformable, CouplingKind::local_mass}, {MotionKind::deformable, CouplingKind::force_spreading}};
  for (const auto& [motion, coupling] : kinds) {
    const auto what = word_for(motion) + " " + word_for(coupling);
    const auto config = sheet_in_couette_flow(motion, coupling);
    Simulation simulation(config, ranks, silent(owner.path() / std::to_string(n++)));
    simulation.run();
    const auto batch = surface_batch(simulation.bodies(), 0);
    const double expected = config.fluid.viscosity * 2 / config.box.size.z;
    int found = 0;
    for (const auto& set : batch.sets) {
      if (set.name != "shear" && set.name != "inner_shear") continue;
      ++found;
      const double sign = set.name == "shear" ? 1 : -1;
      EXPECT_EQ(set.center, SurfaceCenter::face);
      for (std::size_t f = 0; f < set.values.size(); f += 3) {
        EXPECT_NEAR(set.values[f], sign * expected, 1e-9) << what;
        EXPECT_NEAR(set.values[f + 1], 0, 1e-9) << what;
        EXPECT_NEAR(set.values[f + 2], 0, 1e-9) << what;
      }
    }
    EXPECT_EQ(found, 2) << what;
  }
}

}  // namespace
}  // namespace pliant
