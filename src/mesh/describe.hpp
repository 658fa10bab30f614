#pragma once
#include <string>

#include "mesh/surface.hpp"

namespace pliant {

/// Numbers about a surface, for people. Angles in degrees; volume only means something if closed.
struct MeshReport {
  int n_vertices = 0, n_edges = 0, n_faces = 0, n_border_edges = 0, n_components = 0, euler_characteristic = 0;
  bool closed = false;
  bool manifold = true;  ///< no vertex where two fans of faces meet in a point
  double area = 0, volume = 0;
  double edge_min = 0, edge_mean = 0, edge_max = 0;
  double angle_min = 0, angle_max = 0;
  Vec3 lower, upper;  ///< corners of the bounding box
};

/// How many parts there are that no edge connects; a vertex without faces is one.
int count_components(const TriangleMesh& mesh);

MeshReport describe(const Surface& surface);
/// The report as aligned lines, ended by a newline.
std::string format(const MeshReport& report);

}  // namespace pliant
