#pragma once
#include "coupling/coupled_flow.hpp"

namespace pliant {

/// One step of loose coupling (the paper's): fluid, then loads, then bodies. First order in the step; bears bodies
/// whose added mass is less than their own (added_mass.hpp). `time`: of the end of the step. Collective. Throws
/// CollectiveError if a body leaves the box, or if its coupling is unstable.
void advance_loose(CoupledFlow& coupled, double time, double step);

/// The last part of it: moves the loosely coupled rigid and hinged bodies under the loads they have. Collective.
void advance_loose_bodies(CoupledFlow& coupled, double step);

}  // namespace pliant
