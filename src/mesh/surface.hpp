#pragma once
#include <vector>

#include "core/vec3.hpp"
#include "mesh/triangle_mesh.hpp"

namespace pliant {

/// A triangle mesh with the positions of its vertices (n_vertices of them).
struct Surface {
  TriangleMesh mesh;
  std::vector<Vec3> positions;
};

}  // namespace pliant
