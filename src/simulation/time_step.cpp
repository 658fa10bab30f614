#include "simulation/time_step.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <utility>

namespace pliant {
namespace {

bool is_free(const BodyConfig& body) { return body.motion == MotionKind::rigid || body.motion == MotionKind::hinge; }

}  // namespace

double StepLimits::smallest() const {
  return std::min({given, convective, acceleration, viscous, maximum, decay, interfaces, diffusion});
}

std::string StepLimits::ruling() const {
  const std::pair<double, const char*> all[] = {{given, "the given step (time.step)"},
                                                {convective, "convection (time.cfl)"},
                                                {acceleration, "acceleration by the forcing (time.cfl)"},
                                                {viscous, "explicit viscous terms (time.viscous)"},
                                                {maximum, "the upper bound (time.max_step)"},
                                                {decay, "viscous decay of the longest wave (time.max_step)"},
                                                {interfaces, "the stiffness of bodies that move with the flow"},
                                                {diffusion, "diffusion over a cell, as nothing moves"}};
  return std::min_element(std::begin(all), std::end(all), [](auto& a, auto& b) { return a.first < b.first; })->second;
}

double prescribed_rate(const CaseConfig& config, const Grid& grid) {
  double rate = 0;
  for (const auto& side : config.boundary) {
    if (const auto* wall = std::get_if<WallSide>(&side)) rate = std::max(rate, grid.convective_rate(wall->velocity));
    // FlowSolver::largest_side_rate knows how far a signal goes.
    const auto* inflow = std::get_if<InflowSide>(&side);
    if (inflow != nullptr && inflow->signal.empty()) rate = std::max(rate, grid.convective_rate(inflow->velocity));
  }
  if (const auto& bulk = config.forcing.bulk_velocity) {
    Vec3 velocity;
    velocity[static_cast<int>(bulk->axis)] = bulk->value;
    rate = std::max(rate, grid.convective_rate(velocity));
  }
  return rate;
}

StepLimits step_limits(const CaseConfig& config, const Grid& grid, double rate, double viscous_limit,
                       double body_limit) {
  StepLimits limits;
  const auto& time = config.time;
  if (time.step) {
    limits.given = *time.step;
    return limits;
  }
  const double fastest = std::max(rate, prescribed_rate(config, grid));
  if (fastest > 0) limits.convective = time.cfl / fastest;
  // After dt from rest the speed is a dt, so the Courant number a dt^2 / h.
  double surge = grid.convective_rate(config.forcing.acceleration);
  if (std::any_of(config.bodies.begin(), config.bodies.end(), is_free))
    surge = std::max(surge, grid.convective_rate(config.forcing.gravity));
  // Once the flow has speed that is its limit; a force that friction balances must not hold the step down for ever.
  if (surge > 0 && limits.convective > 10 * std::sqrt(time.cfl / surge))
    limits.acceleration = std::sqrt(time.cfl / surge);
  limits.interfaces = body_limit;
  limits.viscous = viscous_margin * viscous_limit;
  if (time.max_step > 0) limits.maximum = time.max_step;
  const double nu = config.fluid.viscosity / config.fluid.density;
  if (!std::isfinite(limits.smallest())) {
    const double smallest = grid.smallest_spacing();
    limits.diffusion = nu > 0 ? smallest * smallest / nu : time.end / 100;
  }
  // As a flow dies down convection lets the step grow without bound; implicit viscosity bears that, its accuracy does
  // not.
  const Vec3 size = grid.size();
  const double longest = std::max({size.x, size.y, size.z}) / (2 * std::numbers::pi);
  if (nu > 0) limits.decay = 0.1 * longest * longest / nu;
  return limits;
}

double forcing_viscous_number(const CaseConfig& config, const Grid& grid, double step) {
  const double smallest = grid.smallest_spacing();
  return config.fluid.viscosity / config.fluid.density * step / (smallest * smallest);
}

double step_towards(double limit, double remaining) {
  constexpr double tolerance = 1e-9;
  if (!(limit < remaining)) return remaining;
  const double steps = std::ceil(remaining / limit * (1 - tolerance));
  const double step = remaining / steps;
  return steps > 1 && std::abs(step - limit) <= tolerance * limit ? limit : step;
}

}  // namespace pliant
