#pragma once
#include "boundary/side_rules.hpp"
#include "field/plane_ring.hpp"
#include "parallel/slab_halo.hpp"
#include "solvers/poisson_solver.hpp"

namespace pliant {

/// The solution of a Poisson problem, plane by plane from the top down, with ghosts, as a sweep wants it: the last few
/// planes are kept, the eliminated planes of phi are only read.
///
/// Where slabs hang together (or one with itself), the planes that neighbours want are found first: the two lowest,
/// which go to the rank below, and the highest, which goes to the rank above.
class PoissonPlanes {
 public:
  /// `phi` must have a plane beyond its upper ghost plane, and must outlive this, as the others.
  PoissonPlanes(const Grid& grid, const PoissonSolver& solver, Field<Center>& phi, const FieldRules& rules,
                const SlabHalo& halo);

  /// After PoissonSolver::couple(). Collective.
  void start();
  /// Plane k, -1 <= k <= nz + 1 (nz if slabs do not hang together). Calls must descend; the two planes above the
  /// lowest one asked for stay as they are.
  ConstPlane<Center> at(int k);

  std::size_t bytes() const { return ring_.bytes(); }
  /// Slabs that hang together need so many planes each.
  static constexpr int least_planes = 2;

 private:
  void finish(Plane<Center> plane, int k);
  bool is_early(int k) const { return coupled_ && (k <= 1 || k >= planes_ - 1); }
  Plane<Center> place(int k) { return is_early(k) ? phi_.view().at_plane(k) : ring_[k]; }

  Grid grid_;
  const PoissonSolver& solver_;
  Field<Center>& phi_;
  FieldRules rules_;
  const SlabHalo& halo_;
  bool coupled_;
  int planes_;
  int next_ = 0;  // the highest plane that is still to be found
  PlaneRing<Center> ring_;
};

}  // namespace pliant
