#include "simulation/explain_failure.hpp"

#include <fmt/format.h>

namespace pliant {

std::string explain_flow_failure(const Bodies& bodies, const FlowSolver& flow, double dt, double cfl) {
  std::string text = fmt::format("the flow is not finite any more; the step was {:.3g}", dt);
  // A body far too light can take the flow along before its swings are counted.
  for (const auto& kind : bodies.kinds())
    if (kind.is_free() && kind.coupling == CouplingKind::loose && kind.added_mass_ratio > 1)
      return text + fmt::format(
                        "; likely loose coupling was unstable: the added mass of body '{}' is about {:.2g} of its own; "
                        "use coupling = \"strong\"",
                        kind.config.name, kind.added_mass_ratio);
  const double viscous = flow.viscous_step_limit();
  if (dt > viscous)
    return text + fmt::format(
                      ", the limit of the explicit viscous terms is {:.3g}: lower time.step, or choose "
                      "time.viscous = \"implicit\"",
                      viscous);
  if (cfl > largest_stable_cfl)
    return text + fmt::format(
                      ", its Courant number about {:.3g}, the limit of the scheme {:.3g}: lower time.step or "
                      "time.cfl",
                      cfl, largest_stable_cfl);
  return text + "; likely the step is too long or the forcing too strong: try half of time.step or time.cfl";
}

}  // namespace pliant
