#pragma once
#include <algorithm>
#include <cmath>
#include <span>
#include <vector>

#include "grid/grid.hpp"
#include "mesh/triangle_mesh.hpp"

namespace pliant {

/// A piece of the line along z through the centres of the cells (i, j) that lies inside a surface. i and j count on
/// past periodic sides, as the surface does; z may as well.
struct InsidePiece {
  int i = 0, j = 0;
  double from = 0, to = 0;
};

/// The lines of the whole box inside closed faces: where they wind around a point at least once, seen with outward
/// normals (`orientation` 1) or inward ones (-1). Lines that pass sides which are not periodic are left out.
std::vector<InsidePiece> find_inside(const Grid& grid, std::span<const Face> faces, std::span<const Vec3> positions,
                                     double orientation);

/// Calls visit(i, j, k, share, shift) for every cell of this rank's slab that pieces reach: the share of its height
/// that is inside, and what has to be added to the cell's centre to come to where the surface is.
template <class Visit>
void for_cells_inside(const Grid& grid, std::span<const InsidePiece> pieces, Visit visit) {
  const auto wrap = [](int n, int cells) { return ((n % cells) + cells) % cells; };
  const auto faces = grid.z_face();
  const double bottom = faces[-1], top = faces[grid.nz() - 1], height = grid.size().z;
  for (const InsidePiece& piece : pieces) {
    const int i = wrap(piece.i, grid.nx()), j = wrap(piece.j, grid.ny());
    // Periods by which the piece has to go down to reach this slab.
    const bool is_periodic = grid.is_periodic(2);
    const int first = is_periodic ? static_cast<int>(std::ceil((piece.from - top) / height)) : 0;
    const int last = is_periodic ? static_cast<int>(std::floor((piece.to - bottom) / height)) : 0;
    for (int period = first; period <= last; ++period) {
      const double from = piece.from - period * height, to = piece.to - period * height;
      const Vec3 shift{(piece.i - i) * grid.dx(), (piece.j - j) * grid.dy(), period * height};
      for (int k = 0; k < grid.nz(); ++k) {
        const double share = (std::min(to, faces[k]) - std::max(from, faces[k - 1])) / grid.dz_c()[k];
        if (share > 0) visit(i, j, k, std::min(share, 1.0), shift);
      }
    }
  }
}

}  // namespace pliant
