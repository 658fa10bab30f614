#include "app/dimensionless.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <numbers>
#include <numeric>

#include "boundary/flow_patch.hpp"
#include "config/quantity.hpp"
#include "mesh/geometry.hpp"
#include "signals/balance.hpp"
#include "signals/make_signal.hpp"

namespace pliant {
namespace {

double largest_of(const std::string& text, const Signals& signals, double end) {
  const auto signal = make_signal_or_formula(text, signals);
  const auto range = range_of(signal, signal.period().value_or(end));
  return std::max(std::abs(range.largest), std::abs(range.least));
}

double fastest_prescribed(const CaseConfig& config, const Grid& grid) {
  const auto signals = make_signals(config);
  const double end = config.time.end;
  constexpr int samples = 2000;
  double speed = 0;
  for (const auto& side : config.boundary) {
    if (const auto* wall = std::get_if<WallSide>(&side)) speed = std::max(speed, norm(wall->velocity));
    if (const auto* inflow = std::get_if<InflowSide>(&side))
      speed = std::max(
          speed, norm(inflow->velocity) * (inflow->signal.empty() ? 1 : largest_of(inflow->signal, signals, end)));
    if (const auto* patches = patches_of(side))
      for (const auto& patch : make_flow_patches(*patches, grid, signals))
        if (patch.signal)
          for (int n = 0; n <= samples; ++n)
            speed = std::max(
                speed, std::abs(patch.flow_rate(patch.signal->period().value_or(end) * n / samples)) / patch.area);
  }
  if (const auto& bulk = config.forcing.bulk_velocity) speed = std::max(speed, std::abs(bulk->value));
  const auto& initial = config.initial;
  using enum InitialFlow;
  if (initial.flow == uniform || initial.flow == perturbed) speed = std::max(speed, norm(initial.velocity));
  if (initial.flow == poiseuille || initial.flow == taylor_green || initial.flow == perturbed)
    speed = std::max(speed, std::abs(initial.amplitude));
  return speed;
}

/// Every period of a case with what has it.
std::map<double, std::string> periods_of(const CaseConfig& config) {
  std::map<double, std::string> periods;
  const auto add = [&](double period, const std::string& owner) {
    auto& owners = periods[period];
    owners += (owners.empty() ? "" : ", ") + owner;
  };
  for (const auto& [name, signal] : config.signals)
    if (signal.period) add(*signal.period, "signal " + name);
  for (const auto& body : config.bodies)
    if (body.schedule) add(body.schedule->period, "body " + body.name);
  return periods;
}

std::string groups_of(const BodyKind& kind, const CaseConfig& config, double speed) {
  const auto& body = kind.config;
  const double pressure = config.fluid.density * speed * speed;  // times the length 1: force / length
  std::string groups;
  const auto add = [&](const char* what, double value) {
    groups += fmt::format("{}{} {:.4g}", groups.empty() ? "" : ", ", what, value);
  };
  const auto& positions = kind.prototype.positions;
  if (kind.is_free() && kind.is_closed())
    add("mass over that of the fluid displaced", kind.mass / (config.fluid.density * kind.displaced.volume));
  if (!kind.has_pose() || (kind.is_free() && !kind.is_closed())) {
    const auto& masses = kind.prototype.masses;
    const double mass = kind.has_pose() ? kind.mass : std::accumulate(masses.begin(), masses.end(), 0.0);
    if (mass > 0) add("mass over rho A L", mass / (config.fluid.density * total_area(kind.prototype.mesh, positions)));
  }
  if (!kind.has_pose()) {
    const auto& p = body.potentials;
    if (body.material.young) {
      const double h = body.material.thickness;
      add("E h/(rho U^2 L)", *body.material.young * h / pressure);
      add("bending E h^3/(12 (1 - nu^2) rho U^2 L^3)",
          *body.material.young * h * h * h / (12 * (1 - body.material.poisson * body.material.poisson) * pressure));
    }
    if (p.edge) add("k_e/(rho U^2 L)", p.edge->stiffness / pressure);
    if (p.membrane) add("G_s/(rho U^2 L)", p.membrane->shear / pressure);
    if (p.bending) add("k_b/(rho U^2 L^3)", p.bending->stiffness / pressure);
    if (p.surface_tension && p.surface_tension->sigma > 0) {
      add("We", pressure / p.surface_tension->sigma);
      add("Ca", config.fluid.viscosity * speed / p.surface_tension->sigma);
    }
  }
  return groups;
}

}  // namespace

std::string with_prefix(double value, const std::string& unit) {
  constexpr std::array prefixes{"p", "n", "u", "m", "", "k", "M", "G", "T"};
  if (value == 0 || !std::isfinite(value)) return fmt::format("{} {}", value, unit);
  const int thousands = std::clamp(static_cast<int>(std::floor(std::log10(std::abs(value)) / 3 + 1e-9)), -4, 4);
  return fmt::format("{:.4g} {}{}", value / std::pow(1000.0, thousands),
                     prefixes[static_cast<std::size_t>(thousands + 4)], unit);
}

std::vector<std::string> dimensionless_groups(const CaseConfig& config, const Grid& grid,
                                              const std::vector<BodyKind>& kinds) {
  const double prescribed = config.units ? 0 : fastest_prescribed(config, grid),
               speed = prescribed > 0 ? prescribed : 1;
  const double nu = config.fluid.viscosity / config.fluid.density;
  std::vector<std::string> lines;
  lines.push_back(fmt::format("dimensionless groups, by the length L = 1 and the velocity U = {:.6g} ({}):", speed,
                              prescribed > 0 ? "the fastest that the case prescribes; of a patch the mean"
                              : config.units ? "those of [units]"
                                             : "as the case prescribes none"));
  lines.push_back(nu > 0 ? fmt::format("  Re = U L/nu = {:.6g}", speed / nu)
                         : "  Re infinite: the fluid has no viscosity");
  for (const auto& [period, owner] : periods_of(config)) {
    auto line = fmt::format("  period T = {:.6g} ({}): Strouhal L/(U T) = {:.6g}", period, owner, 1 / (speed * period));
    if (nu > 0)
      line += fmt::format(", Womersley (L/2) sqrt(2 pi/(T nu)) = {:.6g}",
                          0.5 * std::sqrt(2 * std::numbers::pi / (period * nu)));
    lines.push_back(std::move(line));
  }
  for (const auto& kind : kinds)
    if (const auto groups = groups_of(kind, config, speed); !groups.empty())
      lines.push_back(fmt::format("  body {}: {}", kind.config.name, groups));
  return lines;
}

std::vector<std::string> physical_sizes(const CaseConfig& config, const Grid& grid, double step) {
  const auto scales = config.units ? scales_of(*config.units) : std::nullopt;
  if (!scales) return {};
  const auto own = [&](Dimension d) { return scales->of(d); };
  std::vector<std::string> lines;
  lines.push_back(
      fmt::format("1 in the case's own units is: length {}, time {}, velocity {}, density {:.6g} kg/m^3, mass {}, "
                  "force {}, pressure "
                  "{}, flow rate {:.4g} mL/s",
                  with_prefix(own({1, 0, 0}), "m"), with_prefix(own({0, 1, 0}), "s"),
                  with_prefix(own({1, -1, 0}), "m/s"), own({-3, 0, 1}), with_prefix(1000 * own({0, 0, 1}), "g"),
                  with_prefix(own({1, -2, 1}), "N"), with_prefix(own({-1, -2, 1}), "Pa"), 1e6 * own({3, -1, 0})));
  const auto length = [&](double own_units) { return with_prefix(own_units * scales->length, "m"); };
  lines.push_back(fmt::format("box {} x {} x {}, cells of {} x {} x {}, the fluid's step {}, end {}",
                              length(grid.size().x), length(grid.size().y), length(grid.size().z), length(grid.dx()),
                              length(grid.dy()), length(grid.smallest_dz()), with_prefix(step * scales->time, "s"),
                              with_prefix(config.time.end * scales->time, "s")));
  lines.push_back(fmt::format("fluid: density {:.6g} kg/m^3, viscosity {}", config.fluid.density * own({-3, 0, 1}),
                              with_prefix(config.fluid.viscosity * own({-1, -1, 1}), "Pa s")));
  return lines;
}

std::vector<std::string> describe_signals(const CaseConfig& config) {
  const auto scales = config.units ? scales_of(*config.units) : std::nullopt;
  std::vector<std::string> lines;
  for (const auto& [name, signal] : make_signals(config)) {
    const auto range = range_of(signal, signal.period().value_or(config.time.end));
    auto line = fmt::format("signal {}: largest {:.6g} at t = {:.6g}, least {:.6g} at t = {:.6g}", name, range.largest,
                            range.largest_at, range.least, range.least_at);
    if (signal.period()) {
      const auto parts = parts_of_period(signal);
      const double net = parts.positive - parts.negative, round_off = 1e-11 * (parts.positive + parts.negative);
      line +=
          fmt::format("; in a period of {:.6g} it carries {:.6g} there and {:.6g} back, mean {:.3g}", *signal.period(),
                      parts.positive, parts.negative, std::abs(net) > round_off ? net / *signal.period() : 0.0);
      const bool is_flow_rate =
          config.signals.at(name).dimension == Dimension{3, -1, 0} || config.signals.at(name).volume;
      if (scales && is_flow_rate)
        line += fmt::format(" (peak {:.4g} mL/s, stroke volume {:.4g} mL)",
                            1e6 * range.largest * scales->of({3, -1, 0}), 1e6 * parts.positive * scales->of({3, 0, 0}));
    }
    lines.push_back(std::move(line));
  }
  return lines;
}

}  // namespace pliant
