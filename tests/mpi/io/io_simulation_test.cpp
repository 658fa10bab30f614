#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <csignal>
#include <fstream>

#include "config/value_codec.hpp"
#include "core/error.hpp"
#include "mpi/coupling/small_cases.hpp"
#include "mpi/io/shared_folder.hpp"
#include "unit/io/text_of.hpp"

namespace pliant {
namespace {

namespace fs = std::filesystem;

long count_lines(const fs::path& path) {
  const auto text = text_of(path);
  return std::count(text.begin(), text.end(), '\n');
}

std::string status_of(const fs::path& folder) { return Json::parse(text_of(folder / "run.json"))["status"]; }

// A drop in a disturbed shear flow on a small, stretched grid.
CaseConfig drop_in_shear() {
  CaseConfig config;
  config.box.size = {4, 4, 4};
  config.box.origin = {-2, -2, -2};
  config.box.cells = {12, 10, 9};
  config.box.stretching_z = {StretchingLaw::tanh, 1.2};
  config.boundary[4] = WallSide{{-2, 0, 0}};
  config.boundary[5] = WallSide{{2, 0, 0}};
  config.initial.flow = InitialFlow::perturbed;
  config.initial.amplitude = 2;  // enough to carry the drop along before the walls are felt
  config.fluid.viscosity = 0.2;
  config.time.end = 0.6;
  config.time.cfl = 0.4;
  config.bodies = {drop({}, 1.0)};
  config.output.history.every = 1;
  config.output.fields.interval = 0.2;
  config.output.surfaces.interval = 0.2;
  return config;
}

TEST(Simulation, MovesTheSameDropOnAnyNumberOfRanks) {
  const auto config = drop_in_shear();
  const Communicator world, alone(MPI_COMM_SELF);
  const SharedFolder owner;
  Simulation shared(config, world, silent(owner.path() / "shared"));
  const auto together = shared.run();
  Simulation own(config, alone, silent(owner.path() / ("alone-" + std::to_string(world.rank()))));
  const auto single = own.run();
  EXPECT_EQ(together.end, RunEnd::end_time);
  EXPECT_EQ(together.time, 0.6);
  EXPECT_EQ(together.steps, single.steps);
  EXPECT_GT(together.steps, 5);
  const auto a = all_vertices(shared.bodies()), b = all_vertices(own.bodies());
  ASSERT_EQ(a.size(), b.size());
  const auto& reference = own.bodies().own()[0].surface.reference;
  double moved = 0;
  for (std::size_t n = 0; n < 3 * reference.size(); ++n)
    moved = std::max(moved, std::abs(a[n] - reference[n / 3][static_cast<int>(n % 3)]));
  for (std::size_t n = 0; n < 6 * reference.size(); ++n) EXPECT_LT(std::abs(a[n] - b[n]), 1e-11);
  EXPECT_GT(moved, 0.1) << "a drop that rests proves nothing";
}

TEST(Simulation, LeavesItsFilesAtTheTimesAsked) {
  const SharedFolder owner;
  const auto folder = owner.path() / "run";
  Simulation simulation(drop_in_shear(), Communicator(), silent(folder));
  std::vector<long> steps;
  const auto result = simulation.run([&](const Simulation& now) { steps.push_back(now.step()); });
  ASSERT_EQ(static_cast<long>(steps.size()), result.steps + 1) << "seen at the start and after every step";
  if (!Communicator().is_root()) return;
  EXPECT_EQ(status_of(folder), "finished");
  EXPECT_EQ(count_lines(folder / "history.csv"), result.steps + 2);
  EXPECT_EQ(count_lines(folder / "bodies/drop.csv"), result.steps + 2);
  for (const char* series : {"fields.xdmf", "drop.xdmf"}) {
    const auto text = text_of(folder / series);
    std::vector<double> times;
    for (auto at = text.find("<Time Value=\""); at != std::string::npos; at = text.find("<Time Value=\"", at + 1))
      times.push_back(std::stod(text.substr(at + 13)));
    ASSERT_EQ(times.size(), 4u) << series;
    for (int n = 0; n < 4; ++n) EXPECT_NEAR(times[static_cast<std::size_t>(n)], 0.2 * n, 1e-12);
  }
  for (const auto& entry : fs::recursive_directory_iterator(folder)) EXPECT_NE(entry.path().extension(), ".tmp");
}

TEST(Simulation, StopsOnAllRanksWhenOneGetsASignal) {
  const SharedFolder owner;
  const auto folder = owner.path() / "run";
  auto config = drop_in_shear();
  config.time.end = 1000;
  const Communicator ranks;
  Simulation simulation(config, ranks, silent(folder));
  const auto result = simulation.run([&](const Simulation& now) {
    if (now.step() == 3 && ranks.rank() == ranks.size() - 1) std::raise(SIGTERM);
  });
  EXPECT_EQ(result.end, RunEnd::signal);
  EXPECT_EQ(result.signal, SIGTERM);
  EXPECT_EQ(result.exit_code(), 143);
  EXPECT_EQ(result.steps, 4);
  if (ranks.is_root()) { EXPECT_EQ(status_of(folder), "stopped by signal 15"); }
}

TEST(Simulation, SaysWhyTheFlowBlewUpAndKeepsTheEvidence) {
  const SharedFolder owner;
  const auto folder = owner.path() / "run";
  auto config = drop_in_shear();
  config.bodies.clear();
  config.output = {};
  config.initial.amplitude = 5;
  config.fluid.viscosity = 1e-3;
  config.time.step = 0.5;  // a Courant number beyond ten
  config.time.end = 1000;
  Simulation simulation(config, Communicator(), silent(folder));
  try {
    simulation.run();
    FAIL() << "must blow up";
  } catch (const CollectiveError& error) {
    const std::string text = error.what();
    EXPECT_NE(text.find("step "), std::string::npos) << text;
    EXPECT_NE(text.find("flow is not finite"), std::string::npos) << text;
    EXPECT_NE(text.find("time.step"), std::string::npos) << text;
    if (Communicator().is_root()) { EXPECT_EQ(status_of(folder), "failed: " + text); }
  }
  if (Communicator().is_root()) { EXPECT_TRUE(fs::exists(folder / "fields.xdmf")); }
}

TEST(Simulation, NamesTheBodyThatBreaks) {
  const SharedFolder owner;
  const auto folder = owner.path() / "run";
  auto config = drop_in_shear();
  config.bodies[0].substeps = 1;
  config.bodies[0].potentials.edge = EdgeConfig{4e6, 0.5};
  config.bodies[0].traction.form = TractionForm::none;
  Simulation simulation(config, Communicator(), silent(folder));
  try {
    simulation.run();
    FAIL() << "must break";
  } catch (const CollectiveError& error) {
    EXPECT_NE(std::string(error.what()).find("drop"), std::string::npos) << error.what();
  }
  if (Communicator().is_root()) { EXPECT_EQ(status_of(folder).find("failed: step"), 0u); }
}

TEST(Simulation, RefusesAnOutputFolderThatCannotBe) {
  const SharedFolder owner;
  const auto folder = owner.path() / "run";
  if (Communicator().is_root()) std::ofstream(folder) << "a file in the way\n";
  Communicator().barrier();
  EXPECT_THROW(Simulation(drop_in_shear(), Communicator(), silent(folder / "out")), InputError);
}

TEST(Simulation, ClearsWhatAnEarlierRunLeft) {
  const SharedFolder owner;
  const auto folder = owner.path() / "run";
  const Communicator ranks;
  auto config = drop_in_shear();
  config.time.max_steps = 2;
  Simulation(config, ranks, silent(folder)).run();
  if (ranks.is_root()) {
    std::ofstream(folder / "fields/fields_999999.h5") << "stale";
    std::ofstream(folder / "notes.txt") << "mine";
  }
  ranks.barrier();
  const auto result = Simulation(config, ranks, silent(folder)).run();
  EXPECT_EQ(result.end, RunEnd::max_steps);
  EXPECT_EQ(result.steps, 2);
  if (!ranks.is_root()) return;
  EXPECT_FALSE(fs::exists(folder / "fields/fields_999999.h5"));
  EXPECT_TRUE(fs::exists(folder / "notes.txt"));
}

}  // namespace
}  // namespace pliant
