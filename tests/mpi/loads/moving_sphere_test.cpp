#include <gtest/gtest.h>

#include <functional>

#include "loads/momentum_balance.hpp"
#include "loads/probe_loads.hpp"
#include "mpi/transfer/sphere_in_flow.hpp"
#include "transfer/mls_sampler.hpp"

namespace pliant::test {
namespace {

// A sphere that moves along a line in a fluid at rest, in a periodic box of 30 cells; lengths in cells.
struct Motion {
  std::function<double(double)> position, velocity, acceleration;
};

struct Force {
  double balance, first_order, second_order;  // momentum balance and probes, one-sided and quadratic
};

std::vector<Force> forces_of(const Motion& motion, double viscosity, double dt, int steps, int parts) {
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
    layout.place(positions, velocities, markers);
    forcing.place(markers.positions, markers.areas, markers.velocities);
    solver.advance(dt, [&](const Substep& s, double h, View<FaceX> u, View<FaceY> v, View<FaceZ> w) {
      forcing.apply(s, h, u, v, w);
    });

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
      std::vector<Vec3> points;
      probe_points(sites, settings, points);
      std::vector<FlowSample> samples(points.size());
      sampler.sample(points, samples);
      ProbeLoads loads;
      evaluate_probes(sites, settings, samples, loads);
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
  const auto square = [](double x) { return x * x; };
  const auto exact = [&](double r, double t) {
    return exact_force(r, viscosity, layer, motion.velocity(t), motion.acceleration(t));
  };
  double scale = 0, balance = 0, enlarged = 0, first_order = 0, second_order = 0, markers = 0;
  for (int n = period; n < 2 * period; ++n) {
    const auto& force = forces[static_cast<std::size_t>(n)];
    const double middle = (n + 0.5) * dt, end = (n + 1) * dt;  // forces of markers are means over the step
    scale += square(exact(radius, middle));
    balance += square(force.balance - exact(radius, middle));
    enlarged += square(force.balance - exact(radius + forced_surface_offset, middle));
    first_order += square(force.first_order - exact(radius, end));
    second_order += square(force.second_order - exact(radius, end));
    markers += square(force.balance - of_many[static_cast<std::size_t>(n)].balance);
  }
  const auto error = [&](double sum) { return std::sqrt(sum / scale); };
  EXPECT_LT(error(markers), 0.01) << "nine times the markers, the same force";
  // The sphere acts on the fluid as one that is a quarter of a cell larger: its volume, and so the added mass, by 13 %.
  EXPECT_LT(error(balance), 0.13);
  EXPECT_LT(error(enlarged), 0.06);
  // Probes of 1.5 cells on a sphere of 6: errors of the order (h/R)^2 and h/R.
  EXPECT_LT(error(second_order), error(first_order));
  EXPECT_LT(error(second_order), 0.3);
}

// A sphere that spins steadily in a fluid of which the box holds little beyond: torque about -8 pi mu R^3 omega.
TEST(SpinningSphere, FeelsTheTorqueOfStokesFlow) {
  SphereInFlow box;
  box.cells = 30;
  box.diameter = 12;
  const double viscosity = 2, radius = 6, dt = 0.1;
  const Vec3 omega{0.01, -0.02, 0.03}, center = center_of(box);
  const Grid grid = make_grid(box);
  FlowParameters parameters;
  parameters.viscosity = viscosity;
  FlowSolver solver(grid, parameters);
  solver.fill_ghosts();
  auto surface = make_icosphere(8, radius);
  for (Vec3& x : surface.positions) x += center;
  std::vector<Vec3> velocities, accelerations;
  for (Vec3 x : surface.positions) {
    velocities.push_back(cross(omega, x - center));
    accelerations.push_back(cross(omega, velocities.back()));
  }
  const MarkerLayout layout(surface.mesh, 1);
  MarkerSet markers;
  layout.place(surface.positions, velocities, markers);
  DirectForcing forcing(grid, 1.0);
  forcing.place(markers.positions, markers.areas, markers.velocities);
  for (int n = 0; n < 360; ++n)
    solver.advance(dt, [&](const Substep& s, double h, View<FaceX> u, View<FaceY> v, View<FaceZ> w) {
      forcing.apply(s, h, u, v, w);
    });
  std::vector<Vec3> on_markers(markers.positions.size());
  forcing.add_forces(on_markers);
  const auto felt = total_load(markers.positions, on_markers, center);
  double sums[3] = {felt.torque.x, felt.torque.y, felt.torque.z};
  grid.ranks().sum(sums);
  const Vec3 torque{sums[0], sums[1], sums[2]}, stokes = (-8 * M_PI * viscosity * radius * radius * radius) * omega;
  std::printf("balance/stokes %.3f %.3f %.3f\n", torque.x / stokes.x, torque.y / stokes.y, torque.z / stokes.z);
  SurfaceSites sites;
  set_sites(surface.mesh, surface.positions, velocities, accelerations, sites);
  const auto& flow = solver.state();
  const MlsSampler sampler(grid, {&flow.u, &flow.v, &flow.w, &flow.p}, 1.0);
  for (const ProbeForm form : {ProbeForm::gradient, ProbeForm::one_sided, ProbeForm::quadratic}) for (double h : {1.0, 1.5,2.0}) for (bool turn : {true,false}) {
    const ProbeSettings settings{form, Wetting::outside, h, forced_surface_offset, 1.0, viscosity, {}};
    auto ss=sites; if(!turn) for (auto& r:ss.normal_rates) r={};
    std::vector<Vec3> points;
    probe_points(sites, settings, points);
    std::vector<FlowSample> samples(points.size());
    sampler.sample(points, samples);
    ProbeLoads loads;
    evaluate_probes(ss, settings, samples, loads);
    const auto t = total_load(sites.positions, loads.forces, center).torque;
    std::printf("form %d h %g turn %d: %.3f\n", (int)form, h, turn, dot(t,stokes)/dot(stokes,stokes));
  }
}

}  // namespace
}  // namespace pliant::test
