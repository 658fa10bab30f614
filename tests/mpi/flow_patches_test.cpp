#include <gtest/gtest.h>

#include "boundary/flow_patch.hpp"
#include "core/error.hpp"
#include "mpi/against_one_rank.hpp"
#include "signals/make_signal.hpp"

// Flow through patches of the z sides on any number of ranks.
namespace pliant::test {
namespace {

PatchConfig patch(std::string name, PatchShape shape, std::array<double, 2> center, double radius, std::string rate) {
  PatchConfig p;
  p.name = std::move(name);
  p.shape = shape;
  p.center = center;
  p.radius = radius;
  p.flow_rate = std::move(rate);
  p.balance = p.flow_rate.empty();
  return p;
}

PatchConfig ring(std::string name, std::array<double, 2> center, double radius, double inner, std::string rate) {
  auto p = patch(std::move(name), PatchShape::annulus, center, radius, std::move(rate));
  p.inner_radius = inner;
  return p;
}

PatchConfig rectangle(std::string name, std::array<double, 2> center, std::array<double, 2> size, std::string rate) {
  auto p = patch(std::move(name), PatchShape::rectangle, center, 1, std::move(rate));
  p.radius.reset();
  p.size = size;
  return p;
}

PatchConfig rest(std::string name, std::string rate) {
  auto p = patch(std::move(name), PatchShape::outside, {0, 0}, 1, std::move(rate));
  p.radius.reset();
  return p;
}

PatchConfig parabolic(PatchConfig p) {
  p.profile = PatchProfile::parabolic;
  return p;
}

PatchConfig in_phase(PatchConfig p, double begin, double end) {
  p.phase = {begin, end};
  return p;
}

/// A period of 0.06: some steps of 0.01.
Signals beating() {
  SignalConfig beat;
  beat.table = {{0, 0.1}, {0.013, 0.3}, {0.031, -0.2}, {0.05, 0.05}};
  beat.period = 0.06;
  Signals signals;
  signals.emplace("beat", make_signal(beat, "."));
  return signals;
}

struct Case {
  const char* name;
  BoundaryConfig sides;
};

/// Pairs of shapes on one or both sides, balanced by a patch or by an outflow; the box is 1.5 x 1 x 1.2.
std::vector<Case> cases() {
  const auto box = [](BoundarySpec x, BoundarySpec y, BoundarySpec low, BoundarySpec high) {
    return BoundaryConfig{x, x, y, y, low, high};
  };
  const PeriodicSide periodic;
  const FreeSlipSide slip;
  const auto wall = [](std::vector<PatchConfig> patches, Vec3 velocity = {}) { return WallSide{velocity, patches}; };
  const auto disc = PatchShape::disc;
  std::vector<Case> all{
      {"disc and what is outside, on one side", box(WallSide{}, WallSide{}, WallSide{},
                                                    wall({parabolic(patch("in", disc, {0.7, 0.5}, 0.3, "beat")),
                                                          patch("out", PatchShape::outside, {0.7, 0.5}, 0.45, "")}))},
      {"disc opposite to a ring, periodic, the balance beside it",
       box(periodic, periodic, wall({patch("a", disc, {0.1, 0.9}, 0.25, "0.2*sin(40*t)")}),
           wall({parabolic(ring("b", {0.75, 0.5}, 0.45, 0.2, "0.1+t")), rest("out", "")}, {0.3, -0.2, 0}))},
      {"rectangle on a free-slip side, the rest of the other side balances",
       box(WallSide{}, periodic, FreeSlipSide{{parabolic(rectangle("a", {0.5, 0.5}, {0.6, 0.7}, "beat"))}},
           FreeSlipSide{{in_phase(patch("b", disc, {1.1, 0.5}, 0.3, "beat"), 0.3, 0.8), rest("out", "")}})},
      {"phases of a beat",
       box(WallSide{}, WallSide{}, WallSide{},
           wall({in_phase(patch("a", disc, {0.4, 0.5}, 0.25, "beat"), 0, 0.62),
                 in_phase(patch("b", disc, {1.1, 0.5}, 0.25, "beat"), 0.62, 1), rest("out", "")}))}};
  auto through = box(WallSide{}, WallSide{}, wall({patch("a", disc, {0.7, 0.5}, 0.3, "beat")}),
                     wall({ring("b", {0.7, 0.5}, 0.4, 0.2, "-0.1*t")}));
  through[0] = InflowSide{{1, 0, 0}, InflowProfile::parabolic, 0.05};
  through[1] = through[3] = OutflowSide{};
  all.push_back({"inflow and two outflow sides", through});
  auto fed = box(WallSide{}, slip, WallSide{}, wall({rest("out", "")}));
  fed[0] = InflowSide{{1, 0, 0}, InflowProfile::uniform, 0, "sin(60*t)"};
  all.push_back({"a side in, a patch out", fed});
  return all;
}

FlowParameters parameters_of(const BoundaryConfig& sides, ViscousMode mode) {
  FlowParameters parameters;
  parameters.viscosity = 4e-3;
  parameters.viscous = mode;
  parameters.boundary = sides;
  parameters.signals = beating();
  return parameters;
}

Grid grid_of(const BoundaryConfig& sides, MPI_Comm comm, StretchingLaw law, std::array<int, 3> cells = {18, 15, 11}) {
  BoxConfig box;
  box.cells = cells;
  box.size = {1.5, 1, 1.2};
  box.stretching_z = {law, 1.0};
  return Grid(box, sides, Communicator(comm));
}

void start(FlowSolver& solver) {
  InitialConfig initial;
  initial.flow = InitialFlow::perturbed;
  initial.amplitude = 0.3;
  set_initial_flow(solver, initial);
}

/// The flow into the box through the faces of a patch, from the field itself.
double measured_rate(const Grid& grid, int side, const FlowPatch& patch, ConstView<FaceZ> w) {
  const bool here = side == 4 ? grid.has_bottom() : grid.has_top();
  double sum = 0;
  if (here)
    for (const auto& [i, j] : patch.faces) sum += w(i, j, side == 4 ? -1 : grid.nz() - 1);
  return grid.ranks().sum((side == 4 ? 1 : -1) * sum * grid.dx() * grid.dy());
}

TEST(FlowPatches, CarryTheirRateAndBalanceItAtEverySubstep) {
  for (const auto& [name, sides] : cases())
    for (ViscousMode mode : viscous_modes) {
      const Grid grid = grid_of(sides, MPI_COMM_WORLD, StretchingLaw::tanh);
      FlowSolver solver(grid, parameters_of(sides, mode));
      start(solver);
      EXPECT_LT(solver.largest_divergence(), 1e-12) << name;
      const double dt = 0.01;
      double elapsed = 0;
      const auto check = [&](const Substep& s, double step, View<FaceX>, View<FaceY>, View<FaceZ> w) {
        if (s.index == 0) elapsed = 0;
        elapsed += s.alpha * step;
        EXPECT_LT(std::abs(solver.net_outward_flux()), 2e-15) << name;
        auto reported = solver.patch_flow_rates();
        std::size_t at = 0;
        for (int side = 4; side < 6; ++side) {
          const auto* configs = patches_of(sides[static_cast<std::size_t>(side)]);
          if (configs == nullptr) continue;
          for (const auto& p : make_flow_patches(*configs, grid, beating())) {
            const double rate = measured_rate(grid, side, p, w);
            EXPECT_EQ(reported[at].name, p.name);
            EXPECT_NEAR(rate, reported[at++].value, 2e-15) << name;
            if (!p.balances()) { EXPECT_NEAR(rate, p.flow_rate(solver.time() + elapsed), 2e-15) << name; }
          }
        }
        EXPECT_EQ(at, reported.size());
      };
      for (int n = 0; n < 8; ++n) {
        solver.advance(dt, check);
        EXPECT_LT(solver.largest_divergence(), 1e-12) << name;
      }
      EXPECT_LT(solver.kinetic_energy(), 5) << name;
    }
}

// Each rank computes the whole box by itself as well, by plain sweeps, and compares its slab.
TEST(FlowPatches, SlabsGiveTheResultOfPlainSweepsOnOneRank) {
  for (const auto& [name, sides] : cases())
    for (ViscousMode mode : viscous_modes) {
      const Grid shared_grid = grid_of(sides, MPI_COMM_WORLD, StretchingLaw::tanh);
      const Grid own_grid = grid_of(sides, MPI_COMM_SELF, StretchingLaw::tanh);
      auto plain = parameters_of(sides, mode);
      plain.sweeps = Sweeps::plain;
      FlowSolver shared(shared_grid, parameters_of(sides, mode)), own(own_grid, plain);
      for (FlowSolver* solver : {&shared, &own}) {
        start(*solver);
        for (int n = 0; n < 20; ++n) solver->advance(8e-3);
      }
      const auto [difference, scale] = against_one_rank(shared, own);
      EXPECT_LT(difference, 1e-11 * scale) << name;
      EXPECT_GT(scale, 0.1) << "a flow at rest proves nothing";
    }
}

// A patch from edge to edge is an inflow side.
TEST(FlowPatches, APatchOverAWholeSideIsAnInflowSide) {
  for (ViscousMode mode : viscous_modes)
    for (const BoundarySpec& others : {BoundarySpec{PeriodicSide{}}, BoundarySpec{WallSide{}}}) {
      BoundaryConfig patched;
      patched.fill(others);
      patched[5] = OutflowSide{};
      BoundaryConfig inflow = patched;
      patched[4] = WallSide{{}, {rest("in", "0.2+0.1*sin(30*t)")}};
      inflow[4] = InflowSide{{0, 0, 1.0 / 1.5}, InflowProfile::uniform, 0, "0.2+0.1*sin(30*t)"};
      const Grid grid = grid_of(patched, MPI_COMM_WORLD, StretchingLaw::tanh);
      FlowSolver a(grid, parameters_of(patched, mode)), b(grid, parameters_of(inflow, mode));
      for (FlowSolver* solver : {&a, &b}) {
        start(*solver);
        run(*solver, 0.1, 10);
      }
      double difference = 0;
      const auto of_a = velocities_of(a), of_b = velocities_of(b);
      for (std::size_t n = 0; n < of_a.size(); ++n) difference = std::max(difference, std::abs(of_a[n] - of_b[n]));
      EXPECT_LT(grid.ranks().max(difference), 1e-13) << "round-off of the rates alone";
    }
}

// Thin slabs: as many ranks as the box has planes, and boxes of one cell along y.
TEST(FlowPatches, WorkInThinSlabs) {
  BoundaryConfig sides;
  sides[4] = WallSide{{}, {rectangle("in", {0.4, 0.5}, {0.5, 1}, "0.2")}};
  sides[5] = WallSide{{}, {rectangle("out", {1.0, 0.5}, {0.6, 1}, "")}};
  const int planes = Communicator().size();
  for (ViscousMode mode : viscous_modes) {
    const Grid grid = grid_of(sides, MPI_COMM_WORLD, StretchingLaw::uniform, {15, 1, planes});
    FlowSolver solver(grid, parameters_of(sides, mode));
    start(solver);
    run(solver, 0.1, 10);
    EXPECT_LT(solver.largest_divergence(), 1e-12);
    EXPECT_LT(std::abs(solver.net_outward_flux()), 1e-15);
  }
}

TEST(FlowPatches, RefuseWhatTheGridCannotHold) {
  BoundaryConfig sides = walls_along(2);
  sides[5] = WallSide{{}, {patch("tiny", PatchShape::disc, {0.75, 0.51}, 0.001, "")}};
  const Grid grid = grid_of(sides, MPI_COMM_WORLD, StretchingLaw::uniform);
  EXPECT_THROW(FlowSolver(grid, parameters_of(sides, ViscousMode::implicit)), InputError);
}

}  // namespace
}  // namespace pliant::test
