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

/// The sum of what flows between neighbouring cells: along(x, y) times it, x and y their centres. By every rank alike.
template <class Along>
double flow_between_cells(const FlowSolver& flow, Along along) {
  const Grid& grid = flow.grid();
  const auto all = whole_flow(flow);
  const auto& n = grid.cells();
  const auto center = [&](int i, int j, int k) {
    const double turn = k == n[2] ? grid.size().z : 0;
    return Vec3{grid.x_center(i), grid.y_center(j), grid.global_z_center()[k == n[2] ? 0 : k] + turn};
  };
  double sum = 0;
  for (int k = 0; k < n[2]; ++k)
    for (int j = 0; j < n[1]; ++j)
      for (int i = 0; i < n[0]; ++i)
        for (int d = 0; d < 3; ++d) {
          const std::array<int, 3> at{i, j, k};
          if (!grid.is_periodic(d) && at[static_cast<std::size_t>(d)] == n[static_cast<std::size_t>(d)] - 1) continue;
          const double dz = grid.global_dz_c()[k];
          const double area = d == 0 ? grid.dy() * dz : d == 1 ? grid.dx() * dz : grid.dx() * grid.dy();
          const auto node = static_cast<std::size_t>(i + n[0] * (j + n[1] * (k + n[2] * d)));
          sum += area * all[node] * along(center(i, j, k), center(i + (d == 0), j + (d == 1), k + (d == 2)));
        }
  return sum;
}

/// Of a plate at a height: +1 upwards through the faces of one of its parts, seen from above, -1 downwards.
auto through_faces(const BodyKind& kind, std::size_t part, double height) {
  return [&kind, part, height](Vec3 x, Vec3 y) {
    if (x.z >= height || y.z < height) return 0;
    const auto is_left = [&](Vec3 p, Vec3 q) { return (q.x - p.x) * (x.y - p.y) - (q.y - p.y) * (x.x - p.x) > 0; };
    for (const Face& face : kind.tight_parts[part]) {
      const auto at = [&](std::size_t c) { return kind.prototype.positions[static_cast<std::size_t>(face[c])]; };
      const bool first = is_left(at(0), at(1));
      if (first == is_left(at(1), at(2)) && first == is_left(at(2), at(0))) return first ? 1 : -1;
    }
    return 0;
  };
}

/// Of a square that `back` turns into a plane of z: through it, upwards then.
auto through_square(Vec3 center, const Mat3& back, double size) {
  return [=](Vec3 x, Vec3 y) {
    const auto in_frame = [&](Vec3 q) { return back * (q - center); };
    const Vec3 a = in_frame(x), b = in_frame(y);
    if ((a.z < 0) == (b.z < 0)) return 0;
    const Vec3 at = a + a.z / (a.z - b.z) * (b - a);
    if (std::abs(at.x) > size / 2 || std::abs(at.y) > size / 2) return 0;
    return a.z < 0 ? 1 : -1;
  };
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
                       tilted(tight_plate("tilted", {0.2, 0.1, -1}, {1.4, 1.4})),
                       ball("stone", MotionKind::fixed, {-1, -1, 1.1}, 0.5)};
      const Mat3 back = rotation_about(config.bodies[1].rotation.axis, -config.bodies[1].rotation.angle);
      Simulation simulation(config, Communicator(), silent(owner.path()));
      double largest_velocity = 0;
      simulation.run([&](const Simulation& s) {
        if (s.step() == 0) return;
        largest_velocity = std::max(largest_velocity, largest(whole_flow(s.flow())));
        const auto& partition = s.bodies().kinds()[0];
        ASSERT_EQ(partition.tight_parts.size(), 2u);
        for (std::size_t part = 0; part < 2; ++part)
          EXPECT_NEAR(flow_between_cells(s.flow(), through_faces(partition, part, 0.1)), 0, 1e-13);
        EXPECT_NEAR(flow_between_cells(s.flow(), through_square({0.2, 0.1, -1}, back, 1.4)), 0, 1e-13);
      });
      EXPECT_GT(largest_velocity, 0.1);
    }
}

TEST(TightWalls, WithoutAnyChoiceLeaveTheFlowAlone) {
  const SharedFolder owner;
  auto config = disturbed(true);
  const auto run = [&](bool tight) {
    config.bodies[0].tight = tight;
    Simulation simulation(config, Communicator(), silent(owner.path() / (tight ? "tight" : "loose")));
    simulation.run();
    return whole_flow(simulation.flow());
  };
  // Nothing can pass a plate between closed walls that fills the box, nor a tube from wall to wall.
  const auto plate = tight_plate("partition", {0, 0, 0.1}, {4, 4});
  auto tube = tight_plate("tube", {0.1, 0.1, 0}, {1, 1});
  tube.surface = CylinderSurface{1.2, 3.99, 0.25, CylinderEnds::open};
  for (const auto& body : {plate, tube}) {
    config.bodies = {body};
    EXPECT_LT(relative_difference(run(true), run(false)), 1e-12) << body.name;
  }
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
    if (tight) EXPECT_NEAR(after, 0, 1e-13);
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
