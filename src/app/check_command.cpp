#include <fmt/format.h>
#include <mpi.h>

#include <algorithm>
#include <cmath>
#include <memory>
#include <span>
#include <vector>

#include "app/command.hpp"
#include "app/dimensionless.hpp"
#include "app/load_case.hpp"
#include "app/memory_estimate.hpp"
#include "config/print_case.hpp"
#include "core/error.hpp"
#include "coupling/added_mass.hpp"
#include "coupling/describe_kind.hpp"
#include "coupling/local_mass.hpp"
#include "coupling/make_body_kind.hpp"
#include "coupling/one_way.hpp"
#include "flow/flow_solver.hpp"
#include "signals/make_signal.hpp"
#include "simulation/ejection.hpp"
#include "simulation/time_step.hpp"
#include "structure/place_bodies.hpp"
#include "structure/stable_time_step.hpp"
#include "transfer/markers.hpp"

namespace pliant {
namespace {
struct CheckArguments {
  CaseArguments input;
  int ranks = 0;  // 0: those that run
};

/// A bound on |u|/dx + |v|/dy + |w|/dz of the initial flow, known without computing it.
double initial_rate(const InitialConfig& initial, const Grid& grid) {
  const double a = std::abs(initial.amplitude);
  const Vec3 mean{std::abs(initial.velocity.x), std::abs(initial.velocity.y), std::abs(initial.velocity.z)};
  Vec3 speed;
  switch (initial.flow) {
    case InitialFlow::rest:
    case InitialFlow::couette:
      break;  // Couette: the walls are the fastest
    case InitialFlow::uniform:
      speed = mean;
      break;
    case InitialFlow::poiseuille:
      speed[static_cast<int>(initial.direction)] = a;
      break;
    case InitialFlow::taylor_green:
      for (int d = 0; d < 3; ++d) speed[d] = d == static_cast<int>(initial.normal) ? 0 : a;
      break;
    case InitialFlow::perturbed:
      speed = mean + Vec3{a, a, a};
      break;
  }
  return grid.convective_rate(speed);
}

std::string number(double value) { return std::isfinite(value) ? fmt::format("{:.6g}", value) : "none"; }

struct CheckedBodies {
  std::vector<BodyKind> kinds;
  std::vector<long> copies;
};

bool acts_on_flow(const CheckedBodies& bodies) {
  return std::any_of(bodies.kinds.begin(), bodies.kinds.end(), [](auto& kind) { return kind.acts_on_flow(); });
}

/// After the viscous solves, so that a viscous flow falls behind.
bool forces_flow(const CheckedBodies& bodies) {
  return std::any_of(bodies.kinds.begin(), bodies.kinds.end(),
                     [](auto& kind) { return kind.forces_flow() || kind.coupling == CouplingKind::local_mass; });
}

CheckedBodies make_bodies(const CaseConfig& config, const Grid& grid) {
  CheckedBodies bodies;
  for (auto& placed : place_bodies(config)) {
    bodies.kinds.push_back(make_body_kind(config, bodies.kinds.size(), std::move(placed.shape), grid));
    bodies.copies.push_back(static_cast<long>(placed.placements.size()));
  }
  if (acts_on_flow(bodies)) require_room_for_markers(grid);
  return bodies;
}

void print_memory(const CaseConfig& config, const CheckedBodies& bodies, int ranks) {
  const auto memory = estimate_memory(config, ranks);
  double body_bytes = 0;
  for (std::size_t k = 0; k < bodies.kinds.size(); ++k)
    body_bytes += std::ceil(static_cast<double>(bodies.copies[k]) / ranks) *
                  estimate_body_bytes(bodies.kinds[k].prototype.mesh.n_vertices());
  fmt::print(
      "# memory of a rank: {:.4g} MB for the flow ({:.1f} doubles a cell; {} of {} planes on the fullest of {} "
      "rank{})",
      memory.flow_bytes / 1e6, memory.doubles_per_cell, memory.planes, config.box.cells[2], ranks,
      ranks == 1 ? "" : "s");
  if (!bodies.kinds.empty()) fmt::print(", about {:.2g} MB for the bodies", body_bytes / 1e6);
  fmt::print("\n");
}

/// The drag of every vertex over its velocity where the traction is a drag; else none that helps stability.
std::vector<double> drag_of(const DeformableBody& body, double viscosity) {
  std::vector<double> drag(body.masses.size(), 0.0);
  if (body.traction.form != TractionForm::drag) return drag;
  for (std::size_t i = 0; i < drag.size(); ++i)
    drag[i] = body.traction.coefficient * viscosity * body.reference_areas[i] / body.radius;
  return drag;
}

void print_springs(const CaseConfig& config, const DeformableBody& body, double step) {
  const double limit = stable_time_step(body, drag_of(body, config.fluid.viscosity));
  const double needed = std::max(1.0, std::ceil(step / (substep_safety * limit)));
  fmt::print("#   springs    {} for body {} of {} vertices and {} faces: {} substeps in a step of the fluid{}\n",
             number(limit), body.name, body.mesh.n_vertices(), body.mesh.n_faces(),
             body.substeps ? static_cast<double>(*body.substeps) : needed,
             body.substeps && *body.substeps < needed ? " (as given; stability asks for more)" : "");
}

void print_softness(const BodyKind& kind, double step) {
  if (kind.coupling == CouplingKind::force_spreading) {
    fmt::print("#   stiffness  {} for body {} of {} vertices\n", number(force_spreading_limit(kind)), kind.config.name,
               kind.prototype.mesh.n_vertices());
    return;
  }
  fmt::print("#   stiffness  none for body {} of {} vertices: {} substeps in the longest substep of the flow\n",
             kind.config.name, kind.prototype.mesh.n_vertices(),
             local_mass_substeps(largest_alpha, step, kind.layered_limit, kind.config.name));
}

void print_patches(const CaseConfig& config, const Grid& grid) {
  const auto signals = make_signals(config);
  for (const auto& side : config.boundary)
    if (const auto* patches = patches_of(side))
      for (const auto& patch : make_flow_patches(*patches, grid, signals))
        fmt::print("# patch {}: {} faces of the grid, area {:.6g}\n", patch.name, patch.faces.size(), patch.area);
}

void print_cavities(const CaseConfig& config) {
  if (config.cavities.empty()) return;
  const auto placed = place_bodies(config);
  auto fitted = config;
  const auto fits = set_ejection_scales(fitted, placed);
  for (const auto& cavity : config.cavities) {
    fmt::print("# cavity {}: volume {:.6g} at the start", cavity.name, start_volume(cavity, config, placed));
    for (const auto& fit : fits)
      if (fit.cavity == cavity.name)
        fmt::print("; {:.6g} to {:.6g} in a cycle (ejection fraction {:.4g}) with signal {} scaled by {:.6g}",
                   fit.smallest_volume, fit.largest_volume, *cavity.ejection_fraction, fit.signal, fit.scale);
    fmt::print("\n");
  }
}

StepLimits limits_at_start(const CaseConfig& config, const Grid& grid, const CheckedBodies& bodies) {
  const double viscous = viscous_step_limit(grid, config.fluid.viscosity / config.fluid.density, config.time.viscous);
  const double sides = OpenSides(grid, config.boundary, make_signals(config)).largest_rate(config.time.end);
  double soft = no_limit;
  for (const auto& kind : bodies.kinds)
    if (kind.coupling == CouplingKind::force_spreading) soft = std::min(soft, force_spreading_limit(kind));
  return step_limits(config, grid, std::max(initial_rate(config.initial, grid), sides), viscous, soft);
}

void print_steps(const CaseConfig& config, const Grid& grid, const CheckedBodies& bodies) {
  auto adaptive = config;
  adaptive.time.step.reset();
  const auto limits = limits_at_start(adaptive, grid, bodies), ruling = limits_at_start(config, grid, bodies);
  const double step = ruling.smallest();
  fmt::print("# time-step limits at the start:\n");
  fmt::print("#   convective {} (Courant number {:.4g})\n", number(limits.convective), config.time.cfl);
  fmt::print("#   viscous    {}\n", number(limits.viscous));
  fmt::print("#   decay      {} (a tenth of the longest wave's viscous time)\n", number(limits.decay));
  for (const auto& kind : bodies.kinds)
    if (kind.is_soft()) print_softness(kind, step);
    else if (!kind.has_pose()) print_springs(config, kind.prototype, step);
  fmt::print("# the fluid's step: {}, ruled by {}\n", number(step), ruling.ruling());
  if (const double viscous_number = forcing_viscous_number(config, grid, step);
      forces_flow(bodies) && viscous_number > largest_forcing_viscous_number)
    fmt::print(
        "# warning: that is {:.2g} h^2/nu, above {}: drag of bodies falls short (time.max_step, "
        "immersed_boundary.forcing_iterations)\n",
        viscous_number, largest_forcing_viscous_number);
}

void print_sweeps(const CaseConfig& config, const Grid& grid, int ranks) {
  const auto sweeps = sweeps_in_use(config.time.sweeps, config.box.cells[2], grid.is_periodic(2), ranks);
  const bool is_open_box = OpenSides(grid, config.boundary, make_signals(config)).any();
  fmt::print("# sweeps: {}\n", sweeps == Sweeps::plain ? config.time.sweeps == Sweeps::plain
                                                             ? "plain, as asked for"
                                                             : "plain: slabs of one plane are too thin for fused ones"
                               : is_open_box
                                   ? "fused, with a correction of its own in every substep: fluid passes the sides"
                                   : "fused");
}

int check(const CheckArguments& arguments, const Communicator& communicator) {
  const int ranks = arguments.ranks > 0 ? arguments.ranks : communicator.size();
  const auto config = load_case(arguments.input, ranks);
  if (!communicator.is_root()) return exit_success;
  const Grid grid(config.box, config.boundary, Communicator(MPI_COMM_SELF));
  const auto bodies = make_bodies(config, grid);
  fmt::print("{}\n# --- The case is sound.\n", to_toml(config));
  print_memory(config, bodies, ranks);
  print_patches(config, grid);
  for (const auto& line : describe_signals(config)) fmt::print("# {}\n", line);
  print_cavities(config);
  print_sweeps(config, grid, ranks);
  print_steps(config, grid, bodies);
  const double step = limits_at_start(config, grid, bodies).smallest();
  for (const auto& line : dimensionless_groups(config, grid, bodies.kinds)) fmt::print("# {}\n", line);
  for (const auto& line : physical_sizes(config, grid, step)) fmt::print("# {}\n", line);
  for (std::size_t k = 0; k < bodies.kinds.size(); ++k) {
    fmt::print("# {}\n", describe(bodies.kinds[k], bodies.copies[k]));
    for (const auto& warning : foresee(bodies.kinds[k], grid, step)) fmt::print("# warning: {}\n", warning);
  }
  return exit_success;
}
}  // namespace

void add_check_command(CLI::App& app, Action& action) {
  auto arguments = std::make_shared<CheckArguments>();
  auto* command =
      app.add_subcommand("check", "Read and validate a case; print it with all defaults, its memory and time step");
  add_case_arguments(*command, arguments->input);
  command->add_option("--ranks", arguments->ranks, "Check for a run on so many ranks")->check(CLI::PositiveNumber);
  command->callback(
      [arguments, &action] { action = [arguments](const Communicator& ranks) { return check(*arguments, ranks); }; });
}

}  // namespace pliant
