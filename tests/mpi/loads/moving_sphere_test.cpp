#include <gtest/gtest.h>

#include <functional>

#include "loads/momentum_balance.hpp"
#include "mpi/transfer/sphere_in_flow.hpp"
#include "transfer/mls_sampler.hpp"
#include "unit/loads/sampled_loads.hpp"

namespace pliant::test {
namespace {

// A sphere that moves along a line in a fluid at rest, in a periodic box of 30 cells; lengths in cells.
struct Motion {
  std::function<double(double)> position, velocity, acceleration;
};

struct Force {
  double balance, first_order, second_order;  // momentum balance and probes, one-sided and quadratic
};

std::vector<Force> forces_of(const Motion& motion, double viscosity, double dt, int steps, int parts,
                             double retraction = 0) {
  SphereInFlow box;
  box.cells = 30;
  box.diameter = 12;
  const Grid grid = make_grid(box);
  FlowParameters parameters;
  parameters.viscosity = viscosity;
  FlowSolver solver(grid, parameters);
  solver.fill_ghosts();
  const auto surface = make_icosphere(8, box.diameter / 2);
  const MarkerLayout layout(surface.mesh, parts);
  const std::size_t n = surface.positions.size();
  auto positions = surface.positions;
  std::vector<Vec3> velocities(n), accelerations(n);
  MarkerSet markers;
  DirectForcing forcing(grid, 1.0);
  const Vec3 along{1, 0, 0};
  std::vector<Force> result;
  for (int step = 0; step < steps; ++step) {
    const double old_time = step * dt, time = old_time + dt;
    for (std::size_t v = 0; v < n; ++v) {
      positions[v] = center_of(box) + surface.positions[v] + motion.position(time) * along;
      velocities[v] = motion.velocity(time) * along;
      accelerations[v] = motion.acceleration(time) * along;
    }
    layout.place_inside(positions, velocities, retraction, markers);
    forcing.place(markers.positions, markers.areas, markers.velocities);
    advance(solver, forcing, dt);

    std::vector<Vec3> on_markers(markers.positions.size());
    forcing.add_forces(on_markers);
    Vec3 sum;
    for (Vec3 f : on_markers) sum += f;
    const InnerFluid inner{1.0, enclosed_moments(surface.mesh, positions), {}};
    const double rate = (motion.velocity(time) - (step > 0 ? motion.velocity(old_time) : 0)) / dt;
    const double felt = grid.ranks().sum(sum.x);
    Force force{momentum_balance({{felt, 0, 0}, {}}, inner, {rate * along, {}, {}}, {}).force.x, 0, 0};

    SurfaceSites sites;
    set_sites(surface.mesh, positions, velocities, accelerations, sites);
    const auto& flow = solver.state();
    const MlsSampler sampler(grid, {&flow.u, &flow.v, &flow.w, &flow.p}, 1.0);
    for (const ProbeForm form : {ProbeForm::one_sided, ProbeForm::quadratic}) {
      const ProbeSettings settings{form, Wetting::outside, 1.5, forced_surface_offset, 1.0, viscosity, {}};
      const auto loads = loads_of(sites, settings, sampler);
      (form == ProbeForm::quadratic ? force.second_order : force.first_order) =
          total_load(sites.positions, loads.forces, {}).force.x;
    }
    result.push_back(force);
  }
  return result;
}

// Force of a viscous fluid at rest on a sphere that oscillates by little: Landau and Lifshitz, Fluid Mechanics, section
// 24, with layer = sqrt(2 nu / omega).
double exact_force(double radius, double viscosity, double layer, double velocity, double acceleration) {
  return -6 * M_PI * viscosity * radius * (1 + radius / layer) * velocity -
         (2 * M_PI / 3 * radius + 3 * M_PI * layer) * radius * radius * acceleration;
}

// The second period of a sphere of 6 cells radius in a Stokes layer of 2.
TEST(MovingSphere, FeelsDragAndAddedMassOfAnOscillation) {
  const double omega = 0.5, amplitude = 0.25, radius = 6, viscosity = 1, dt = 0.1, layer = 2;
  const Motion motion{[=](double t) { return amplitude * (1 - std::cos(omega * t)); },
                      [=](double t) { return amplitude * omega * std::sin(omega * t); },
                      [=](double t) { return amplitude * omega * omega * std::cos(omega * t); }};
  const int period = static_cast<int>(2 * M_PI / omega / dt + 0.5);
  const auto forces = forces_of(motion, viscosity, dt, 2 * period, 1);
  const auto of_many = forces_of(motion, viscosity, dt, 2 * period, 3);
  const auto of_inner = forces_of(motion, viscosity, dt, 2 * period, 1, marker_retraction);
  const auto square = [](double x) { return x * x; };
  const auto exact = [&](double r, double t) {
    return exact_force(r, viscosity, layer, motion.velocity(t), motion.acceleration(t));
  };
  double scale = 0, balance = 0, enlarged = 0, inner = 0, first_order = 0, second_order = 0, markers = 0;
  for (int n = period; n < 2 * period; ++n) {
    const auto& force = forces[static_cast<std::size_t>(n)];
    const double middle = (n + 0.5) * dt, end = (n + 1) * dt;  // forces of markers are means over the step
    scale += square(exact(radius, middle));
    balance += square(force.balance - exact(radius, middle));
    enlarged += square(force.balance - exact(radius + forced_surface_offset, middle));
    inner += square(of_inner[static_cast<std::size_t>(n)].balance - exact(radius, middle));
    first_order += square(force.first_order - exact(radius, end));
    second_order += square(force.second_order - exact(radius, end));
    markers += square(force.balance - of_many[static_cast<std::size_t>(n)].balance);
  }
  const auto error = [&](double sum) { return std::sqrt(sum / scale); };
  EXPECT_LT(error(markers), 0.01) << "nine times the markers, the same force";
  // The sphere acts on the fluid as one that is a quarter of a cell larger: its volume, and so the added mass, by 13 %.
  EXPECT_LT(error(balance), 0.13);
  EXPECT_LT(error(enlarged), 0.06);
  EXPECT_LT(error(inner), 0.06) << "unless its markers stand inside";
  // Probes of 1.5 cells on a sphere of 6: errors of the order (h/R)^2 and h/R.
  EXPECT_LT(error(second_order), error(first_order));
  EXPECT_LT(error(second_order), 0.3);
}

struct Spun {
  double balance, gradient, one_sided, quadratic;  // torques over that of the exact flow
};

// A sphere that starts to spin in a fluid at rest, after the time 2 R^2 / nu. With x = R sqrt(p / nu), the Laplace
// transform of the torque is that of Stokes times 1 + x^2 / (3 (1 + x)), so that its decay in time is, s = nu t / R^2,
// -8 pi mu R^3 omega (1 + (1/sqrt(pi s) - exp(s) erfc(sqrt(s)))/3), for a sphere of the polyhedron's volume.
Spun spin(double retraction, double probe_length) {
  SphereInFlow box;
  box.cells = 30;
  box.diameter = 12;
  const double viscosity = 2, time = 36, dt = 0.1;
  const Vec3 omega{0.01, -0.02, 0.03}, center = center_of(box);
  const Grid grid = make_grid(box);
  FlowParameters parameters;
  parameters.viscosity = viscosity;
  FlowSolver solver(grid, parameters);
  solver.fill_ghosts();
  auto surface = make_icosphere(8, box.diameter / 2);
  const double volume = enclosed_volume(surface.mesh, surface.positions);
  std::vector<Vec3> velocities, accelerations;
  for (Vec3& x : surface.positions) {
    velocities.push_back(cross(omega, x));
    accelerations.push_back(cross(omega, velocities.back()));
    x += center;
  }
  MarkerSet markers;
  MarkerLayout(surface.mesh).place_inside(surface.positions, velocities, retraction, markers);
  DirectForcing forcing(grid, 1.0);
  forcing.place(markers.positions, markers.areas, markers.velocities);
  for (int n = 0; n < static_cast<int>(time / dt + 0.5); ++n) advance(solver, forcing, dt);

  const double cube = 3 * volume / (4 * M_PI), s = viscosity * time / std::cbrt(cube * cube);
  const double unsteady = 1 + (1 / std::sqrt(M_PI * s) - std::exp(s) * std::erfc(std::sqrt(s))) / 3;
  const Vec3 exact = (-8 * M_PI * viscosity * cube * unsteady) * omega;
  const auto part = [&](Vec3 torque) { return dot(torque, exact) / dot(exact, exact); };
  std::vector<Vec3> on_markers(markers.positions.size());
  forcing.add_forces(on_markers);
  // Part by part over the ranks, as the part is linear; the inner fluid spins steadily by now.
  Spun result{grid.ranks().sum(part(total_load(markers.positions, on_markers, center).torque)), 0, 0, 0};

  SurfaceSites sites;
  set_sites(surface.mesh, surface.positions, velocities, accelerations, sites);
  const auto& flow = solver.state();
  const MlsSampler sampler(grid, {&flow.u, &flow.v, &flow.w, &flow.p}, 1.0);
  const auto probed = [&](ProbeForm form) {
    const double offset = retraction > 0 ? 0 : forced_surface_offset;
    const ProbeSettings settings{form, Wetting::outside, probe_length, offset, 1.0, viscosity, {}};
    return part(total_load(sites.positions, loads_of(sites, settings, sampler).forces, center).torque);
  };
  result.gradient = probed(ProbeForm::gradient);
  result.one_sided = probed(ProbeForm::one_sided);
  result.quadratic = probed(ProbeForm::quadratic);
  return result;
}

TEST(SpinningSphere, FeelsTheTorqueOfTheExactFlow) {
  const auto on = spin(0, 1.5), inside = spin(marker_retraction, 1.5);
  // As a sphere that is a fifth of a cell larger: (6.2/6)^3 = 1.10.
  EXPECT_NEAR(on.balance, 1.10, 0.03);
  EXPECT_NEAR(inside.balance, 1, 0.03);
  for (const auto& s : {on, inside}) {
    // u - omega x r falls as 1 - 2 h/R at first: the first-order forms miss h/R and more, the second-order one its
    // square and what the layer of forcing disturbs.
    EXPECT_NEAR(s.quadratic, 1, 0.06);
    EXPECT_LT(std::abs(s.quadratic - 1), std::abs(s.one_sided - 1));
    EXPECT_LT(std::abs(s.one_sided - 1), std::abs(s.gradient - 1));
  }
}

}  // namespace
}  // namespace pliant::test
