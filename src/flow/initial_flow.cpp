#include <array>
#include <cmath>
#include <numbers>
#include <random>

#include "flow/flow_solver.hpp"

namespace pliant {
namespace {

using std::numbers::pi;

/// Sets a component from a function of its own positions.
template <class Location, class Function>
void set_field(const Grid& grid, View<Location> f, Function&& value) {
  constexpr bool on_x = std::is_same_v<Location, FaceX>, on_y = std::is_same_v<Location, FaceY>,
                 on_z = std::is_same_v<Location, FaceZ>;
  const auto z_c = grid.z_center(), z_f = grid.z_face();
  for (int k = 0; k < grid.nz(); ++k)
    for (int j = 0; j < grid.ny(); ++j)
      for (int i = 0; i < grid.nx(); ++i)
        f(i, j, k) = value(Vec3{on_x ? grid.x_face(i) : grid.x_center(i), on_y ? grid.y_face(j) : grid.y_center(j),
                                on_z ? z_f[k] : z_c[k]});
}

/// The three components from a velocity field velocity(position).
template <class Function>
void set_velocity(FlowSolver& solver, Function&& velocity) {
  const Grid& grid = solver.grid();
  auto& state = solver.state();
  set_field(grid, state.u.view(), [&](Vec3 p) { return velocity(p).x; });
  set_field(grid, state.v.view(), [&](Vec3 p) { return velocity(p).y; });
  set_field(grid, state.w.view(), [&](Vec3 p) { return velocity(p).z; });
}

Vec3 side_velocity(const BoundarySpec& side) {
  const auto* wall = std::get_if<WallSide>(&side);
  return wall == nullptr ? Vec3{} : wall->velocity;
}

/// Position in the box as fractions of its size.
Vec3 fractions(const Grid& grid, Vec3 p) {
  const Vec3 d = p - grid.origin();
  return {d.x / grid.size().x, d.y / grid.size().y, d.z / grid.size().z};
}

void set_couette(FlowSolver& solver, int normal) {
  const auto& sides = solver.parameters().boundary;
  const Vec3 low = side_velocity(sides[static_cast<std::size_t>(2 * normal)]);
  const Vec3 high = side_velocity(sides[static_cast<std::size_t>(2 * normal + 1)]);
  set_velocity(solver, [&](Vec3 p) {
    const double s = fractions(solver.grid(), p)[normal];
    return (1 - s) * low + s * high;
  });
}

void set_poiseuille(FlowSolver& solver, int direction, int normal, double centre_velocity) {
  set_velocity(solver, [&](Vec3 p) {
    const double s = fractions(solver.grid(), p)[normal];
    Vec3 u;
    u[direction] = 4 * centre_velocity * s * (1 - s);
    return u;
  });
}

void set_taylor_green(FlowSolver& solver, int normal, double amplitude) {
  const int a = (normal + 1) % 3, b = (normal + 2) % 3;
  const double ka = 2 * pi / solver.grid().size()[a], kb = 2 * pi / solver.grid().size()[b];
  set_velocity(solver, [&](Vec3 p) {
    const Vec3 d = p - solver.grid().origin();
    Vec3 u;
    u[a] = amplitude * std::cos(ka * d[a]) * std::sin(kb * d[b]);
    u[b] = -amplitude * ka / kb * std::sin(ka * d[a]) * std::cos(kb * d[b]);
    return u;
  });
}

/// A mean velocity and a random superposition of long waves, damped towards bounded sides; not solenoidal yet. The
/// same field on any number of ranks.
void set_perturbed(FlowSolver& solver, Vec3 mean, double amplitude, std::uint64_t seed) {
  struct Wave {
    std::array<int, 3> number;
    Vec3 direction;
    double phase;
  };
  std::mt19937_64 random(seed);
  // The standard fixes the generator's bits but not its distributions.
  const auto uniform = [&] { return static_cast<double>(random() >> 11) * 0x1.0p-53; };
  std::array<Wave, 24> waves;
  for (auto& wave : waves) {
    for (int& n : wave.number) n = static_cast<int>(uniform() * 9) - 4;
    for (int d = 0; d < 3; ++d) wave.direction[d] = 2 * uniform() - 1;
    wave.phase = 2 * pi * uniform();
  }
  const double scale = amplitude / std::sqrt(static_cast<double>(waves.size()) / 6);
  set_velocity(solver, [&](Vec3 p) {
    const Vec3 s = fractions(solver.grid(), p);
    Vec3 u;
    for (const auto& wave : waves) {
      const double angle = 2 * pi * (wave.number[0] * s.x + wave.number[1] * s.y + wave.number[2] * s.z) + wave.phase;
      u += std::sin(angle) * wave.direction;
    }
    double damping = scale;
    for (int d = 0; d < 3; ++d)
      if (!solver.grid().is_periodic(d)) damping *= std::sin(pi * s[d]);
    return mean + damping * u;
  });
}

}  // namespace

void set_initial_flow(FlowSolver& solver, const InitialConfig& initial) {
  const int normal = static_cast<int>(initial.normal);
  switch (initial.flow) {
    case InitialFlow::rest:
      set_velocity(solver, [](Vec3) { return Vec3{}; });
      break;
    case InitialFlow::uniform:
      set_velocity(solver, [&](Vec3) { return initial.velocity; });
      break;
    case InitialFlow::couette:
      set_couette(solver, normal);
      break;
    case InitialFlow::poiseuille:
      set_poiseuille(solver, static_cast<int>(initial.direction), normal, initial.amplitude);
      break;
    case InitialFlow::taylor_green:
      set_taylor_green(solver, normal, initial.amplitude);
      break;
    case InitialFlow::perturbed:
      set_perturbed(solver, initial.velocity, initial.amplitude, initial.seed);
      break;
  }
  // Only these need not be solenoidal as they are.
  if (solver.has_open_sides() || initial.flow == InitialFlow::perturbed) solver.project_initial();
  else solver.fill_ghosts();
}

}  // namespace pliant
