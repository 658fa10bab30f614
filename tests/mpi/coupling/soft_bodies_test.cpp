#include <gtest/gtest.h>

#include <cmath>
#include <random>

#include "coupling/vertex_transfer.hpp"
#include "diagnostics/shape.hpp"
#include "mesh/geometry.hpp"
#include "mpi/coupling/small_cases.hpp"
#include "mpi/io/shared_folder.hpp"

namespace pliant {
namespace {

/// An elastic shell of about four cells radius across the middle of a periodic box.
CaseConfig shell_in(int cells, CouplingKind coupling, int frequency = 4) {
  auto config = small_box({cells, cells, cells});
  config.fluid.viscosity = 0.02;
  config.initial.flow = InitialFlow::taylor_green;
  config.initial.normal = Axis::y;
  auto shell = ball("shell", MotionKind::deformable, {0.1, 0.2, -0.1}, 1.0);
  shell.surface = SphereSurface{frequency, 1.0};
  shell.coupling = coupling;
  shell.potentials.edge = EdgeConfig{4, 1.0};
  config.bodies = {shell};
  return config;
}

struct Outcome {
  std::vector<double> flow, vertices;
};

Outcome run(const CaseConfig& config, const Communicator& ranks, const std::filesystem::path& folder) {
  Simulation simulation(config, ranks, silent(folder));
  simulation.run();
  return {whole_flow(simulation.flow()), all_vertices(simulation.bodies())};
}

CaseConfig soft_bodies_of_every_kind() {
  auto config = all_motions();
  config.time.max_steps = 12;
  auto light = drop({-1.0, -1.0, 0.9}, 0.6);
  light.name = "light";
  light.coupling = CouplingKind::force_spreading;
  light.mass_per_vertex = 0.0;
  light.potentials.volume.reset();
  auto heavy = light;
  heavy.name = "heavy";
  heavy.center = {1.0, -1.0, 0.9};
  heavy.mass_per_vertex = 0.01;
  heavy.held = true;
  auto stiff = heavy;
  stiff.name = "stiff";
  stiff.center = {0, 0, 1.1};
  stiff.held = false;
  stiff.coupling = CouplingKind::local_mass;
  for (auto& body : config.bodies)
    if (body.motion == MotionKind::rigid || body.motion == MotionKind::hinge) body.coupling = CouplingKind::loose;
  config.bodies.back() = light;
  config.bodies.push_back(heavy);
  config.bodies.push_back(stiff);
  return config;
}

TEST(SoftBodies, AreTheSameOnAnyNumberOfRanks) {
  const auto config = soft_bodies_of_every_kind();
  const SharedFolder owner;
  const auto together = run(config, Communicator(), owner.path() / "together");
  const auto again = run(config, Communicator(), owner.path() / "again");
  EXPECT_TRUE(together.flow == again.flow) << "the same bits, run after run";
  EXPECT_TRUE(together.vertices == again.vertices);
  const auto single =
      run(config, Communicator(MPI_COMM_SELF), owner.path() / ("alone-" + std::to_string(Communicator().rank())));
  EXPECT_LT(relative_difference(together.flow, single.flow), 1e-11);
  EXPECT_LT(relative_difference(together.vertices, single.vertices), 1e-11);
}

TEST(SoftBodies, DeformableBodiesCoupledLooselyAndStronglyAreTheSameOnAnyNumberOfRanks) {
  for (const auto coupling : {CouplingKind::loose, CouplingKind::strong}) {
    auto config = shell_in(12, coupling, 3);
    config.bodies[0].mass_per_vertex = 0.5;
    config.coupling.tolerance = 1e-10;  // two ways to the same point
    config.time.max_steps = 4;
    const SharedFolder owner;
    const auto together = run(config, Communicator(), owner.path() / "together");
    const auto single =
        run(config, Communicator(MPI_COMM_SELF), owner.path() / ("alone-" + std::to_string(Communicator().rank())));
    EXPECT_LT(relative_difference(together.flow, single.flow), 1e-9);
    EXPECT_LT(relative_difference(together.vertices, single.vertices), 1e-9);
  }
}

TEST(SoftBodies, FusedSweepsAreThePlainOnes) {
  auto config = soft_bodies_of_every_kind();
  for (const auto mode : {ViscousMode::implicit, ViscousMode::explicit_rk3}) {
    config.time.viscous = mode;
    const SharedFolder owner;
    config.time.sweeps = Sweeps::fused;
    const auto fused = run(config, Communicator(), owner.path() / "fused");
    config.time.sweeps = Sweeps::plain;
    const auto plain = run(config, Communicator(), owner.path() / "plain");
    EXPECT_LT(relative_difference(fused.flow, plain.flow), 1e-11);
    EXPECT_LT(relative_difference(fused.vertices, plain.vertices), 1e-11);
  }
}

// In the release build as well: a compiler that thinks two arrays are one loses forces.
TEST(VertexTransfer, ConservesForceAndPower) {
  for (const int frequency : {2, 6}) {  // points within faces, and the vertices themselves
    auto config = shell_in(14, CouplingKind::force_spreading, frequency);
    config.fluid.density = 1.7;
    const Grid grid(config.box, config.boundary, Communicator());
    Bodies bodies(config, grid);
    EXPECT_EQ(bodies.kinds()[0].meets_flow_at_vertices, frequency == 6);
    VertexTransfer transfer(grid, config.fluid.density);
    transfer.place(bodies, CouplingKind::force_spreading);

    FlowParameters parameters;
    parameters.boundary = config.boundary;
    FlowSolver solver(grid, parameters);
    auto& state = solver.state();
    std::mt19937 random(1 + static_cast<unsigned>(grid.ranks().rank()));
    std::uniform_real_distribution<double> number(-1, 1);
    const auto fill = [&](auto field) {
      for (int k = 0; k < grid.nz(); ++k)
        for (int j = 0; j < grid.ny(); ++j)
          for (int i = 0; i < grid.nx(); ++i) field(i, j, k) = number(random);
    };
    fill(state.u.view());
    fill(state.v.view());
    fill(state.w.view());
    solver.fill_ghosts();
    FlowState before(grid);
    const auto copy = [&](auto to, auto from) {
      for (int k = 0; k < grid.nz(); ++k)
        for (int j = 0; j < grid.ny(); ++j)
          for (int i = 0; i < grid.nx(); ++i) to(i, j, k) = from(i, j, k);
    };
    copy(before.u.view(), state.u.view());
    copy(before.v.view(), state.v.view());
    copy(before.w.view(), state.w.view());

    std::vector<Vec3> forces(transfer.n_vertices()), velocities;
    for (Vec3& f : forces) f = {number(random), number(random), number(random)};
    transfer.find_velocities(state.u.view(), state.v.view(), state.w.view(), velocities);
    std::array<double, 4> given{}, taken{};
    for (std::size_t i = 0; i < forces.size(); ++i) {
      for (int c = 0; c < 3; ++c) given[static_cast<std::size_t>(c)] += forces[i][c];
      given[3] += dot(forces[i], velocities[i]);
    }
    transfer.spread_forces(forces);
    transfer.fields().gather();
    transfer.fields().move_to(1, state.u.view(), state.v.view(), state.w.view());
    const double cell = grid.dx() * grid.dy() * grid.dz_c()[0] * config.fluid.density;
    const auto take = [&](auto now, auto then, std::size_t c) {
      for (int k = 0; k < grid.nz(); ++k)
        for (int j = 0; j < grid.ny(); ++j)
          for (int i = 0; i < grid.nx(); ++i) {
            const double change = cell * (now(i, j, k) - then(i, j, k));
            taken[c] += change;
            taken[3] += change * then(i, j, k);
          }
    };
    take(state.u.view(), before.u.view(), 0);
    take(state.v.view(), before.v.view(), 1);
    take(state.w.view(), before.w.view(), 2);
    grid.ranks().sum(given);
    grid.ranks().sum(taken);
    for (std::size_t c = 0; c < 4; ++c) EXPECT_NEAR(taken[c], given[c], 1e-11) << c;
  }
}

double whole_energy(const Simulation& simulation, const CaseConfig& config) {
  double energy = 0;
  for (const Body& body : simulation.bodies().own()) {
    const auto shape = measure_shape(body.surface);
    for (const auto& [name, value] : shape.energies) energy += value;
  }
  const Vec3 size = config.box.size;
  return Communicator().sum(energy) + size.x * size.y * size.z * simulation.flow().kinetic_energy();
}

TEST(SoftBodies, EnergyOnlyFallsAndTheVolumeStays) {
  for (const auto coupling : {CouplingKind::force_spreading, CouplingKind::local_mass}) {
    auto config = shell_in(20, coupling, 6);
    config.fluid.viscosity = 0.002;
    config.bodies[0].potentials.edge->stiffness = 0.5;
    config.time.max_steps = 80;
    const SharedFolder owner;
    Simulation simulation(config, Communicator(), silent(owner.path()));
    const double at_start = whole_energy(simulation, config);
    double last = at_start, volume = 0, stretched = 0;
    simulation.run([&](const Simulation& s) {
      const double energy = whole_energy(s, config);
      EXPECT_LE(energy, last + 1e-4 * at_start);
      last = energy;
      for (const Body& body : s.bodies().own()) {
        const double now = enclosed_volume(body.surface.mesh, body.surface.positions);
        if (volume == 0) volume = now;
        EXPECT_NEAR(now, volume, 1e-12);
        stretched = measure_shape(body.surface).ellipsoid.length;
      }
    });
    EXPECT_LT(last, at_start);
    EXPECT_GT(Communicator().max(stretched), 1.02) << "a shell that does not deform proves nothing";
  }
}

// Its vibrations, from slow ones of the whole shell to those that steps of the flow do not resolve.
TEST(SoftBodies, LightStiffWallsGainNoEnergyByLocalMass) {
  for (const double stiffness : {30.0, 1000.0})
    for (const double mass : {0.02, 0.004}) {
      auto config = shell_in(16, CouplingKind::local_mass, 5);
      config.fluid.viscosity = 0.001;
      auto& shell = config.bodies[0];
      shell.potentials = {};
      shell.material.thickness = 0.02;
      shell.material.density = mass / 0.02;
      shell.material.young = stiffness / 0.02;
      config.time.step = 0.03;
      config.time.max_steps = 80;
      const SharedFolder owner;
      Simulation simulation(config, Communicator(), silent(owner.path()));
      const double at_start = whole_energy(simulation, config);
      simulation.run([&](const Simulation& s) { EXPECT_LE(whole_energy(s, config), (1 + 1e-4) * at_start); });
    }
}

TEST(SoftBodies, AllSchemesFindTheSameMotionInSmallSteps) {
  std::vector<std::vector<double>> found;
  for (const auto coupling : {CouplingKind::force_spreading, CouplingKind::local_mass, CouplingKind::strong}) {
    auto config = shell_in(16, coupling, 5);
    config.bodies[0].mass_per_vertex = 0.02;
    config.bodies[0].volume_correction = false;
    config.time.step = 0.005;
    config.time.max_steps = 60;
    const SharedFolder owner;
    Simulation simulation(config, Communicator(), silent(owner.path()));
    simulation.run();
    const auto vertices = all_vertices(simulation.bodies());
    std::vector<double> positions(vertices.begin(),
                                  vertices.begin() + static_cast<std::ptrdiff_t>(vertices.size() / 3));
    found.push_back(positions);
  }
  // Over R = 1 they have moved by some tenths.
  for (std::size_t s = 1; s < found.size(); ++s)
    for (std::size_t n = 0; n < found[0].size(); ++n) ASSERT_NEAR(found[s][n], found[0][n], 0.03);
}

TEST(SoftBodies, AHeldBodyStaysAndTellsItsDrag) {
  auto config = shell_in(16, CouplingKind::force_spreading, 5);
  config.initial.flow = InitialFlow::uniform;
  config.initial.velocity = {1, 0, 0};
  config.bodies[0].held = true;
  config.bodies[0].potentials.edge->stiffness = 40;
  config.time.max_steps = 20;
  const SharedFolder owner;
  Simulation simulation(config, Communicator(), silent(owner.path()));
  double impulse = 0, before = 0;
  simulation.run([&](const Simulation& s) {
    if (s.step() == 0) before = s.flow().bulk_velocity().x;
    double drag = 0;
    for (const Body& body : s.bodies().own()) {
      EXPECT_NEAR(measure_shape(body.surface).ellipsoid.centroid.x, 0.1, 1e-3);
      drag = body.loads.balance.force.x;
    }
    if (s.step() > 0) impulse += 0.02 * Communicator().sum(drag);
  });
  EXPECT_GT(impulse, 0);
  const double lost = 64 * (before - simulation.flow().bulk_velocity().x);
  EXPECT_NEAR(impulse, lost, 1e-10);
}

// The iterations of others take the flow back to the start of the step, and so these bodies.
TEST(SoftBodies, MoveOnceAStepWhenOthersIterate) {
  std::vector<std::vector<Vec3>> centers;
  for (const auto coupling : {CouplingKind::loose, CouplingKind::strong}) {
    auto config = shell_in(16, CouplingKind::force_spreading, 4);
    config.initial.flow = InitialFlow::uniform;
    config.initial.velocity = {0.5, 0, 0};
    config.bodies[0].surface = SphereSurface{4, 0.6};
    auto stiff = config.bodies[0];
    stiff.name = "stiff";
    stiff.center = {0.1, 0.2, 1.4};
    stiff.surface = SphereSurface{3, 0.4};
    stiff.coupling = CouplingKind::local_mass;
    auto stone = ball("stone", MotionKind::rigid, {-1.2, -1.2, -1.2}, 0.5);
    stone.material.density = 30;
    stone.coupling = coupling;
    config.bodies.insert(config.bodies.end(), {stiff, stone});
    config.coupling.tolerance = 1e-8;
    config.time.max_steps = 10;
    const SharedFolder owner;
    Simulation simulation(config, Communicator(), silent(owner.path()));
    simulation.run();
    centers.push_back(all_vectors(simulation.bodies(), [](const Body& b) { return b.pose.center; }));
  }
  for (std::size_t b = 0; b < 2; ++b) {
    EXPECT_GT(norm(centers[0][b] - (b == 0 ? Vec3{0.1, 0.2, -0.1} : Vec3{0.1, 0.2, 1.4})), 0.05);
    EXPECT_LT(norm(centers[1][b] - centers[0][b]), 0.002);
  }
}

TEST(SoftBodies, PinnedVerticesStay) {
  for (const auto coupling : {CouplingKind::force_spreading, CouplingKind::local_mass}) {
    auto config = shell_in(16, coupling, 5);
    SelectionConfig cap;
    cap.name = "cap";
    cap.sphere = SelectionConfig::Sphere{{0, 0, 1}, 0.5};
    config.bodies[0].selections = {cap};
    config.bodies[0].pinned = {"cap"};
    config.time.max_steps = 20;
    const SharedFolder owner;
    Simulation simulation(config, Communicator(), silent(owner.path()));
    simulation.run();
    double moved = 0;
    for (const Body& body : simulation.bodies().own())
      for (std::size_t v = 0; v < body.surface.positions.size(); ++v) {
        const double distance = norm(body.surface.positions[v] - body.surface.reference[v]);
        if (body.surface.is_pinned(v)) { EXPECT_EQ(distance, 0); }
        moved = std::max(moved, distance);
      }
    EXPECT_GT(Communicator().max(moved), 0.05);
  }
}

}  // namespace
}  // namespace pliant
