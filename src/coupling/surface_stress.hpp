#pragma once
#include "coupling/bodies.hpp"
#include "transfer/flow_sample.hpp"

namespace pliant {

/// Which bodies are asked for the stress on their surface.
enum class StressOf {
  driven,  ///< those whose motion follows from it: a probe outside the box is a failure
  all      ///< every body that acts on the flow; where a probe is outside the box its loads are not numbers
};

/// Sets sites, stresses and loads.probes from the flow at the ends of the probes. `driving`: the uniform acceleration
/// that acts on the fluid. Collective. Throws CollectiveError that names a body whose probes have left the box.
void find_stresses(Bodies& bodies, const FlowSampler& flow, const Grid& grid, Vec3 driving, StressOf which);

}  // namespace pliant
