#include <gtest/gtest.h>

#include "mpi/coupling/small_cases.hpp"
#include "mpi/first_ranks.hpp"
#include "mpi/io/shared_folder.hpp"
#include "unit/io/text_of.hpp"

// Runs with bodies of every motion that are interrupted and continued: the same bits on as many ranks, the same numbers
// to round-off on others.
namespace pliant {
namespace {

namespace fs = std::filesystem;

constexpr long steps_before = 5, steps_in_all = 25;

CaseConfig everything(CouplingKind coupling, StrongScheme scheme) {
  auto config = all_motions();
  config.box.cells = {9, 8, 9};
  config.time.step.reset();
  config.time.cfl = 0.4;
  config.time.max_step = 0.02;
  config.checkpoint.keep = 2;
  config.output.history.every = 3;
  config.output.surfaces.every = 4;
  config.coupling.scheme = scheme;
  for (auto& body : config.bodies)
    if (body.motion == MotionKind::hinge || body.motion == MotionKind::rigid) {
      body.coupling = coupling;
      body.material.density = 40;  // on so coarse a grid markers move a lot of fluid along
    }
  // One that other bodies' iterations leave alone, and copies.
  auto free = ball("free", MotionKind::rigid, {}, 0.25);
  free.placement.count = 3;
  free.placement.region_lower = Vec3{-0.4, -2, -1.5};
  free.placement.region_upper = Vec3{0.4, 2, 1.5};
  free.material.density = 3;
  free.rigid.virtual_mass = 30;  // smaller than a cell, for speed
  free.coupling = CouplingKind::loose;
  config.bodies.push_back(free);
  config.repulsion = {0.15, 2};
  return config;
}

struct Outcome {
  std::vector<double> flow, bodies;
};

// Of a run on the first ranks; empty on the others, which wait.
Outcome outcome_of(const FirstRanks& first, const CaseConfig& config, const SimulationOptions& options) {
  Outcome outcome;
  if (!first.am_in()) return outcome;
  try {
    Simulation simulation(config, first.ranks(), options);
    simulation.run();
    outcome = {whole_flow(simulation.flow()), all_vertices(simulation.bodies())};
    for (const Vec3 f : all_vectors(simulation.bodies(), [](const Body& b) { return b.loads.balance.force; }))
      outcome.bodies.insert(outcome.bodies.end(), {f.x, f.y, f.z});
  } catch (const std::exception& error) { ADD_FAILURE() << error.what(); }
  return outcome;
}

void expect_same_tables(const fs::path& a, const fs::path& b) {
  EXPECT_EQ(text_of(a / "history.csv"), text_of(b / "history.csv"));
  for (const auto& entry : fs::directory_iterator(a / "bodies"))
    EXPECT_EQ(text_of(entry.path()), text_of(b / "bodies" / entry.path().filename())) << entry.path();
  std::size_t surfaces = 0;
  for (const auto& entry : fs::directory_iterator(a / "surfaces")) {
    ++surfaces;
    EXPECT_TRUE(text_of(entry.path()) == text_of(b / "surfaces" / entry.path().filename())) << entry.path();
  }
  EXPECT_GT(surfaces, 6u);
}

enum class Pairs { all, from_all_ranks };

void expect_continued(const CaseConfig& config, Pairs pairs) {
  const SharedFolder owner;
  const Communicator world;
  const int n_ranks = world.size();
  for (int n = pairs == Pairs::all ? 1 : n_ranks; n <= n_ranks; ++n) {
    const auto folder = owner.path() / std::to_string(n);
    const FirstRanks writers(n);
    const auto whole = outcome_of(writers, until(config, steps_in_all), silent(folder / "whole"));
    outcome_of(writers, until(config, steps_before), silent(folder / "part"));
    world.barrier();
    for (int m = 1; m <= n_ranks; ++m) {
      if (pairs != Pairs::all && m != 1 && m != n) continue;
      const auto copy = folder / ("from " + std::to_string(m));
      if (world.is_root()) fs::copy(folder / "part", copy, fs::copy_options::recursive);
      world.barrier();
      const FirstRanks readers(m);
      auto options = silent(copy);
      options.restart = RestartRequest{};
      const auto continued = outcome_of(readers, until(config, steps_in_all), options);
      if (!world.is_root()) continue;
      const auto what = "from " + std::to_string(n) + " to " + std::to_string(m) + " ranks";
      if (n == m) {
        EXPECT_TRUE(continued.flow == whole.flow) << what;
        EXPECT_TRUE(continued.bodies == whole.bodies) << what;
        expect_same_tables(folder / "whole", copy);
      } else {
        EXPECT_LT(relative_difference(continued.flow, whole.flow), 1e-11) << what;
        EXPECT_LT(relative_difference(continued.bodies, whole.bodies), 1e-11) << what;
      }
    }
  }
}

TEST(BodyRestart, LooselyCoupled) {
  expect_continued(everything(CouplingKind::loose, StrongScheme::aitken), Pairs::all);
}

TEST(BodyRestart, StronglyCoupledByAitken) {
  expect_continued(everything(CouplingKind::strong, StrongScheme::aitken), Pairs::all);
}

TEST(BodyRestart, StronglyCoupledByHamming) {
  expect_continued(everything(CouplingKind::strong, StrongScheme::hamming), Pairs::from_all_ranks);
}

TEST(BodyRestart, OfBodiesThatDeformTogetherWithTheFlow) {
  auto config = everything(CouplingKind::loose, StrongScheme::automatic);
  auto interface = ball("interface", MotionKind::deformable, {1.0, -1.0, 0.9}, 0.6);
  interface.potentials.surface_tension = SurfaceTensionConfig{1, 0};
  interface.coupling = CouplingKind::force_spreading;
  interface.held = true;
  auto heavy = drop({-1.0, -1.0, 0.9}, 0.6);
  heavy.name = "heavy";
  heavy.coupling = CouplingKind::force_spreading;
  auto stiff = heavy;
  stiff.name = "stiff";
  stiff.center = {-1, 1, -0.9};
  stiff.coupling = CouplingKind::local_mass;
  auto loose = heavy;
  loose.name = "loose";
  loose.center = {1, -1, -1};
  loose.mass_per_vertex = 5;
  loose.coupling = CouplingKind::loose;
  config.bodies.erase(config.bodies.begin() + 1);  // room for them
  for (auto& body : config.bodies)
    if (body.name == "drop") body = interface;
  config.bodies.insert(config.bodies.end(), {heavy, stiff, loose});
  expect_continued(config, Pairs::from_all_ranks);
}

TEST(BodyRestart, OfBodiesThatComeAndGo) {
  auto config = everything(CouplingKind::loose, StrongScheme::automatic);
  config.immersed_boundary.carry_forces = true;
  auto shutter = ball("shutter", MotionKind::fixed, {0, 0, 1.2}, 1);
  shutter.surface = PlateSurface{{0.8, 0.9}, 0.25};
  shutter.tight = true;
  config.bodies.push_back(shutter);
  for (auto& body : config.bodies) {  // switched before and after the restart, some there as it happens, some not
    if (body.name == "rock") body.schedule = ScheduleConfig{0.2, {0.2, 0.7}};
    if (body.name == "told") body.schedule = ScheduleConfig{0.2, {0.9, 0.3}};
    if (body.name == "shutter") body.schedule = ScheduleConfig{0.15, {0.5, 1}};
  }
  expect_continued(config, Pairs::all);
}

// Other numbers of ranks stop iterating at other points; the tolerance puts these well within the bound of the test.
CaseConfig tightly_coupled_box() {
  auto config = small_box({9, 8, 9});
  config.checkpoint.keep = 2;
  config.output.history.every = 3;
  config.output.surfaces.every = 3;
  config.initial.flow = InitialFlow::taylor_green;
  config.coupling.tolerance = 1e-13;
  return config;
}

TEST(BodyRestart, OfADeformableBodyThatIsCoupledStrongly) {
  auto config = tightly_coupled_box();
  auto body = drop({0.1, 0.2, 0.3}, 1);
  body.coupling = CouplingKind::strong;
  body.mass_per_vertex = 1;
  config.bodies = {body};
  expect_continued(config, Pairs::from_all_ranks);
}

// Its iterations use secants of earlier steps, which the checkpoint has to bring.
TEST(BodyRestart, OfALightWallThatIsCoupledStrongly) {
  auto config = tightly_coupled_box();
  config.coupling.max_iterations = 200;
  auto body = ball("shell", MotionKind::deformable, {0.1, 0.2, 0.3}, 1);
  body.material.thickness = 0.01;
  body.material.density = 10;
  body.material.young = 3000;
  body.coupling = CouplingKind::strong;
  config.bodies = {body};
  expect_continued(config, Pairs::from_all_ranks);
}

}  // namespace
}  // namespace pliant
