#pragma once
#include <string>
#include <vector>

#include "core/vec3.hpp"
#include "mesh/triangle_mesh.hpp"

namespace pliant {

/// Vertices that go by a name, ascending.
struct NamedVertices {
  std::string name;
  std::vector<int> vertices;
};

/// A triangle mesh with the positions of its vertices (n_vertices of them).
struct Surface {
  TriangleMesh mesh;
  std::vector<Vec3> positions;
  std::vector<NamedVertices> selections = {};  ///< that come with the shape, or with the file
};

}  // namespace pliant
