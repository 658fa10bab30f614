#include <gtest/gtest.h>

#include <functional>

#include "mesh/geometry.hpp"
#include "mpi/coupling/small_cases.hpp"
#include "mpi/io/shared_folder.hpp"

// Bodies that cross ranks and periodic sides are all there, once, on the right rank and without a jump, at every step.
namespace pliant {
namespace {

/// Looks at all bodies after every step of a run.
class Census {
 public:
  explicit Census(const Bodies& bodies) : bodies_(bodies), box_(bodies.grid().size()) {
    last_ = centers();
    sides_crossed_.assign(6, 0);
  }

  /// `step`: the time since the last look.
  void look(double step) {
    expect_each_once();
    expect_at_home();
    const auto now = centers();
    const auto speed = all_vectors(bodies_, [](const Body& b) { return Vec3{norm(b.pose.velocity), 0, 0}; });
    for (std::size_t n = 0; n < now.size(); ++n) {
      // Speeds of both ends of the step; a path may be faster between them.
      const double farthest = 1.1 * step * std::max(speed[n].x, last_speed_.empty() ? 0.0 : last_speed_[n].x) + 1e-12;
      if (step > 0) { EXPECT_LE(norm(now[n] - last_[n]), farthest) << "body " << n << " jumped"; }
      count_crossings(last_[n], now[n]);
    }
    for (const Body& b : bodies_.own())
      if (held_before_.size() == now.size() && held_before_[static_cast<std::size_t>(b.id)] == 0) ++arrivals_;
    held_before_.assign(now.size(), 0);
    for (const Body& b : bodies_.own()) held_before_[static_cast<std::size_t>(b.id)] = 1;
    last_ = now;
    last_speed_ = speed;
  }

  /// Bodies that came from other ranks, on all ranks together.
  long arrivals() const { return bodies_.grid().ranks().sum(arrivals_); }
  /// Crossings of x-, x+, y-, y+, z-, z+.
  const std::vector<long>& sides_crossed() const { return sides_crossed_; }

 private:
  std::vector<Vec3> centers() const {
    return all_vectors(bodies_, [](const Body& b) { return b.pose.center; });
  }

  void expect_each_once() const {
    std::vector<double> present(static_cast<std::size_t>(bodies_.count()), 0.0);
    for (const Body& b : bodies_.own()) present[static_cast<std::size_t>(b.id)] += 1;
    bodies_.grid().ranks().sum(present);
    EXPECT_EQ(present, std::vector<double>(present.size(), 1.0));
    EXPECT_TRUE(std::is_sorted(bodies_.own().begin(), bodies_.own().end(),
                               [](const Body& a, const Body& b) { return a.id < b.id; }));
  }

  void expect_at_home() const {
    const Grid& grid = bodies_.grid();
    const double lower = grid.z_face()[-1], upper = grid.z_face()[grid.nz() - 1];
    for (const Body& b : bodies_.own()) {
      double z = mean_position(b.surface.positions).z;
      if (grid.is_periodic(2)) z -= box_.z * std::floor((z - grid.origin().z) / box_.z);
      EXPECT_GE(z, lower - 1e-12) << b.name();
      EXPECT_LE(z, upper + 1e-12) << b.name();
    }
  }

  void count_crossings(Vec3 from, Vec3 to) {
    const Grid& grid = bodies_.grid();
    for (int d = 0; d < 3; ++d) {
      const auto period = [&](double x) { return std::floor((x - grid.origin()[d]) / box_[d]); };
      const double crossed = period(to[d]) - period(from[d]);
      if (crossed < 0) ++sides_crossed_[static_cast<std::size_t>(2 * d)];
      if (crossed > 0) ++sides_crossed_[static_cast<std::size_t>(2 * d + 1)];
    }
  }

  const Bodies& bodies_;
  Vec3 box_;
  std::vector<Vec3> last_, last_speed_;
  std::vector<int> held_before_;
  long arrivals_ = 0;
  std::vector<long> sides_crossed_;
};

BodyConfig balls(std::string name, MotionKind motion, int count, double radius) {
  auto body = ball(std::move(name), motion, {}, radius);
  body.placement.count = count;
  body.placement.gap = 0.02;
  return body;
}

using Look = std::function<void(const Simulation&, double step)>;

void run_with(const CaseConfig& config, const Look& look_further = nullptr,
              const std::function<void(const Census&)>& conclude = nullptr) {
  const SharedFolder owner;
  Simulation simulation(config, Communicator(), silent(owner.path() / "run"));
  Census census(simulation.bodies());
  double last_time = 0;
  simulation.run([&](const Simulation& now) {
    census.look(now.time() - last_time);
    if (look_further) look_further(now, now.time() - last_time);
    last_time = now.time();
  });
  if (conclude) conclude(census);
}

TEST(ManyBodies, TwoHundredCarriedByTheFlowThroughAllSides) {
  auto config = small_box({28, 27, 29});
  config.initial.flow = InitialFlow::perturbed;
  config.initial.amplitude = 0.5;
  config.initial.velocity = {1.3, -1.1, 1.5};
  config.time.step.reset();
  config.time.max_steps = 75;
  config.bodies = {balls("ball", MotionKind::rigid, 200, 0.2)};
  // Balls of three cells move along several times the fluid that they displace.
  config.bodies[0].coupling = CouplingKind::loose;
  config.bodies[0].rigid.virtual_mass = 4;
  config.bodies[0].rigid.velocity = config.initial.velocity;
  config.bodies[0].placement.orientation = OrientationKind::random;
  Vec3 momentum_before, impulse;
  double dt = 0;
  const auto look = [&](const Simulation& now, double step) {
    const Vec3 momentum = config.fluid.density * now.flow().grid().volume() * now.flow().bulk_velocity();
    if (step == 0) {
      momentum_before = momentum;
      return;
    }
    dt = step;
    // What the markers take from the flow is what they give to the bodies.
    for (const Vec3 f : all_vectors(now.bodies(), [](const Body& b) { return b.loads.reaction.force; }))
      impulse -= step * f;
    EXPECT_LT(norm(momentum - momentum_before - impulse), 1e-11 * norm(momentum_before)) << "step " << now.step();
    // Balls as heavy as the fluid leave its momentum alone but for the last change of theirs.
    EXPECT_LT(norm(momentum - momentum_before), 0.02 * norm(momentum_before));
  };
  run_with(config, look, [&](const Census& census) {
    const auto& sides = census.sides_crossed();
    for (const int side : {1, 2, 5}) EXPECT_GT(sides[static_cast<std::size_t>(side)], 50) << "side " << side;
    if (Communicator().size() > 1) { EXPECT_GT(census.arrivals(), 100); }
  });
  EXPECT_GT(dt, 0);
}

TEST(ManyBodies, SomeThroughEachOfTheSixSidesByTheirPaths) {
  auto config = small_box({9, 8, 10});
  config.time.step = 0.05;
  config.time.max_steps = 50;
  config.fluid.viscosity = 0.5;
  const char* names[] = {"west", "east", "south", "north", "down", "up"};
  for (int side = 0; side < 6; ++side) {
    auto body = balls(names[side], MotionKind::prescribed, 34, 0.12);
    body.placement.seed = static_cast<std::uint64_t>(side + 1);
    std::string* const paths[] = {&body.path.x, &body.path.y, &body.path.z};
    *paths[side / 2] = side % 2 == 0 ? "-1.6*t" : "1.6*t";
    config.bodies.push_back(body);
  }
  std::vector<Vec3> start;
  const auto look = [&](const Simulation& now, double) {
    const auto centers = all_vectors(now.bodies(), [](const Body& b) { return b.pose.center; });
    if (start.empty()) start = centers;
    for (std::size_t n = 0; n < centers.size(); ++n) {
      Vec3 expected = start[n];
      expected[static_cast<int>(n / 34) / 2] += ((n / 34) % 2 == 0 ? -1.6 : 1.6) * now.time();
      EXPECT_LT(norm(centers[n] - expected), 1e-12);
    }
  };
  run_with(config, look, [&](const Census& census) {
    // Each goes the length of the box.
    EXPECT_EQ(census.sides_crossed(), std::vector<long>(6, 34));
  });
}

/// Slip and reaction of every body after every step of a run.
std::vector<Vec3> slips_and_reactions(const CaseConfig& config, const Communicator& ranks,
                                      const std::filesystem::path& folder) {
  Simulation simulation(config, ranks, silent(folder));
  std::vector<Vec3> all;
  simulation.run([&](const Simulation& now) {
    for (const auto& numbers :
         {all_vectors(now.bodies(), [](const Body& b) { return Vec3{b.slip.rms(), b.slip.largest, b.slip.flux}; }),
          all_vectors(now.bodies(), [](const Body& b) { return b.loads.reaction.force; })})
      all.insert(all.end(), numbers.begin(), numbers.end());
  });
  return all;
}

// Bodies change ranks between the step and its diagnostics.
TEST(ManyBodies, SlipAndReactionGoAlongFromRankToRank) {
  auto config = small_box({9, 8, 10});
  config.initial.flow = InitialFlow::perturbed;
  config.time.step = 0.05;
  config.time.max_steps = 20;
  config.fluid.viscosity = 0.5;
  config.output.history.every = 1;
  config.bodies = {balls("up", MotionKind::prescribed, 20, 0.2), balls("post", MotionKind::fixed, 5, 0.2)};
  config.bodies[0].path.z = "1.6*t";
  const SharedFolder owner;
  const Communicator world, alone(MPI_COMM_SELF);
  const auto shared = slips_and_reactions(config, world, owner.path() / "shared");
  const auto own = slips_and_reactions(config, alone, owner.path() / ("alone-" + std::to_string(world.rank())));
  ASSERT_EQ(shared.size(), own.size());
  for (std::size_t n = 0; n < own.size(); ++n) {
    EXPECT_LT(norm(shared[n] - own[n]), 1e-11 * (1 + norm(own[n]))) << "number " << n;
    if (n >= 50) { EXPECT_GT(norm(own[n]), 0) << "number " << n; }
  }
}

TEST(ManyBodies, AHeapOnTheFloor) {
  constexpr double radius = 0.35;
  auto config = small_box({16, 16, 17});
  put_walls(config, 2);
  config.forcing.gravity = {0, 0, -2};
  config.time.step = 0.02;
  config.time.max_steps = 120;
  config.repulsion = {0.25, 20};
  config.bodies = {balls("ball", MotionKind::rigid, 40, radius)};
  config.bodies[0].placement.gap = 0.05;
  config.bodies[0].coupling = CouplingKind::loose;
  config.bodies[0].rigid.virtual_mass = 4;
  config.bodies[0].material.density = 4;
  double before = 0, after = 0;
  const auto look = [&](const Simulation& now, double step) {
    double mean = 0;
    for (const Vec3 x : all_vectors(now.bodies(), [](const Body& b) { return b.pose.center; })) {
      mean += x.z / 40;
      EXPECT_GT(x.z, -2 + radius) << "none touches the floor";
      EXPECT_LT(x.z, 2 - radius);
    }
    (step == 0 ? before : after) = mean;
  };
  run_with(config, look);
  EXPECT_LT(after, before - 0.5) << "they have fallen";
}

}  // namespace
}  // namespace pliant
