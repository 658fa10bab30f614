#pragma once
#include "mesh/surface.hpp"

namespace pliant {

/// Ellipsoid about the origin with the semi-axes along x, y, z: the geodesic sphere of this frequency, scaled, so
/// 10 f^2 + 2 vertices. Its faces stretch with it: the smallest angle is above 25 degrees up to a ratio of semi-axes
/// of about 2, for longer or flatter ones it falls about as one over the ratio.
/// Throws InputError if frequency < 1 or above 1000, or if a semi-axis is not positive.
Surface make_ellipsoid(int frequency, Vec3 semi_axes);

}  // namespace pliant
