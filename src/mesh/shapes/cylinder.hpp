#pragma once
#include "mesh/surface.hpp"

namespace pliant {

enum class Ends { capped, open };

/// Cylinder along z about the origin with outward normals: capped, or a tube with two borders. Rows of nearly
/// equilateral faces around the side, with vertices on the circle; caps are discs. No angle is below 40 degrees.
/// Throws InputError if a size or the edge is not positive, or if there would be too many faces.
Surface make_cylinder(double radius, double height, double edge, Ends ends);

}  // namespace pliant
