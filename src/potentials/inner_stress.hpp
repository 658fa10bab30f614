#pragma once
#include <span>
#include <vector>

#include "core/vec3.hpp"
#include "mesh/triangle_mesh.hpp"

namespace pliant {

class ShapeState;

/// What energies that depend on the lengths of edges, the angles of hinges, the areas of faces and the volume leave in
/// a surface: their derivatives by each of these. Potentials add up here, and one pass over faces and vertices makes
/// forces of it all. Arrays are padded to whole batches.
class InnerStress {
 public:
  /// Sized for a mesh, and zero.
  void reset(const TriangleMesh& mesh);

  std::vector<double> pull;     ///< per edge, dW/dl / l: force / length
  std::vector<double> moment;   ///< per edge, dW/dtheta / l: force; of no account at a border
  std::vector<double> tension;  ///< per face, dW/dA: force / length
  double pressure = 0;          ///< -dW/dV; the surface must be closed

  /// Adds the forces at the vertices. Sums run in the order of the faces around a vertex. Changes the pulls at borders.
  void add_forces(const ShapeState& shape, std::span<Vec3> forces);

 private:
  std::vector<double> corner_forces_;  // a record for each vertex of each face
};

}  // namespace pliant
