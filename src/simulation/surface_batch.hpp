#pragma once
#include "coupling/bodies.hpp"
#include "io/surface_writer.hpp"

namespace pliant {

/// This rank's copies of a kind for its surface file: positions (each body moved by whole periods, so that its mean is
/// in the box), velocities and forces of the vertices; for bodies that act on the flow pressure and wall shear of the
/// faces, and of the inner side of open surfaces as well.
SurfaceBatch surface_batch(const Bodies& bodies, std::size_t kind);

}  // namespace pliant
