#pragma once
#include "mesh/surface.hpp"

namespace pliant {

/// Open disc in the x-y plane about the origin, normals along +z: rings of 6, 12, 18, ... vertices about the centre,
/// a step of about `edge` apart, the last one on the circle. No angle is below 40 degrees.
/// Throws InputError if radius or edge is not positive, or if there would be too many faces.
Surface make_disc(double radius, double edge);

/// The half of such a disc at x >= 0, open: its straight side lies on the y axis, its middle in the origin.
Surface make_half_disc(double radius, double edge);

}  // namespace pliant
