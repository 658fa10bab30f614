#pragma once
#include "config/case_config.hpp"
#include "field/field.hpp"
#include "solvers/plane_transform.hpp"
#include "solvers/slab_tridiagonal.hpp"

namespace pliant {

/// Solves the second-order seven-point lap(phi) = rhs at cell centres, directly: transforms in x and y with the
/// modified wave numbers of the stencil, tridiagonal in z. Zero normal gradient at bounded sides. If all sides are
/// periodic or bounded the mean of rhs must be zero to round-off; phi is then fixed up to a constant.
class PoissonSolver {
 public:
  /// Collective. For phi in fields of this grid.
  explicit PoissonSolver(const Grid& grid, TransformPlanning planning = TransformPlanning::estimate);

  /// In place, on the interior. Collective.
  void solve(View<Center> phi);

  /// The same as two sweeps with the caller's work in between, while planes are in cache. First, for k ascending, with
  /// rhs_scale() times the right-hand side in plane k of phi: transforms and eliminates it.
  void begin_plane(View<Center> phi, int k) {
    transform_.forward(phi.at_row(0, k));
    z_lines_.eliminate(k, phi.at_row(0, k), phi.at_row(0, k - 1));
  }
  double rhs_scale() const { return transform_.normalisation(); }
  /// Then, collective:
  void couple() { z_lines_.couple(); }
  /// And for k descending, from the eliminated plane and the modes of plane k + 1 (not read at first) to its modes,
  /// which may take the place of the eliminated plane. PoissonPlanes does all that.
  void substitute(int k, ConstPlane<Center> eliminated, ConstPlane<Center> modes_above, Plane<Center> modes) const {
    for (int j = 0; j < ny_; ++j)
      z_lines_.substitute_row(k, j, eliminated.at_row(j), modes_above.at_row(j), modes.at_row(j));
  }
  void find_second_plane(Plane<Center> modes) const { z_lines_.find_second_plane(modes.at_row(0)); }
  void to_physical(Plane<Center> modes) const { transform_.backward(modes.at_row(0)); }
  bool is_coupled() const { return z_lines_.is_coupled(); }

  std::size_t bytes() const { return z_lines_.bytes(); }

 private:
  int planes_, nx_, ny_;
  PlaneTransform transform_;
  SlabTridiagonal z_lines_;
};

}  // namespace pliant
