#pragma once
#include "coupling/bodies.hpp"

namespace pliant {

/// Largest |u|/dx + |v|/dy + |w|/dz of this rank's bodies as they move now: the Courant number is the step times this.
double convective_rate(const Bodies& bodies);

/// The same of all prescribed motions, sampled over [0, end].
double largest_path_rate(const Bodies& bodies, double end);

}  // namespace pliant
