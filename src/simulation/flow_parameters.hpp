#pragma once
#include "flow/flow_solver.hpp"

namespace pliant {

/// What the flow solver needs to know of a case. Throws InputError if a signal cannot be made.
FlowParameters flow_parameters(const CaseConfig& config);

}  // namespace pliant
