#pragma once
#include <limits>
#include <string>

#include "config/case_config.hpp"
#include "grid/grid.hpp"

namespace pliant {

inline constexpr double no_limit = std::numeric_limits<double>::infinity();

/// The upper bounds on the fluid's time step, each infinite where it does not apply.
struct StepLimits {
  double given = no_limit;         ///< time.step
  double convective = no_limit;    ///< cfl over max(|u|/dx + |v|/dy + |w|/dz), walls and bulk velocity included
  double acceleration = no_limit;  ///< the step in which the body force alone would reach the Courant number
  double viscous = no_limit;       ///< of the explicitly treated viscous terms, with a margin
  double maximum = no_limit;       ///< time.max_step
  double decay = no_limit;         ///< a tenth of the time in which viscosity damps the box's longest wave
  double interfaces = no_limit;    ///< bodies that move with the flow
  double diffusion = no_limit;     ///< h^2/nu, only where nothing else limits the step

  double smallest() const;
  /// The key or the effect that rules, for people: "time.step", "convection (time.cfl)", ...
  std::string ruling() const;
};

/// The part of `viscous_step_limit` that is used: at the limit itself the highest modes are not damped.
inline constexpr double viscous_margin = 0.9;

/// The limits for a flow whose convective rate is, or will be, `rate` [1/time]; `viscous_limit` as FlowSolver gives it.
/// `body_limit` as CoupledFlow gives it.
StepLimits step_limits(const CaseConfig& config, const Grid& grid, double rate, double viscous_limit,
                       double body_limit = no_limit);

/// The convective rate that walls, steady inflows and the forcing prescribe before the flow has it.
double prescribed_rate(const CaseConfig& config, const Grid& grid);

/// nu dt / h^2 of the smallest spacing. Above largest_forcing_viscous_number the flow leaks away from the forced
/// velocity within a step: drag falls short (bench/markers.md).
double forcing_viscous_number(const CaseConfig& config, const Grid& grid, double step);
inline constexpr double largest_forcing_viscous_number = 0.3;

/// A step of at most `limit` that divides the time `remaining` to the next event into equal steps, so that the event is
/// hit without a tiny last step. Where the limit itself does so to 1e-9 it is the step, to the bit.
double step_towards(double limit, double remaining);

}  // namespace pliant
