#pragma once
#include "mesh/surface.hpp"

namespace pliant {

/// Geodesic sphere about the origin: an icosahedron whose edges are split `frequency` times, 10 f^2 + 2 vertices on the
/// sphere, 20 f^2 faces with outward normals, neighbours in space close in number.
/// An even frequency halves edges on the sphere, which keeps faces more even than one projection.
/// Throws InputError if frequency < 1 or above 1000, or if the radius is not positive.
Surface make_icosphere(int frequency, double radius);

}  // namespace pliant
