#pragma once
#include "mesh/surface.hpp"

namespace pliant {

/// Open tube along z from z = 0 to z = height with outward normals. Both rims have six times radius / edge vertices,
/// evenly spaced from the x axis on: they fit a hole of a plate, the annulus of a valve or the rim of a ventricle of
/// the same radius and edge. Rows of nearly equilateral faces, an even number of them; no angle is below 25 degrees
/// unless the tube is lower than about an edge. Selections: "lower-rim", "upper-rim". Throws InputError if a size or
/// the edge is not positive, or if there would be too many faces.
Surface make_channel(double radius, double height, double edge);

}  // namespace pliant
