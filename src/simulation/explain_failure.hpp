#pragma once
#include <string>

#include "coupling/bodies.hpp"
#include "flow/flow_solver.hpp"

namespace pliant {

/// What probably made a flow infinite in a step `dt` of Courant number `cfl`, and what to do about it.
std::string explain_flow_failure(const Bodies& bodies, const FlowSolver& flow, double dt, double cfl);

}  // namespace pliant
