#pragma once
#include <cmath>

#include "mesh/surface.hpp"

namespace pliant {

/// A flat sheet of equilateral faces with sides of length 1: n x n rhombi in the x-y plane, normals along +z.
inline Surface make_lattice_patch(int n) {
  std::vector<Vec3> positions;
  std::vector<Face> faces;
  for (int j = 0; j <= n; ++j)
    for (int i = 0; i <= n; ++i) positions.push_back({i + 0.5 * j, 0.5 * std::sqrt(3.0) * j, 0.0});
  const auto at = [n](int i, int j) { return j * (n + 1) + i; };
  for (int j = 0; j < n; ++j)
    for (int i = 0; i < n; ++i) {
      faces.push_back({at(i, j), at(i + 1, j), at(i, j + 1)});
      faces.push_back({at(i + 1, j), at(i + 1, j + 1), at(i, j + 1)});
    }
  return {TriangleMesh((n + 1) * (n + 1), std::move(faces)), std::move(positions)};
}

}  // namespace pliant
