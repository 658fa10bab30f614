#include <gtest/gtest.h>
#include <sys/resource.h>

#include <algorithm>
#include <csignal>
#include <fstream>
#include <functional>

#include "config/value_codec.hpp"
#include "core/error.hpp"
#include "mpi/coupling/small_cases.hpp"
#include "mpi/first_ranks.hpp"
#include "mpi/io/shared_folder.hpp"
#include "unit/io/text_of.hpp"

// A run that is interrupted and continued is the run that is not: in all its bits on as many ranks, to round-off on
// another number.
namespace pliant {
namespace {

namespace fs = std::filesystem;

struct NamedCase {
  std::string name;
  CaseConfig config;
};

CaseConfig common_case() {
  CaseConfig config;
  config.box.size = {4, 4, 4};
  config.box.origin = {-2, -2, -2};
  config.box.cells = {10, 8, 9};
  config.box.stretching_z = {StretchingLaw::tanh, 1.2};
  config.initial.flow = InitialFlow::perturbed;
  config.initial.amplitude = 2;
  config.fluid.viscosity = 0.2;
  config.time.end = 100;
  config.time.cfl = 0.4;
  config.output.history.every = 3;
  config.output.fields.interval = 0.3;
  config.output.surfaces.every = 4;
  config.output.period = 0.17;
  config.output.fields.phases = {0.4};
  config.output.fields.vorticity = true;
  config.output.phase_average = PhaseAverageConfig{3, 0.02, 2};
  return config;
}

CavityConfig inside_of(const std::string& body) {
  CavityConfig cavity;
  cavity.name = "inside-" + body;
  cavity.body = body;
  cavity.flow = "0.1*sin(t)";
  cavity.jet = JetConfig{{0, 0, 1}, {0, 0, -1}, 0.2};
  return cavity;
}

BodyConfig drop(std::string name, double x) {
  auto body = drop(Vec3{x, 0, 0}, 0.8);
  body.name = std::move(name);
  return body;
}

// The first has all that a checkpoint holds.
std::vector<NamedCase> cases() {
  auto open = common_case();
  open.initial.amplitude = 1;
  open.boundary[0] = InflowSide{{0.5, 0, 0}, InflowProfile::parabolic, 1.5};
  open.boundary[1] = OutflowSide{};
  open.boundary[4] = open.boundary[5] = WallSide{};
  open.bodies = {drop("one", -1), drop("two", 0)};
  open.cavities = {inside_of("one"), inside_of("two")};
  auto periodic = common_case();
  periodic.time.viscous = ViscousMode::implicit_z;
  periodic.forcing.bulk_velocity = ForcingConfig::BulkVelocity{Axis::x, 1};
  auto channel = common_case();
  channel.boundary[4] = WallSide{{-2, 0, 0}};
  channel.boundary[5] = WallSide{{2, 0, 0}};
  channel.bodies = {drop("one", -1), drop("two", 1)};
  channel.cavities = {inside_of("two")};
  return {{"inflow, outflow and drops", open}, {"periodic", periodic}, {"channel with drops", channel}};
}

SimulationOptions restarted(const fs::path& folder, const fs::path& file = {}) {
  auto options = silent(folder);
  options.restart = RestartRequest{file};
  return options;
}

// Flow and bodies at the end of a run, whole on every rank of the test.
std::vector<double> result_of(const FirstRanks& first, const CaseConfig& config, const SimulationOptions& options) {
  std::vector<double> state;
  if (first.am_in()) try {
      Simulation simulation(config, first.ranks(), options);
      simulation.run();
      const auto flow = whole_flow(simulation.flow()), bodies = all_vertices(simulation.bodies());
      if (first.ranks().is_root()) {
        state = flow;
        state.insert(state.end(), bodies.begin(), bodies.end());
      }
    } catch (const std::exception& error) {
      ADD_FAILURE() << error.what();  // the other ranks of the test wait
    }
  int size = Communicator().max(static_cast<int>(state.size()));
  state.resize(static_cast<std::size_t>(size));
  Communicator().sum(state);
  return state;
}

// Every file of a run but its report, which holds times of the clock, and its checkpoints.
std::map<std::string, std::string> files_of(const fs::path& folder) {
  std::map<std::string, std::string> files;
  for (const auto& entry : fs::recursive_directory_iterator(folder)) {
    const auto name = fs::relative(entry.path(), folder).string();
    if (entry.is_regular_file() && name != "run.json" && name.find("checkpoints/") != 0)
      files[name] = text_of(entry.path());
  }
  return files;
}

void expect_same_files(const fs::path& a, const fs::path& b, const std::string& what) {
  const auto first = files_of(a), second = files_of(b);
  for (const auto& [name, text] : first) {
    EXPECT_TRUE(second.contains(name)) << what << ": " << name << " is missing";
    if (second.contains(name)) { EXPECT_TRUE(second.at(name) == text) << what << ": " << name << " differs"; }
  }
  for (const auto& [name, text] : second) EXPECT_TRUE(first.contains(name)) << what << ": " << name << " is too much";
  const auto results = [](const fs::path& folder) { return Json::parse(text_of(folder / "run.json"))["results"]; };
  EXPECT_EQ(results(a), results(b)) << what;
}

constexpr long steps_before = 5, steps_in_all = 25;

TEST(Restart, ContinuesOnEveryNumberOfRanks) {
  const SharedFolder owner;
  const int n_ranks = Communicator().size();
  for (const auto& [name, config] : cases()) {
    const bool takes_all_pairs = name == cases().front().name;
    for (int n = takes_all_pairs ? 1 : n_ranks; n <= n_ranks; ++n) {
      const auto what = name + " on " + std::to_string(n);
      const auto folder = owner.path() / what;
      const FirstRanks writers(n);
      const auto whole = result_of(writers, until(config, steps_in_all), silent(folder / "whole"));
      result_of(writers, until(config, steps_before), silent(folder / "part"));
      for (int m = 1; m <= n_ranks; ++m) {
        if (!takes_all_pairs && m != 1 && m != n) continue;
        const auto copy = folder / ("from " + std::to_string(m));
        if (Communicator().is_root()) fs::copy(folder / "part", copy, fs::copy_options::recursive);
        Communicator().barrier();
        const FirstRanks readers(m);
        const auto continued = result_of(readers, until(config, steps_in_all), restarted(copy));
        ASSERT_EQ(continued.size(), whole.size());
        if (n == m) {
          EXPECT_TRUE(continued == whole) << what;
          if (Communicator().is_root()) expect_same_files(folder / "whole", copy, what);
          continue;
        }
        double difference = 0;
        for (std::size_t i = 0; i < whole.size(); ++i)
          difference = std::max(difference, std::abs(whole[i] - continued[i]));
        // Round-off of sums in another order, over twenty steps; forces are of order 10.
        EXPECT_LT(difference, 1e-10) << what << ", continued on " << m;
        double flow = 0;
        for (std::size_t i = 0; i < 4 * 720; ++i) flow = std::max(flow, std::abs(whole[i] - continued[i]));
        EXPECT_LT(flow, 1e-11) << what << ", continued on " << m;
      }
    }
  }
}

// A run of a few steps with checkpoints of steps 4 and 6.
CaseConfig short_case() {
  auto config = until(cases()[2].config, 6);
  config.checkpoint.every = 4;
  return config;
}

std::string refusal(const CaseConfig& config, const SimulationOptions& options) {
  try {
    Simulation(config, Communicator(), options);
  } catch (const InputError& error) { return error.what(); }
  return "not refused";
}

TEST(Restart, StartsItsOutputsAnewInAnotherFolder) {
  const SharedFolder owner;
  const auto folder = owner.path() / "run", other = owner.path() / "other";
  Simulation(short_case(), Communicator(), silent(folder)).run();
  const auto before = Communicator().is_root() ? files_of(folder) : std::map<std::string, std::string>();
  Communicator().barrier();
  const auto result = Simulation(until(short_case(), 9), Communicator(),
                                 restarted(other, folder / "checkpoints/step_000006.checkpoint"))
                          .run();
  EXPECT_EQ(result.steps, 9);
  if (!Communicator().is_root()) return;
  EXPECT_TRUE(files_of(folder) == before) << "the run that was branched off is left alone";
  const auto history = text_of(other / "history.csv");
  EXPECT_NE(history.find("\n6,"), std::string::npos);
  EXPECT_NE(history.find("\n9,"), std::string::npos);
  EXPECT_EQ(history.find("\n3,"), std::string::npos);
  const auto report = Json::parse(text_of(other / "run.json"));
  ASSERT_EQ(report["restarts"].size(), 1u);
  EXPECT_EQ(report["restarts"][0]["step"], 6);
}

TEST(Restart, DoesNotClearAnotherRunForACheckpointFromElsewhere) {
  const SharedFolder owner;
  const auto folder = owner.path() / "run", copy = owner.path() / "copy.checkpoint";
  Simulation(short_case(), Communicator(), silent(folder)).run();
  if (Communicator().is_root()) fs::copy_file(folder / "checkpoints/step_000004.checkpoint", copy);
  Communicator().barrier();
  const auto text = refusal(short_case(), restarted(folder, copy));
  EXPECT_NE(text.find(folder.string() + " holds a run"), std::string::npos) << text;
  EXPECT_EQ(Simulation(short_case(), Communicator(), restarted(folder)).step(), 6);
}

TEST(Restart, KeepsTheNewestCheckpoints) {
  const SharedFolder owner;
  auto config = until(cases()[1].config, 11);
  config.checkpoint.every = 2;
  config.checkpoint.keep = 3;
  Simulation(config, Communicator(), silent(owner.path() / "run")).run();
  config.checkpoint.keep = 0;
  Simulation(config, Communicator(), silent(owner.path() / "none")).run();
  if (!Communicator().is_root()) return;
  std::vector<std::string> names;
  for (const auto& entry : fs::directory_iterator(owner.path() / "run/checkpoints"))
    names.push_back(entry.path().filename());
  std::sort(names.begin(), names.end());
  EXPECT_EQ(names,
            (std::vector<std::string>{"step_000008.checkpoint", "step_000010.checkpoint", "step_000011.checkpoint"}));
  EXPECT_FALSE(fs::exists(owner.path() / "none/checkpoints"));
}

TEST(Restart, WritesACheckpointWhenTheMinutesArePast) {
  const SharedFolder owner;
  auto config = until(cases()[1].config, 5);
  config.checkpoint.minutes = 1e-9;
  config.checkpoint.keep = 100;
  Simulation(config, Communicator(), silent(owner.path())).run();
  for (const char* step : {"1", "2", "3", "4", "5"})
    EXPECT_TRUE(fs::exists(owner.path() / ("checkpoints/step_00000" + std::string(step) + ".checkpoint"))) << step;
}

// Does something to a copy of a checkpoint on the root and tells whether any rank still takes it.
bool is_taken(const fs::path& good, const fs::path& copy, const std::function<void()>& damage) {
  const Communicator ranks;
  if (ranks.is_root()) {
    fs::copy_file(good, copy, fs::copy_options::overwrite_existing);
    damage();
  }
  ranks.barrier();
  bool taken = true;
  try {
    CheckpointReader reader(copy, ranks);
    reader.verify();
  } catch (const CheckpointRefused&) { taken = false; }
  EXPECT_EQ(ranks.sum(taken ? 1L : 0L), taken ? ranks.size() : 0) << "all ranks say the same";
  return taken;
}

TEST(Restart, NoticesEveryDamagedByte) {
  const SharedFolder owner;
  const auto folder = owner.path() / "run", copy = owner.path() / "copy.checkpoint";
  Simulation(short_case(), Communicator(), silent(folder)).run();
  const auto good = folder / "checkpoints/step_000006.checkpoint";
  const auto size = fs::file_size(good);
  EXPECT_TRUE(is_taken(good, copy, [] {}));
  const auto flip = [&](std::uintmax_t at) {
    std::fstream file(copy, std::ios::in | std::ios::out | std::ios::binary);
    file.seekg(static_cast<std::streamoff>(at));
    const char was = static_cast<char>(file.get());
    file.seekp(static_cast<std::streamoff>(at));
    file.put(static_cast<char>(was ^ 0x10));
  };
  // A stride that is a multiple of nothing meets all parts of rows.
  for (std::uintmax_t at = 0; at < size; at += at < 60 ? 1 : 211)
    EXPECT_FALSE(is_taken(good, copy, [&] { flip(at); })) << "byte " << at;
  EXPECT_FALSE(is_taken(good, copy, [&] { flip(size - 1); }));
  for (const std::uintmax_t left :
       {std::uintmax_t{0}, std::uintmax_t{7}, std::uintmax_t{39}, std::uintmax_t{200}, size / 2, size - 1})
    EXPECT_FALSE(is_taken(good, copy, [&] { fs::resize_file(copy, left); })) << left;
  EXPECT_FALSE(is_taken(good, copy, [&] { fs::resize_file(copy, size + 1); }));
}

TEST(Restart, RefusesADamagedCheckpointByNameAndOffersTheOneBefore) {
  const SharedFolder owner;
  const auto folder = owner.path() / "run";
  const auto older = folder / "checkpoints/step_000004.checkpoint",
             newer = folder / "checkpoints/step_000006.checkpoint";
  Simulation(short_case(), Communicator(), silent(folder)).run();
  if (Communicator().is_root()) fs::resize_file(newer, fs::file_size(newer) - 100);
  Communicator().barrier();
  const auto text = refusal(short_case(), restarted(folder, newer));
  EXPECT_NE(text.find(newer.string() + " is damaged"), std::string::npos) << text;
  EXPECT_NE(text.find("--restart " + older.string()), std::string::npos) << text;

  // Without a file the good one before it is taken.
  Simulation continued(short_case(), Communicator(), restarted(folder));
  EXPECT_EQ(continued.step(), 4);
  EXPECT_EQ(continued.run().steps, 6);

  if (Communicator().is_root())
    for (const auto& file : {older, newer}) std::ofstream(file) << "something else\n";
  Communicator().barrier();
  const auto both = refusal(short_case(), restarted(folder));
  EXPECT_NE(both.find(older.string() + " is not a checkpoint"), std::string::npos) << both;
  EXPECT_NE(both.find(newer.string() + " is not a checkpoint"), std::string::npos) << both;
  EXPECT_NE(refusal(short_case(), restarted(owner.path() / "empty")).find("no checkpoint"), std::string::npos);
}

TEST(Restart, RefusesTheCheckpointOfAnotherCaseAndNamesTheKey) {
  const SharedFolder owner;
  const auto folder = owner.path() / "run";
  const auto config = short_case();
  Simulation(config, Communicator(), silent(folder)).run();
  const auto expect_named = [&](const std::string& key, const std::function<void(CaseConfig&)>& change) {
    auto other = config;
    change(other);
    const auto text = refusal(other, restarted(folder));
    EXPECT_NE(text.find("step_000006.checkpoint is of another case: "), std::string::npos) << text;
    EXPECT_NE(text.find(key), std::string::npos) << text;
  };
  expect_named("box.cells is [10,8,12] in the case, [10,8,9] in the checkpoint", [](auto& c) { c.box.cells[2] = 12; });
  expect_named("fluid.viscosity", [](auto& c) { c.fluid.viscosity = 0.3; });
  expect_named("boundary.z-.velocity", [](auto& c) { c.boundary[4] = WallSide{{1, 0, 0}}; });
  expect_named("body.two.potentials.edge.stiffness", [](auto& c) { c.bodies[1].potentials.edge->stiffness = 41; });
  expect_named("body.two is not given in the case, given in the checkpoint", [](auto& c) {
    c.bodies.pop_back();
    c.cavities.clear();  // they may be others
  });

  // What may change.
  auto longer = until(config, 7);
  longer.title = "goes on";
  longer.time.end = 50;
  longer.time.cfl = 0.2;
  longer.output.fields.interval.reset();
  longer.checkpoint.keep = 5;
  EXPECT_EQ(Simulation(longer, Communicator(), restarted(folder)).run().steps, 7);
}

TEST(Restart, LeavesTheOldCheckpointWhenTheDiskIsFull) {
  const SharedFolder owner;
  const auto file = owner.path() / "checkpoints/step_000001.checkpoint";
  BoxConfig box;
  box.cells = {24, 24, 24};
  const Grid grid(box, BoundaryConfig{}, Communicator());
  const FlowSolver flow(grid, FlowParameters{});
  CheckpointHead head;
  head.flow = flow.state_numbers();
  write_checkpoint(file, head, flow, {});
  // A limit on the size of files behaves as a full disk does.
  std::signal(SIGXFSZ, SIG_IGN);
  rlimit before{};
  ASSERT_EQ(getrlimit(RLIMIT_FSIZE, &before), 0);
  rlimit tight = before;
  tight.rlim_cur = 200 * 1024;
  ASSERT_EQ(setrlimit(RLIMIT_FSIZE, &tight), 0);
  EXPECT_THROW(write_checkpoint(file, head, flow, {}), CollectiveError);
  ASSERT_EQ(setrlimit(RLIMIT_FSIZE, &before), 0);
  Communicator().barrier();
  EXPECT_FALSE(fs::exists(file.string() + ".tmp"));
  CheckpointReader(file, Communicator()).verify();
}

TEST(Restart, ARunThatFailsLeavesAGoodStateFromBeforeIt) {
  const SharedFolder owner;
  const auto folder = owner.path() / "run";
  auto config = cases()[1].config;
  config.output = {};
  config.initial.amplitude = 5;
  config.fluid.viscosity = 1e-3;
  config.time.step = 0.5;  // a Courant number beyond ten
  try {
    Simulation(config, Communicator(), silent(folder)).run();
    FAIL() << "must blow up";
  } catch (const CollectiveError& error) {
    EXPECT_NE(std::string(error.what()).find("The checkpoint before it is " + (folder / "checkpoints/step_").string()),
              std::string::npos)
        << error.what();
  }
  Communicator().barrier();
  config.time.step.reset();
  Simulation continued(config, Communicator(), restarted(folder));
  EXPECT_TRUE(std::isfinite(continued.flow().kinetic_energy()));
}

TEST(Restart, ASignalLeavesACheckpointThatGoesOnWithTheSameBits) {
  const SharedFolder owner;
  const auto config = until(cases()[2].config, 13);
  const Communicator ranks;
  Simulation(config, ranks, silent(owner.path() / "whole")).run();
  const auto folder = owner.path() / "stopped";
  const auto stop_at = [&](long step, SimulationOptions options) {
    const auto result = Simulation(config, ranks, options).run([&](const Simulation& now) {
      if (now.step() == step && ranks.rank() == ranks.size() - 1) std::raise(SIGUSR1);
    });
    EXPECT_EQ(result.end, RunEnd::signal);
  };
  stop_at(2, silent(folder));
  stop_at(7, restarted(folder));
  EXPECT_EQ(Simulation(config, ranks, restarted(folder)).run().end, RunEnd::max_steps);
  if (ranks.is_root()) expect_same_files(owner.path() / "whole", folder, "stopped twice");
}

}  // namespace
}  // namespace pliant
