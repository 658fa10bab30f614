#pragma once
#include "mesh/surface.hpp"

namespace pliant {

/// Box about the origin with its edges along x, y, z, closed, outward normals; area and volume are exact. Its sides
/// are cut into rectangles, as square as the sizes allow, and these by the diagonal that points to the nearest corner:
/// angles of 45 and 90 degrees, none below 26.
/// Throws InputError if a size or the edge is not positive, or if there would be too many faces.
Surface make_box(Vec3 size, double edge);

}  // namespace pliant
