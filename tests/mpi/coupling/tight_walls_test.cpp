#include <gtest/gtest.h>

#include "core/error.hpp"
#include "mpi/coupling/small_cases.hpp"
#include "mpi/io/shared_folder.hpp"

// Walls that no net flow passes.
namespace pliant {
namespace {

BodyConfig tight_plate(std::string name, Vec3 center, std::array<double, 2> size) {
  auto body = ball(std::move(name), MotionKind::fixed, center, 1);
  body.surface = PlateSurface{size, 0.25};
  body.tight = true;
  return body;
}

/// Half of a plate.
SelectionConfig beyond_zero(std::string name) {
  SelectionConfig half;
  half.name = std::move(name);
  half.plane = SelectionConfig::Plane{{0, 0, 0}, {1, 0, 0}, PlaneSide::beyond, {}};
  return half;
}

BodyConfig in_halves(BodyConfig body) {
  body.selections = {beyond_zero("half")};
  body.tight_parts = {"half"};
  return body;
}

BodyConfig tilted(BodyConfig body) {
  body.rotation = {{1, 0.5, 0}, 25};
  return body;
}

/// The flow between the nodes, linear in each direction, from all of it.
class LinearFlow {
 public:
  LinearFlow(const FlowSolver& flow) : grid_(flow.grid()), all_(whole_flow(flow)) {}

  double operator()(Vec3 x, int component) const {
    const auto i = line(0, (x.x - grid_.origin().x) / grid_.dx() - (component == 0 ? 1 : 0.5), component);
    const auto j = line(1, (x.y - grid_.origin().y) / grid_.dy() - (component == 1 ? 1 : 0.5), component);
    const auto nodes = component == 2 ? grid_.global_z_face() : grid_.global_z_center();
    int below = -1;
    while (nodes[below + 1] <= x.z) ++below;
    const auto k = line(2, below + (x.z - nodes[below]) / (nodes[below + 1] - nodes[below]), component);
    double sum = 0;
    for (const auto& [c, in_z] : k)
      for (const auto& [b, in_y] : j)
        for (const auto& [a, in_x] : i) sum += in_x * in_y * in_z * at(a, b, c, component);
    return sum;
  }

 private:
  using Ends = std::array<std::pair<int, double>, 2>;

  // On faces of walls the velocity is zero, and is not among the unknowns.
  Ends line(int d, double place, int component) const {
    const int n = grid_.cells()[static_cast<std::size_t>(d)], lower = static_cast<int>(std::floor(place));
    Ends ends{{{lower, lower + 1 - place}, {lower + 1, place - lower}}};
    for (auto& [node, share] : ends) {
      if (grid_.is_periodic(d)) node = (node + n) % n;
      else if (d != component) node = std::clamp(node, 0, n - 1);
      else if (node < 0 || node == n - 1) node = 0, share = 0;
    }
    return ends;
  }

  double at(int i, int j, int k, int component) const {
    const auto& n = grid_.cells();
    return all_[static_cast<std::size_t>(i + n[0] * (j + n[1] * (k + n[2] * component)))];
  }

  const Grid& grid_;
  std::vector<double> all_;
};

/// Flux through every tight part, in the order of the bodies. Collective.
std::vector<double> fluxes(const Simulation& simulation) {
  const LinearFlow flow(simulation.flow());
  const auto& bodies = simulation.bodies();
  std::vector<double> all;
  for (std::size_t k = 0; k < bodies.kinds().size(); ++k) {
    const auto& kind = bodies.kinds()[k];
    const Body* body = bodies.find(bodies.first_id(k));
    for (const auto& vertices : kind.tight_parts) {
      double flux = 0;
      if (body != nullptr) {
        const auto& surface = body->surface;
        MarkerSet points;
        kind.flux_layout.place(surface.positions, surface.velocities, points);
        std::vector<Vec3> weights(surface.positions.size()), at_points(points.areas.size());
        for (int v : vertices) weights[static_cast<std::size_t>(v)].x = 1;
        kind.flux_layout.interpolate(weights, at_points);
        for (std::size_t m = 0; m < points.areas.size(); ++m) {
          const Vec3 x = points.positions[m];
          flux += at_points[m].x * points.areas[m] * dot({flow(x, 0), flow(x, 1), flow(x, 2)}, points.normals[m]);
        }
      }
      all.push_back(bodies.grid().ranks().sum(flux));
    }
  }
  return all;
}

CaseConfig disturbed(bool has_walls) {
  auto config = small_box({12, 11, 13});
  if (has_walls) {
    put_walls(config, 2);
    put_walls(config, 0);
    config.box.stretching_z = {StretchingLaw::tanh, 1.0};
  }
  config.initial.flow = InitialFlow::perturbed;
  config.initial.amplitude = 0.5;
  config.time.max_steps = 8;
  return config;
}

TEST(TightWalls, LetNoNetFlowPass) {
  const SharedFolder owner;
  for (const bool has_walls : {false, true})
    for (const auto viscous : {ViscousMode::implicit, ViscousMode::explicit_rk3}) {
      auto config = disturbed(has_walls);
      config.time.viscous = viscous;
      // Across the box: with walls, what passes one half comes back through the other.
      config.bodies = {in_halves(tight_plate("partition", {0, 0, 0.1}, {4, 4})),
                       tilted(in_halves(tight_plate("tilted", {0.2, 0.1, -1}, {1.4, 1.4}))),
                       ball("stone", MotionKind::fixed, {-1, -1, 1.1}, 0.5)};
      Simulation simulation(config, Communicator(), silent(owner.path()));
      double largest_velocity = 0;
      simulation.run([&](const Simulation& s) {
        if (s.step() == 0) return;
        largest_velocity = std::max(largest_velocity, largest(whole_flow(s.flow())));
        const auto now = fluxes(s);
        ASSERT_EQ(now.size(), 4u);
        // What passes a whole partition between walls is zero but for how well points stand for a surface, and is left
        // alone; little of that is in the other parts.
        for (std::size_t r = 0; r < now.size(); ++r)
          EXPECT_NEAR(now[r], 0, !has_walls ? 1e-13 : r < 2 ? 1e-4 : 1e-9) << "part " << r;
      });
      EXPECT_GT(largest_velocity, 0.1);
    }
}

TEST(TightWalls, WithoutAnyChoiceLeaveTheFlowAlone) {
  const SharedFolder owner;
  auto config = disturbed(true);
  config.bodies = {tight_plate("partition", {0, 0, 0.1}, {4, 4})};
  const auto run = [&](bool tight) {
    config.bodies[0].tight = tight;
    Simulation simulation(config, Communicator(), silent(owner.path() / (tight ? "tight" : "loose")));
    simulation.run();
    return whole_flow(simulation.flow());
  };
  // Nothing can pass a plate between closed walls that fills the box.
  EXPECT_LT(relative_difference(run(true), run(false)), 1e-12);
}

TEST(TightWalls, AreTheSameOnAnyNumberOfRanksAndByBothSweeps) {
  const SharedFolder owner;
  auto config = disturbed(true);
  config.immersed_boundary.carry_forces = true;
  config.bodies = {in_halves(tight_plate("partition", {0, 0, 0.1}, {4, 4})),
                   tilted(tight_plate("shutter", {0.2, 0.1, -1}, {1.4, 1.4}))};
  config.bodies[1].schedule = ScheduleConfig{0.12, {0.3, 0.8}};
  const Communicator world;
  Simulation alone(config, Communicator(MPI_COMM_SELF),
                   silent(owner.path() / ("alone-" + std::to_string(world.rank()))));
  alone.run();
  config.time.sweeps = Sweeps::plain;
  Simulation together(config, world, silent(owner.path() / "together"));
  together.run();
  EXPECT_LT(relative_difference(whole_flow(together.flow()), whole_flow(alone.flow())), 1e-11);
}

// A stream along z through the hole that a smaller plate shuts within a step.
TEST(TightWalls, HoldAsAValveShuts) {
  const SharedFolder owner;
  auto config = small_box({16, 16, 16});
  config.initial.flow = InitialFlow::uniform;
  config.initial.velocity = {0, 0, 1};
  config.forcing.acceleration = {0, 0, 1};
  config.time.max_steps = 22;
  config.immersed_boundary.carry_forces = true;
  auto plate = tight_plate("plate", {0, 0, 0.1}, {4, 4});
  PlateWithHolesSurface with_hole;
  with_hole.size = {4, 4};
  with_hole.holes = {{0, 0, 0.8}};
  with_hole.edge = 0.25;
  plate.surface = with_hole;
  auto shutter = tight_plate("shutter", {0, 0, 0.1}, {1.5, 1.5});
  shutter.surface = DiscSurface{0.8, 0.25};
  shutter.schedule = ScheduleConfig{1, {0.41, 0.9}};
  plate.marker_refinement = shutter.marker_refinement = 2;
  for (const bool tight : {true, false}) {
    plate.tight = shutter.tight = tight;
    config.bodies = {plate, shutter};
    Simulation simulation(config, Communicator(), silent(owner.path() / (tight ? "tight" : "loose")));
    double through_hole = 0, after = 0;
    simulation.run([&](const Simulation& s) { (s.step() <= 20 ? through_hole : after) = s.flow().bulk_velocity().z; });
    EXPECT_GT(through_hole, 0.05);
    // Plate and shutter are a wall across the box now.
    if (tight) EXPECT_NEAR(after, 0, 1e-4 * through_hole);
    else EXPECT_GT(std::abs(after), 0.05 * through_hole);
  }
}

// Keys that do not apply may be there once others are overridden.
TEST(TightWalls, AreOnlyThoseThatStandStill) {
  const SharedFolder owner;
  auto config = disturbed(true);
  config.bodies = {tilted(tight_plate("shutter", {0.2, 0.1, -0.5}, {1.4, 1.4}))};
  config.bodies[0].motion = MotionKind::prescribed;
  const auto run = [&](bool tight) {
    config.bodies[0].tight = tight;
    Simulation simulation(config, Communicator(), silent(owner.path() / (tight ? "tight" : "loose")));
    simulation.run();
    return whole_flow(simulation.flow());
  };
  EXPECT_TRUE(run(true) == run(false));
}

TEST(TightWalls, RefuseAPartThatIsInAnother) {
  auto config = disturbed(false);
  config.bodies = {in_halves(tight_plate("partition", {0, 0, 0.1}, {4, 4}))};
  config.bodies[0].tight_parts = {"half", "half"};
  const Grid grid(config.box, config.boundary, Communicator());
  EXPECT_THROW(Bodies(config, grid), InputError);
}

// In a periodic box nothing else takes momentum from the flow.
TEST(TightWalls, TakeTheForceThatTheFlowLoses) {
  const SharedFolder owner;
  auto config = disturbed(false);
  config.fluid.density = 3;
  config.time.max_steps = 4;
  config.output.history.every = 1;
  config.bodies = {in_halves(tight_plate("partition", {0, 0, 0.1}, {4, 4})),
                   tilted(in_halves(tight_plate("tilted", {0.2, 0.1, -1}, {1.4, 1.4})))};
  Simulation simulation(config, Communicator(), silent(owner.path()));
  Vec3 before;
  simulation.run([&](const Simulation& s) {
    const Vec3 now = s.flow().bulk_velocity();
    if (s.step() > 0) {
      Vec3 force;
      for (const Vec3 f : all_vectors(s.bodies(), [](const Body& b) { return b.loads.reaction.force; })) force += f;
      const Vec3 lost = config.fluid.density * 64 / *config.time.step * (before - now);
      EXPECT_GT(norm(lost), 1e-3);
      EXPECT_LT(norm(force - lost), 1e-11 * norm(force)) << "step " << s.step();
    }
    before = now;
  });
}

}  // namespace
}  // namespace pliant
