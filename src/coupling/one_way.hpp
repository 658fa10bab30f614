#pragma once
#include "config/case_config.hpp"
#include "coupling/contact.hpp"
#include "structure/deformable_body.hpp"
#include "transfer/flow_sample.hpp"

namespace pliant {

/// Moves a body through one fluid step in the undisturbed flow; the fluid does not feel it. Every rank that
/// samples must call this. A fixed body stays. Returns the number of substeps.
/// Throws RunError if the motion breaks down or the body leaves the box.
int advance_one_way(DeformableBody& body, const FlowSampler& flow, const FluidConfig& fluid, double step);

/// The same for all deformable bodies of all ranks, with one sampling of the flow, and contact between bodies, of which
/// those with a pose have already moved through the step. `pass`: of contact. Collective. Throws CollectiveError.
void advance_one_way(Bodies& bodies, const FlowSampler& flow, const FluidConfig& fluid, Contact& contact, double step,
                     ContactPass pass);

}  // namespace pliant
