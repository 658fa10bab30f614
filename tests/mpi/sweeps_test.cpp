#include <gtest/gtest.h>

#include <algorithm>

#include "convergence/flow_fixture.hpp"
#include "mpi/first_ranks.hpp"

// Fused sweeps against plain ones, and against themselves with everybody looking at the state in between.
namespace pliant::test {
namespace {

struct Flow {
  BoundaryConfig sides;
  std::array<int, 3> cells{24, 18, 17};
  ViscousMode mode = ViscousMode::implicit;
  StretchingLaw law = StretchingLaw::uniform;
  bool with_bulk = false, with_hook = false;
};

FlowSolver begin(const Grid& grid, const Flow& flow, Sweeps sweeps) {
  FlowParameters parameters;
  parameters.viscosity = 2e-3;
  parameters.viscous = flow.mode;
  parameters.sweeps = sweeps;
  parameters.boundary = flow.sides;
  if (flow.with_bulk) parameters.forcing.bulk_velocity = ForcingConfig::BulkVelocity{Axis::x, 0.4};
  FlowSolver solver(grid, parameters);
  InitialConfig initial;
  initial.flow = InitialFlow::perturbed;
  initial.velocity = {0.4, 0.1, -0.2};
  set_initial_flow(solver, initial);
  return solver;
}

Grid make_grid(const Flow& flow, const Communicator& ranks) {
  BoxConfig box;
  box.cells = flow.cells;
  box.size = {1.5, 1, 1.2};
  box.stretching_z = {flow.law, 1.0};
  return Grid(box, flow.sides, ranks);
}

// As a body would: the flow is held back in a ball in the middle.
PredictedFlowHook hold_back(const Grid& grid) {
  return [&grid](const Substep&, double, View<FaceX> u, View<FaceY> v, View<FaceZ> w) {
    const auto damp = [&](auto field, int component) {
      for (int k = 0; k < grid.nz(); ++k)
        for (int j = 0; j < grid.ny(); ++j)
          for (int i = 0; i < grid.nx(); ++i)
            if (norm(position_of(grid, component, i, j, k) - Vec3{0.75, 0.5, 0.6}) < 0.3) field(i, j, k) *= 0.5;
    };
    damp(u, 0);
    damp(v, 1);
    damp(w, 2);
  };
}

void step(FlowSolver& solver, const Flow& flow) {
  if (flow.with_hook) solver.advance(5e-3, hold_back(solver.grid()));
  else solver.advance(5e-3);
}

Sweeps in_use(const Grid& grid) {
  return sweeps_in_use(Sweeps::fused, grid.cells()[2], grid.is_periodic(2), grid.ranks().size());
}

struct Difference {
  double velocity = 0, pressure = 0;  // largest, over the largest value
  double rate = 0;
};

Difference difference(const FlowSolver& a, const FlowSolver& b) {
  const auto& ranks = a.grid().ranks();
  const auto u = b.state().u.view();
  const auto v = b.state().v.view();
  const auto w = b.state().w.view();
  double worst = 0, scale = 0, worst_p = 0, scale_p = 0;
  for_each_velocity(a, [&](int c, int i, int j, int k, double value) {
    const double other = c == 0 ? u(i, j, k) : c == 1 ? v(i, j, k) : w(i, j, k);
    worst = std::max(worst, std::abs(value - other));
    scale = std::max(scale, std::abs(other));
    const double p = a.state().p.view()(i, j, k), q = b.state().p.view()(i, j, k);
    worst_p = std::max(worst_p, std::abs(p - q));
    scale_p = std::max(scale_p, std::abs(q));
  });
  return {ranks.max(worst) / ranks.max(scale), ranks.max(worst_p) / ranks.max(scale_p),
          std::abs(a.step_rate() - b.step_rate()) / b.step_rate()};
}

std::vector<BoundaryConfig> all_sides() {
  std::vector<BoundaryConfig> all;
  for (int closed = 0; closed < 8; ++closed)
    for (const bool slip : {false, true}) {
      if (closed == 0 && slip) continue;
      BoundaryConfig sides;
      for (int d = 0; d < 3; ++d)
        if ((closed >> d & 1) != 0)
          for (std::size_t s = 0; s < 2; ++s) {
            auto& side = sides[2 * static_cast<std::size_t>(d) + s];
            if (slip) side = FreeSlipSide{};
            else
              side = WallSide{Vec3{0.1, -0.2, 0.3} - (d == 0   ? Vec3{0.1, 0, 0}
                                                      : d == 1 ? Vec3{0, -0.2, 0}
                                                               : Vec3{0, 0, 0.3})};
          }
      all.push_back(sides);
    }
  for (int d = 0; d < 3; ++d)  // through the box in every direction
    for (int beside = 0; beside < 2; ++beside) {
      BoundaryConfig sides;
      Vec3 velocity;
      velocity[d] = 1;
      sides[static_cast<std::size_t>(2 * d)] = InflowSide{velocity, InflowProfile::uniform, 0.05};
      sides[static_cast<std::size_t>(2 * d + 1)] = OutflowSide{};
      const int other = d == 2 ? 0 : 2;
      for (std::size_t s = 0; s < 2; ++s) {
        auto& side = sides[2 * static_cast<std::size_t>(other) + s];
        if (beside == 0) side = WallSide{};
        else side = FreeSlipSide{};
      }
      all.push_back(sides);
    }
  return all;
}

constexpr ViscousMode modes[] = {ViscousMode::explicit_rk3, ViscousMode::implicit_z, ViscousMode::implicit};

TEST(Sweeps, FusedEqualsPlain) {
  const Communicator ranks;
  int n = 0;
  for (const auto& sides : all_sides())
    for (const ViscousMode mode : modes)
      for (const StretchingLaw law : {StretchingLaw::uniform, StretchingLaw::tanh}) {
        ++n;
        const Flow flow{sides, {n % 2 == 0 ? 24 : 15, n % 3 == 0 ? 16 : 9, 13 + n % 4}, mode, law, false, n % 2 == 0};
        const Grid grid = make_grid(flow, ranks);
        auto plain = begin(grid, flow, Sweeps::plain), fused = begin(grid, flow, Sweeps::fused);
        for (int s = 0; s < 3; ++s) {
          step(plain, flow);
          step(fused, flow);
        }
        const auto d = difference(fused, plain);
        EXPECT_LT(d.velocity, 1e-13) << "flow " << n << ", mode " << static_cast<int>(mode);
        EXPECT_LT(d.rate, 1e-13) << "flow " << n << ", mode " << static_cast<int>(mode);
        // The pressure of a step is a difference of velocities over its length.
        EXPECT_LT(d.pressure, 1e-11) << "flow " << n << ", mode " << static_cast<int>(mode);
        EXPECT_LT(fused.largest_divergence(), 1e-12);
      }
}

// Slabs of two, three and four planes, whose early planes are all or nearly all that they have.
TEST(Sweeps, ThinSlabsAreServed) {
  const Communicator ranks;
  for (int planes = 2; planes <= 4; ++planes)
    for (const bool closed : {false, true})
      for (const ViscousMode mode : modes) {
        const Flow flow{
            closed ? walls_along(2) : periodic_box(), {8, 6, planes * ranks.size() + ranks.size() / 2}, mode};
        const Grid grid = make_grid(flow, ranks);
        ASSERT_EQ(in_use(grid), Sweeps::fused);
        auto plain = begin(grid, flow, Sweeps::plain), fused = begin(grid, flow, Sweeps::fused);
        for (int s = 0; s < 3; ++s) {
          step(plain, flow);
          step(fused, flow);
        }
        EXPECT_LT(difference(fused, plain).velocity, 1e-13) << planes << " planes, closed " << closed;
      }
}

TEST(Sweeps, ASlabOfOnePlaneIsLeftToPlainSweeps) {
  const Communicator ranks;
  const Flow flow{periodic_box(), {8, 6, ranks.size()}};
  const Grid grid = make_grid(flow, ranks);
  EXPECT_EQ(in_use(grid), Sweeps::plain);
  auto solver = begin(grid, flow, Sweeps::fused);
  step(solver, flow);
  EXPECT_LT(solver.largest_divergence(), 1e-12);
}

// Whoever looks at the state between two steps sees it corrected, and does not change what follows by a bit.
TEST(Sweeps, LookingChangesNothing) {
  const Communicator ranks;
  for (const auto& sides : {periodic_box(), walls_along(2, {-0.5, 0, 0}, {0.5, 0, 0}), walls_along(1)})
    for (const ViscousMode mode : modes)
      for (const bool bulk : {false, true})
        for (const bool hook : {false, true}) {
          const Flow flow{sides, {16, 12, 13}, mode, StretchingLaw::tanh, bulk, hook};
          const Grid grid = make_grid(flow, ranks);
          auto looked = begin(grid, flow, Sweeps::fused), left = begin(grid, flow, Sweeps::fused);
          FlowSolver::Snapshot snapshot;
          for (int s = 0; s < 5; ++s) {
            step(looked, flow);
            step(left, flow);
            EXPECT_LT(looked.largest_divergence(), 1e-12);
            if (s == 2) looked.save_state(snapshot);
            if (s == 3) {  // and back
              looked.restore_state(snapshot);
              step(looked, flow);
            }
          }
          const auto d = difference(looked, left);
          EXPECT_EQ(d.velocity, 0);
          EXPECT_EQ(d.pressure, 0);
          EXPECT_EQ(d.rate, 0);
        }
}

// What bench/README.md says that a substep sends, message by message and byte by byte.
TEST(Sweeps, SendWhatTheModelSays) {
  const Communicator ranks;
  const int n = ranks.size(), r = ranks.rank();
  for (const ViscousMode mode : {ViscousMode::explicit_rk3, ViscousMode::implicit})
    for (const bool closed : {false, true}) {
      const Flow flow{closed ? walls_along(2) : periodic_box(), {14, 10, 4 * n + 1}, mode};
      const Grid grid = make_grid(flow, ranks);
      auto solver = begin(grid, flow, Sweeps::fused);
      step(solver, flow);
      const auto before = grid.ranks().traffic();
      step(solver, flow);
      const auto after = grid.ranks().traffic();

      const long below = n > 1 && (r > 0 || !closed), above = n > 1 && (r < n - 1 || !closed);
      const long planes = below * (3 + 2) + above * (3 + 1);  // predicted velocity, pressure increment
      const auto exchange = [&](long lines) {
        const long share = lines * (r + 1) / n - lines * r / n;
        return 2 * (lines - share) + 2 * share * (n - 1);
      };
      const int solves = mode == ViscousMode::explicit_rk3 ? 1 : 4;
      const long doubles = planes * PlaneLayout(grid).plane + exchange(16 * 10) + (solves - 1) * exchange(14 * 10);
      EXPECT_EQ(after.messages - before.messages, 3 * (planes + solves * 2 * (n - 1)));
      EXPECT_EQ(after.bytes - before.bytes, 3 * 8 * (n > 1 ? doubles : 0));
    }
}

}  // namespace
}  // namespace pliant::test
