#pragma once
#include <filesystem>
#include <string>

#include "mpi/coupling/all_bodies.hpp"
#include "simulation/simulation.hpp"

namespace pliant {

/// A box of edge 4 about the origin, periodic, without outputs, in steps of 0.02.
inline CaseConfig small_box(std::array<int, 3> cells) {
  CaseConfig config;
  config.box.size = {4, 4, 4};
  config.box.origin = {-2, -2, -2};
  config.box.cells = cells;
  config.fluid.viscosity = 0.05;
  config.time.end = 1000;
  config.time.step = 0.02;
  config.checkpoint.keep = 0;
  config.output.history.every = 1000000;
  return config;
}

inline void put_walls(CaseConfig& config, int direction) {
  for (int side = 2 * direction; side < 2 * direction + 2; ++side)
    config.boundary[static_cast<std::size_t>(side)] = WallSide{};
}

inline BodyConfig ball(std::string name, MotionKind motion, Vec3 center, double radius) {
  BodyConfig body;
  body.name = std::move(name);
  body.surface = SphereSurface{2, radius};
  body.center = center;
  body.motion = motion;
  return body;
}

/// A plate across x that hangs on an axis along y.
inline BodyConfig leaflet(Vec3 center) {
  BodyConfig body;
  body.name = "leaflet";
  body.surface = PlateSurface{{0.8, 0.9}, 0.25};
  body.center = center;
  body.motion = MotionKind::hinge;
  body.rotation = {{0, 1, 0}, 90};
  body.material.density = 5;
  body.material.thickness = 0.15;
  body.hinge.point = center + Vec3{0, 0, 0.4};
  body.hinge.axis = {0, 1, 0};
  body.hinge.min_angle = -20;
  body.hinge.max_angle = 20;
  body.hinge.restitution = 0.5;
  body.hinge.rate = 60;
  return body;
}

inline BodyConfig drop(Vec3 center, double radius) {
  auto body = ball("drop", MotionKind::deformable, center, radius);
  body.coupling = CouplingKind::one_way;
  body.mass_per_vertex = 0.05;
  body.traction.form = TractionForm::drag;
  body.potentials.edge = EdgeConfig{40, 1.0};
  body.potentials.volume = VolumeConfig{500};
  return body;
}

/// A drop that is turned, pinned, tethered, tied and pulled.
inline BodyConfig held_drop(Vec3 center, double radius) {
  auto body = drop(center, radius);
  body.rotation = {{1, 1, 0}, 40};
  body.inner_damping = 0.2;
  body.selections.resize(2);
  body.selections[0].name = "top";
  body.selections[0].sphere = {{0, 0, radius}, 0.3 * radius};
  body.selections[1].name = "side";
  body.selections[1].extreme = {{1, 0.2, 0.1}, 0.1};
  body.pinned = {"top"};
  body.tethers = {{"tether", "side", 3.0, 0.1}};
  body.cords = {{"cord", "side", "", Vec3{0, 2 * radius, 0}, CordEnds::middle, 5.0, {}, 0.8}};
  body.pulls = {{"pull", "side", {0.5, 0, 0.5}}};
  return body;
}

/// A body of every motion in a disturbed flow between walls, on a stretched grid of odd numbers.
inline CaseConfig all_motions() {
  auto config = small_box({11, 10, 13});
  config.box.stretching_z = {StretchingLaw::tanh, 1.0};
  put_walls(config, 2);
  config.initial.flow = InitialFlow::perturbed;
  config.initial.amplitude = 0.5;
  config.forcing.gravity = {0, 0, -1};
  auto told = ball("told", MotionKind::prescribed, {1.1, -1.1, -0.9}, 0.5);
  told.path.x = "0.2*sin(3*t)";
  told.path.z = "t";  // through several slabs
  told.path.angle = "40*t";
  auto thrown = ball("thrown", MotionKind::rigid, {0.9, 1.0, 1.0}, 0.5);
  thrown.material.density = 15;  // a ball of two or three cells moves along more fluid than it displaces
  thrown.rigid.velocity = {1.5, 0.5, -2};
  thrown.rigid.angular_velocity = {1, 2, 3};
  config.bodies = {ball("rock", MotionKind::fixed, {-1.1, -1.1, -1}, 0.5), told, thrown, leaflet({-1.1, 1.0, 0.2}),
                   held_drop({-1.0, -1.0, 0.9}, 0.6)};
  return config;
}

inline SimulationOptions silent(const std::filesystem::path& folder) {
  SimulationOptions options;
  options.output = folder;
  options.progress = ProgressStyle::silent;
  return options;
}

inline CaseConfig until(CaseConfig config, long steps) {
  config.time.max_steps = steps;
  return config;
}

/// u, v, w and p of all cells, whole on every rank of the run. Collective.
inline std::vector<double> whole_flow(const FlowSolver& flow) {
  const auto cells = flow.grid().cells();
  const auto n =
      static_cast<std::size_t>(cells[0]) * static_cast<std::size_t>(cells[1]) * static_cast<std::size_t>(cells[2]);
  std::vector<double> all(4 * n, 0.0);
  const auto tables = flow.state_tables();
  for (std::size_t t = 0; t < 4; ++t)
    flow.save_table(t, std::span(all).subspan(t * n + static_cast<std::size_t>(tables[t].first) * tables[t].row_size,
                                              tables[t].size()));
  flow.grid().ranks().sum(all);
  return all;
}

inline double largest(const std::vector<double>& values) {
  double size = 0;
  for (const double v : values) size = std::max(size, std::abs(v));
  return size;
}

/// Largest difference over the largest value.
inline double relative_difference(const std::vector<double>& a, const std::vector<double>& b) {
  if (a.size() != b.size()) return 1e300;
  double difference = 0;
  for (std::size_t n = 0; n < a.size(); ++n) {
    const double d = std::abs(a[n] - b[n]);
    if (!(d <= difference)) difference = d;  // what is not a number is kept
  }
  return difference / largest(b);
}

}  // namespace pliant
