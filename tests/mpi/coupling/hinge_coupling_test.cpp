#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>

#include "core/error.hpp"
#include "coupling/bodies.hpp"
#include "mpi/io/shared_folder.hpp"
#include "simulation/simulation.hpp"

namespace pliant {
namespace {

constexpr double radian = std::numbers::pi / 180;
constexpr double closed = 15, opened = 60;

// A leaflet that stands up from the floor of a channel, whose flow goes to and fro.
CaseConfig leaflet_in_channel(double thickness) {
  CaseConfig config;
  config.box.size = {3, 1, 1};
  config.box.origin = {-1, 0, 0};
  config.box.cells = {36, 12, 13};
  config.boundary[0] = InflowSide{{1, 0, 0}, InflowProfile::uniform, 0, "sin(pi*t)"};
  config.boundary[1] = OutflowSide{};
  for (std::size_t side = 2; side < 6; ++side) config.boundary[side] = WallSide{};
  config.fluid.viscosity = 0.02;
  config.time.end = 2;
  config.time.step = 0.02;
  BodyConfig leaflet;
  leaflet.name = "leaflet";
  leaflet.surface = PlateSurface{{0.6, 0.7}, 0.1};
  leaflet.rotation = {{0, 1, 0}, -90};
  leaflet.center = {0, 0.5, 0.5};
  leaflet.motion = MotionKind::hinge;
  leaflet.coupling = CouplingKind::strong;
  leaflet.material.density = 1;
  leaflet.material.thickness = thickness;
  leaflet.hinge.point = {0, 0.5, 0.2};
  leaflet.hinge.axis = {0, 1, 0};
  leaflet.hinge.angle = closed;
  leaflet.hinge.min_angle = closed;
  leaflet.hinge.max_angle = opened;
  config.bodies = {leaflet};
  config.output.history.every = 1000;
  return config;
}

// Angle and rate after every step, on every rank.
std::vector<HingeState> run(const CaseConfig& config) {
  const Communicator world;
  const SharedFolder folder;
  SimulationOptions options;
  options.output = folder.path() / "out";
  options.progress = ProgressStyle::silent;
  Simulation simulation(config, world, options);
  std::vector<HingeState> states;
  simulation.run([&](const Simulation& now) {
    std::array<double, 2> state{};
    if (const Body* leaflet = now.bodies().find(0)) state = {leaflet->hinge.angle, leaflet->hinge.rate};
    world.sum(state);
    states.push_back({state[0], state[1]});
  });
  return states;
}

class LightLeaflet : public testing::TestWithParam<StrongScheme> {};
INSTANTIATE_TEST_SUITE_P(Schemes, LightLeaflet, testing::Values(StrongScheme::aitken, StrongScheme::hamming));

TEST_P(LightLeaflet, GoesFromStopToStopAndRestsOnThemToTheBit) {
  auto config = leaflet_in_channel(0.1);
  config.coupling.scheme = GetParam();
  const auto states = run(config);
  const auto count = [&](double angle) {
    return std::count_if(states.begin(), states.end(),
                         [&](const HingeState& s) { return s.angle == angle && s.rate == 0; });
  };
  ASSERT_EQ(states.size(), 101u);
  for (const auto& s : states) {
    EXPECT_GE(s.angle, radian * closed);
    EXPECT_LE(s.angle, radian * opened);
  }
  // It rests on each for a good part of the period, and is neither left between them nor thrown to and fro.
  EXPECT_GT(count(radian * closed), 10);
  EXPECT_GT(count(radian * opened), 10);
  int turns = 0;
  for (std::size_t n = 2; n < states.size(); ++n) turns += states[n].rate * states[n - 1].rate < 0;
  EXPECT_LE(turns, 4);
}

TEST(HeavyLeaflet, MovesAlikeByBothCouplings) {
  auto config = leaflet_in_channel(4);
  config.time.end = 1;
  double fastest = 0;
  const auto differ = [&](double step) {
    config.time.step = step;
    config.bodies[0].coupling = CouplingKind::strong;
    const auto strong = run(config);
    config.bodies[0].coupling = CouplingKind::loose;
    const auto loose = run(config);
    for (const auto& s : strong) fastest = std::max(fastest, std::abs(s.rate));
    return std::abs(strong.back().angle - loose.back().angle);
  };
  const double coarse = differ(0.04), fine = differ(0.02);
  // The loosely coupled one answers a step late, and so is first order in the step.
  EXPECT_GT(fastest, 0.1);
  EXPECT_LT(coarse, 0.04 * fastest);
  EXPECT_LT(fine, 0.65 * coarse);
}

// The same leaflet, laid down or stood up by its rotation, is as light, and so is coupled alike by "auto".
TEST(AddedMass, OfAHingeDoesNotDependOnHowTheLeafletWasTurned) {
  auto config = leaflet_in_channel(0.1);
  auto& leaflet = config.bodies[0];
  const auto ratio = [&] {
    const Grid grid(config.box, config.boundary, Communicator());
    return Bodies(config, grid).kinds()[0].added_mass_ratio;
  };
  const double upright = ratio();
  EXPECT_GT(upright, 1);
  leaflet.rotation = {};
  leaflet.hinge.point = leaflet.center + Vec3{-0.3, 0, 0};
  EXPECT_NEAR(ratio(), upright, 1e-12 * upright);
  leaflet.rotation = {{0, 0, 1}, 90};
  leaflet.hinge.point = leaflet.center + Vec3{0, -0.3, 0};
  leaflet.hinge.axis = {1, 0, 0};
  EXPECT_NEAR(ratio(), upright, 1e-12 * upright);
}

TEST(LightLeaflet, IsFoundUnstableUnderLooseCoupling) {
  auto config = leaflet_in_channel(0.02);
  config.bodies[0].coupling = CouplingKind::loose;
  try {
    run(config);
    FAIL() << "loose coupling held a leaflet whose added mass is some 15 times its own";
  } catch (const CollectiveError& error) {
    const std::string text = error.what();
    EXPECT_NE(text.find("body 'leaflet'"), std::string::npos) << text;
    EXPECT_NE(text.find("strong"), std::string::npos) << text;
  }
}

}  // namespace
}  // namespace pliant
