#pragma once
#include "mesh/surface.hpp"

namespace pliant {

/// Open rectangle in the x-y plane about the origin, size_a along x and size_b along y, normals along +z; its borders
/// and its area are exact. Rows along the longer side, shifted by half a face against each other: faces are nearly
/// equilateral with sides of about `edge` inside and have no angle below 26 degrees at the ends of the rows (34
/// where sides and edge are commensurable).
/// Throws InputError if a size or the edge is not positive, or if there would be too many faces.
Surface make_plate(double size_a, double size_b, double edge);

}  // namespace pliant
