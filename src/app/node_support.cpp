#include "app/node_support.hpp"

#include <algorithm>
#include <cmath>

namespace pliant {
namespace {

// Coordinates of a direction's nodes by global index, whatever its spacing.
double node_at(const Grid& grid, int direction, bool faces, int node) {
  switch (direction) {
    case 0:
      return faces ? grid.x_face(node) : grid.x_center(node);
    case 1:
      return faces ? grid.y_face(node) : grid.y_center(node);
    default:
      return faces ? grid.global_z_face()[node] : grid.global_z_center()[node];
  }
}

int cell_of(const Grid& grid, int direction, double x) {
  if (direction == 2) return grid.plane_of_height(x);
  const int n = grid.cells()[static_cast<std::size_t>(direction)];
  const double spacing = direction == 0 ? grid.dx() : grid.dy();
  return std::clamp(static_cast<int>((x - grid.origin()[direction]) / spacing), 0, n - 1);
}

int nearest_node(const Grid& grid, int direction, bool faces, double x) {
  const int cell = cell_of(grid, direction, x);
  int nearest = cell;
  for (int node : {cell - 1, cell + 1})
    if (std::abs(node_at(grid, direction, faces, node) - x) < std::abs(node_at(grid, direction, faces, nearest) - x))
      nearest = node;
  return nearest;
}

}  // namespace

NodeSupport find_support(const Grid& grid, Vec3 point, int staggered) {
  NodeSupport support;
  for (int d = 0; d < 3; ++d) {
    const bool faces = d == staggered;
    const int n = grid.cells()[static_cast<std::size_t>(d)];
    double x = point[d];
    int middle = nearest_node(grid, d, faces, x);
    if (!grid.is_periodic(d)) middle = std::clamp(middle, faces ? 0 : 1, n - 2);
    if (middle < 0) middle += n, x += grid.size()[d];
    if (middle >= n) middle -= n, x -= grid.size()[d];
    double* offsets = support.offsets[d];
    for (int i = 0; i < 3; ++i) offsets[i] = node_at(grid, d, faces, middle + i - 1) - x;
    const double farthest = std::max(std::abs(offsets[0]), std::abs(offsets[2]));
    support.reach[static_cast<std::size_t>(d)] =
        default_mls_alpha * std::max(0.75 * (offsets[2] - offsets[0]), farthest);
    support.first[d] = middle - 1;
  }
  support.first[2] -= grid.slab().begin;
  return support;
}

}  // namespace pliant
