#pragma once
#include <string>
#include <vector>

#include "core/vec3.hpp"
#include "mesh/surface.hpp"

namespace pliant {

/// Vertices and faces as read from a file, not checked yet, and where they were read so that errors can point at them.
struct SurfaceData {
  std::string source;  ///< name of the file, or of the shape
  std::vector<Vec3> positions;
  std::vector<Face> faces;
  std::vector<long> vertex_lines, face_lines;  ///< line of each vertex and face; empty if the source has no lines
  int first_number = 1;                        ///< what the source calls its first vertex and face: 1, or 0
  std::vector<NamedVertices> selections = {};
};

}  // namespace pliant
