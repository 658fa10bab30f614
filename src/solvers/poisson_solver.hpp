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
  /// Collective. Uses phi's memory for planning and overwrites it.
  PoissonSolver(const Grid& grid, Field<Center>& phi, TransformPlanning planning = TransformPlanning::estimate);

  /// In place, on the interior. Collective.
  void solve(View<Center> phi);

  /// The same as two sweeps with the caller's work in between, while planes are in cache: rhs_plane(k) for k ascending
  /// must leave the right-hand side in plane k; solution_plane(k), k descending, finds the solution there.
  template <class RhsPlane, class SolutionPlane>
  void solve(View<Center> phi, RhsPlane&& rhs_plane, SolutionPlane&& solution_plane) {
    for (int k = 0; k < planes_; ++k) {
      rhs_plane(k);
      begin_plane(phi, k);
    }
    z_lines_.couple();
    for (int k = planes_ - 1; k >= 0; --k) {
      z_lines_.substitute(k, phi.at_row(0, k), phi.at_row(0, k + 1));
      // A plane is wanted as modes by the one below it, so it turns back one plane later.
      if (k < planes_ - 1) {
        transform_.backward(phi.at_row(0, k + 1));
        solution_plane(k + 1);
      }
    }
    transform_.backward(phi.at_row(0, 0));
    solution_plane(0);
  }

  /// The right-hand side must be multiplied by this before it is given to the sweeps (not to solve(phi) alone).
  double rhs_scale() const { return transform_.normalisation(); }

  std::size_t bytes() const { return z_lines_.bytes(); }

 private:
  void begin_plane(View<Center> phi, int k);

  int planes_;
  Grid grid_;
  PlaneTransform transform_;
  SlabTridiagonal z_lines_;
};

}  // namespace pliant
