#include <gtest/gtest.h>

#include "config/value_codec.hpp"
#include "mpi/io/shared_folder.hpp"
#include "simulation/ejection.hpp"
#include "simulation/simulation.hpp"
#include "unit/io/text_of.hpp"

// A soft tube from wall to wall, squeezed by what a patch beside it lets into the box, and emptied through a patch at
// its end: its volume must change as the fluid is pushed.
namespace pliant {
namespace {

CaseConfig pumped_tube(int cells) {
  CaseConfig config;
  config.box.size = {2, 2, 1};
  config.box.origin = {-1, -1, 0};
  config.box.cells = {cells, cells, cells / 2};
  config.fluid.viscosity = 0.01;
  SignalConfig beat;
  beat.formula = "sin(2*pi*t)";
  beat.period = 1;
  config.signals["beat"] = beat;
  PatchConfig piston, out;
  piston.name = "piston";
  piston.shape = PatchShape::outside;
  piston.radius = 0.75;
  piston.flow_rate = "beat";
  out.name = "out";
  out.radius = 0.45;
  out.balance = true;
  config.boundary[4] = WallSide{{}, {piston}};
  config.boundary[5] = WallSide{{}, {out}};
  config.time.end = 1;
  config.time.max_step = 0.01;
  config.time.cfl = 0.4;
  BodyConfig tube;
  tube.name = "tube";
  tube.surface = CylinderSurface{0.6, 1, 1.92 / cells, CylinderEnds::open};
  tube.center = {0, 0, 0.5};
  tube.coupling = CouplingKind::force_spreading;
  tube.material.thickness = 0.02;
  tube.material.density = 1;
  tube.material.young = 20;
  SelectionConfig rims;
  rims.name = "rims";
  rims.border = true;
  tube.selections = {rims};
  tube.pinned = {"rims"};
  config.bodies = {tube};
  CavityConfig inside;
  inside.name = "inside";
  inside.body = "tube";
  inside.flow = "beat";
  inside.flow_factor = -1;
  inside.ejection_fraction = 0.15;
  config.cavities = {inside};
  config.output.history.every = 2;
  config.checkpoint.keep = 0;
  return config;
}

struct Cycle {
  double ejection_fraction, largest_difference;
};

Cycle pump(int cells) {
  auto config = pumped_tube(cells);
  set_ejection_scales(config, place_bodies(config));
  const SharedFolder owner;
  SimulationOptions options;
  options.output = owner.path();
  options.progress = ProgressStyle::silent;
  Simulation(config, Communicator(), options).run();
  const auto cycle = Json::parse(text_of(owner.path() / "run.json"))["results"]["cavities"]["inside"][0];
  return {cycle["ejection_fraction"], cycle["largest_difference"]};
}

// What slips past the wall goes down with the spacing.
TEST(PumpedTube, VolumeFollowsTheFlowThatIsPushed) {
  const auto coarse = pump(24), fine = pump(48);
  EXPECT_LT(fine.largest_difference, 0.02);
  EXPECT_LT(fine.largest_difference, 0.5 * coarse.largest_difference);
  EXPECT_NEAR(fine.ejection_fraction, 0.15, 0.002);
  EXPECT_LT(0.15 - fine.ejection_fraction, 0.5 * (0.15 - coarse.ejection_fraction));
}

}  // namespace
}  // namespace pliant
