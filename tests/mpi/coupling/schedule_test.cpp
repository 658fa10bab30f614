#include <gtest/gtest.h>

#include <fstream>

#include "mpi/coupling/small_cases.hpp"
#include "mpi/io/shared_folder.hpp"
#include "simulation/surface_batch.hpp"
#include "structure/schedule_of_body.hpp"

// Bodies that come and go by a schedule. Steps are 0.02 long.
namespace pliant {
namespace {

constexpr ScheduleConfig never{1000, {0.5, 1}}, always{1000, {0, 0.5}};

struct Outcome {
  std::vector<double> flow, loads;
};

/// The flow as a run leaves it, and the loads of all bodies.
Outcome run(const CaseConfig& config, const Communicator& ranks, const std::filesystem::path& folder) {
  Simulation simulation(config, ranks, silent(folder));
  simulation.run();
  Outcome outcome{whole_flow(simulation.flow()), {}};
  for (const Vec3 f : all_vectors(simulation.bodies(), [](const Body& b) { return b.loads.balance.force; }))
    outcome.loads.insert(outcome.loads.end(), {f.x, f.y, f.z});
  return outcome;
}

CaseConfig disturbed() {
  auto config = small_box({12, 11, 13});
  put_walls(config, 2);
  config.initial.flow = InitialFlow::perturbed;
  config.initial.amplitude = 0.5;
  config.time.max_steps = 12;
  return config;
}

BodyConfig shutter(Vec3 center) {
  auto body = ball("shutter", MotionKind::fixed, center, 1);
  body.surface = PlateSurface{{1.4, 1.4}, 0.25};
  return body;
}

BodyConfig told(Vec3 center) {
  auto body = ball("told", MotionKind::prescribed, center, 0.5);
  body.path.x = "0.3*sin(3*t)";
  return body;
}

/// What can have a schedule: a closed body, a sheet, one that moves.
std::vector<BodyConfig> guests() {
  return {ball("stone", MotionKind::fixed, {-1, -1, -1}, 0.6), shutter({0, 0, 0.2}), told({1, 1, 1.1})};
}

CaseConfig with(CaseConfig config, std::vector<BodyConfig> bodies, const ScheduleConfig& schedule) {
  for (auto& body : bodies) {
    body.schedule = schedule;
    config.bodies.push_back(body);
  }
  return config;
}

TEST(BodySchedule, HasHalfOpenPartsOfThePeriodThatMayGoOnOverItsEnd) {
  const ScheduleConfig within{2, {0.25, 0.5}}, over{2, {0.75, 0.25}};
  for (const double period : {0.0, 1.0, 7.0}) {
    const double t = 2 * period;
    EXPECT_FALSE(is_on(within, t));
    EXPECT_TRUE(is_on(within, t + 0.5));
    EXPECT_TRUE(is_on(within, t + 0.99));
    EXPECT_FALSE(is_on(within, t + 1));
    EXPECT_TRUE(is_on(over, t));
    EXPECT_TRUE(is_on(over, t + 0.49));
    EXPECT_FALSE(is_on(over, t + 0.5));
    EXPECT_FALSE(is_on(over, t + 1.49));
    EXPECT_TRUE(is_on(over, t + 1.5));
  }
}

TEST(BodySchedule, OfAnAbsentBodyLeavesTheFlowAsWithoutItToTheBit) {
  const SharedFolder owner;
  const auto rock = ball("rock", MotionKind::fixed, {1.1, -1.1, 0.2}, 0.5);
  auto leaf = leaflet({-1.1, 1.0, 0.2});
  auto drift = drop({1.0, -0.9, -1.1}, 0.6);
  drift.coupling = CouplingKind::force_spreading;
  const std::vector<std::vector<BodyConfig>> companies{{}, {rock}, {leaf}, {drift}};
  for (const auto sweeps : {Sweeps::fused, Sweeps::plain})
    for (std::size_t n = 0; n < companies.size(); ++n) {
      auto config = disturbed();
      config.time.sweeps = sweeps;
      config.bodies = companies[n];
      const auto without = run(config, Communicator(), owner.path() / "without");
      const auto absent = run(with(config, guests(), never), Communicator(), owner.path() / "absent");
      EXPECT_TRUE(absent.flow == without.flow) << "company " << n;
      for (std::size_t i = 0; i < absent.loads.size(); ++i)
        EXPECT_EQ(absent.loads[i], i < without.loads.size() ? without.loads[i] : 0.0);
    }
}

TEST(BodySchedule, OfABodyThatIsThereFromTheBeginningChangesNoBit) {
  const SharedFolder owner;
  const auto config = disturbed();
  auto unscheduled = with(config, guests(), always);
  for (auto& body : unscheduled.bodies) body.schedule.reset();
  const auto whole = run(unscheduled, Communicator(), owner.path() / "whole");
  const auto scheduled = run(with(config, guests(), always), Communicator(), owner.path() / "scheduled");
  EXPECT_TRUE(scheduled.flow == whole.flow);
  EXPECT_TRUE(scheduled.loads == whole.loads);
}

TEST(BodySchedule, IsTheSameOnAnyNumberOfRanks) {
  const SharedFolder owner;
  auto config = with(disturbed(), guests(), {0.1, {0.4, 0.9}});
  config.bodies[1].schedule = ScheduleConfig{0.14, {0.8, 0.3}};
  config.bodies.push_back(leaflet({-1.1, 1.0, 0.2}));
  const Communicator world, alone(MPI_COMM_SELF);
  for (const auto coupling : {CouplingKind::loose, CouplingKind::strong}) {
    config.bodies.back().coupling = coupling;
    const auto together = run(config, world, owner.path() / "together");
    const auto single = run(config, alone, owner.path() / ("alone-" + std::to_string(world.rank())));
    EXPECT_LT(relative_difference(together.flow, single.flow), 1e-11);
    EXPECT_LT(relative_difference(together.loads, single.loads), 1e-11);
  }
}

// Fixed bodies can only take energy from a flow that nothing drives, in the step in which they come as in any other.
TEST(BodySchedule, OfAFixedBodyTakesEnergyOnlyAndTheMostAsItComes) {
  const SharedFolder owner;
  for (const auto& guest : {ball("stone", MotionKind::fixed, {0, 0, 0}, 0.9), shutter({0, 0, 0})}) {
    auto config = small_box({16, 16, 16});
    config.initial.flow = InitialFlow::uniform;
    config.initial.velocity = {0, 0, 1};
    config.time.max_steps = 30;
    config = with(config, {guest}, {1, {0.2, 0.4}});
    Simulation simulation(config, Communicator(), silent(owner.path() / guest.name));
    std::vector<double> energy, drag;
    simulation.run([&](const Simulation& s) {
      energy.push_back(s.flow().kinetic_energy());
      drag.push_back(all_vectors(s.bodies(), [](const Body& b) { return b.loads.reaction.force; })[0].z);
    });
    ASSERT_EQ(energy.size(), 31u);
    double greatest = 0;
    for (std::size_t n = 1; n <= 10; ++n) EXPECT_NEAR(energy[n], energy[0], 1e-12 * energy[0]) << "not there";
    for (std::size_t n = 1; n <= 30; ++n) {
      EXPECT_LT(energy[n], energy[n - 1] * (1 + 1e-12)) << "step " << n;
      greatest = std::max(greatest, energy[n - 1] - energy[n]);
    }
    EXPECT_EQ(greatest, energy[10] - energy[11]) << "the step in which it comes";
    EXPECT_GT(greatest, 0.005 * energy[0]);
  }
}

TEST(BodySchedule, IsInTheBodysTable) {
  const SharedFolder owner;
  const Communicator world;
  auto config = with(disturbed(), {told({1, 1, 0})}, {0.2, {0.3, 0.6}});
  config.output.history.every = 1;
  run(config, world, owner.path());
  if (!world.is_root()) return;
  std::ifstream file(owner.path() / "bodies" / "told.csv");
  std::string line;
  std::getline(file, line);
  const auto cells = [](const std::string& text) {
    std::vector<std::string> all(1);
    for (const char c : text)
      if (c == ',') all.emplace_back();
      else all.back() += c;
    return all;
  };
  const auto names = cells(line);
  const auto at = [&](const char* name) {
    return static_cast<std::size_t>(std::find(names.begin(), names.end(), name) - names.begin());
  };
  ASSERT_LT(at("on"), names.size());
  int n = 0;
  for (; std::getline(file, line); ++n) {
    const auto row = cells(line);
    // The middles of steps 4, 5 and 6 are at 0.35, 0.45 and 0.55 of the period.
    const bool is_there = n >= 4 && n <= 6;
    EXPECT_EQ(std::stod(row[at("on")]), is_there ? 1 : 0) << "step " << n;
    EXPECT_EQ(std::stod(row[at("force_x")]) != 0, is_there) << "step " << n;
    EXPECT_TRUE(std::isfinite(std::stod(row[at("probe_force_x")])));
    EXPECT_EQ(std::stod(row[at("probe_force_x")]) != 0, is_there) << "step " << n;
    EXPECT_EQ(std::stod(row[at("slip_rms")]) != 0, is_there) << "step " << n;
    EXPECT_EQ(std::stod(row[at("x")]) != 1, n > 0) << "it goes its way all the same";
  }
  EXPECT_EQ(n, 13);
}

TEST(BodySchedule, IsInTheSurfaceFiles) {
  const SharedFolder owner;
  for (const long steps : {5, 12}) {  // there, and away
    Simulation simulation(with(until(disturbed(), steps), {told({1, 1, 0})}, {0.2, {0.3, 0.6}}), Communicator(),
                          silent(owner.path() / std::to_string(steps)));
    simulation.run();
    const bool is_there = steps == 5;
    const auto batch = surface_batch(simulation.bodies(), 0);
    long n = 0;
    for (const auto& set : batch.sets)
      for (const double value : set.values) {
        const bool is_stress = set.name == "pressure" || set.name == "shear";
        EXPECT_EQ(std::isfinite(value), is_there || !is_stress) << set.name;
        if (set.name == "on") {
          EXPECT_EQ(value, is_there ? 1 : 0);
          ++n;
        }
        if (set.name == "force" && !is_there) { EXPECT_EQ(value, 0); }
      }
    EXPECT_EQ(simulation.bodies().grid().ranks().sum(n), 80) << "faces";
  }
}

TEST(BodySchedule, OfABodyThatOthersWouldTouchIsNoObstacleWhileItIsAway) {
  const SharedFolder owner;
  auto config = small_box({12, 12, 12});
  config.repulsion = {0.3, 2};
  auto thrown = ball("thrown", MotionKind::rigid, {0, 0, -0.55}, 0.5);
  thrown.material.density = 15;
  config.bodies = {thrown};
  config.time.max_steps = 8;
  const auto contact = [&](const ScheduleConfig& schedule, const char* folder) {
    Simulation simulation(with(config, {ball("stone", MotionKind::fixed, {0, 0, 0.6}, 0.5)}, schedule), Communicator(),
                          silent(owner.path() / folder));
    simulation.run();
    return all_vectors(simulation.bodies(), [](const Body& b) { return b.loads.contact.force; });
  };
  const auto away = contact(never, "away"), there = contact(always, "there");
  EXPECT_EQ(norm(away[0]), 0);
  EXPECT_EQ(norm(away[1]), 0);
  EXPECT_LT(there[0].z, 0);
  EXPECT_GT(there[1].z, 0);
}

// Of deformable bodies, whose contact is found in another way.
TEST(BodySchedule, OfABodyThatADeformableOneWouldTouchIsNoObstacleWhileItIsAway) {
  const SharedFolder owner;
  auto config = small_box({12, 12, 12});
  config.repulsion = {0.2, 2};
  config.bodies = {drop({0, 0, -0.55}, 0.5)};
  config.time.max_steps = 8;
  const auto positions = [&](const CaseConfig& of, const char* folder) {
    Simulation simulation(of, Communicator(), silent(owner.path() / folder));
    simulation.run();
    auto vertices = all_vertices(simulation.bodies());
    vertices.resize(9 * 42);  // of the drop
    return vertices;
  };
  const auto stone = ball("stone", MotionKind::fixed, {0, 0, 0.6}, 0.5);
  const auto alone = positions(config, "alone");
  EXPECT_TRUE(positions(with(config, {stone}, never), "away") == alone);
  EXPECT_FALSE(positions(with(config, {stone}, always), "there") == alone);
}

}  // namespace
}  // namespace pliant
