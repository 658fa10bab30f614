#pragma once
#include <array>
#include <vector>

#include "boundary/open_sides.hpp"
#include "field/field.hpp"
#include "solvers/plane_helmholtz.hpp"
#include "solvers/row_helmholtz.hpp"
#include "solvers/slab_tridiagonal.hpp"

namespace pliant {

/// A component and its neighbours in z before a substep, row pointers by j.
struct OldPlanes {
  const double *below, *here, *above;
  std::ptrdiff_t stride;
};

/// From the increment's right-hand side g and the old velocity u to the predicted one, for one velocity component:
/// (1 - a Lx)(1 - a Ly)(1 - a Lz)(u* - u) = g, or its z factor alone, with the homogeneous form of the component's
/// boundary rules. The z lines are solved for u* itself, (1 - a Lz) u* = g' + (1 - a Lz) u, so that no increments are
/// kept. Factors are kept for as long as `a` stays.
///
/// Use: for planes k descending, begin_row for all rows j ascending, then end_plane; couple; then finish_row for all
/// rows of planes k ascending.
class HelmholtzAdi {
 public:
  enum class Directions { z, all };

  /// `component` (0, 1, 2) says which faces the component lives on; rows of its planes are `row_stride` apart.
  HelmholtzAdi(const Grid& grid, const FieldRules& rules, int component, Directions directions,
               std::ptrdiff_t row_stride);

  /// Collective.
  void set_coefficient(double a);

  /// Lets the values on open sides change by this much in the present substep. The views must stay valid.
  void set_side_changes(const SideChanges& changes) { changes_ = changes; }

  /// x solve of row j of plane k and the elimination of the y lines; or, if z lines are all that is asked for, their
  /// elimination. `before` is plane k + 1 as this left it.
  void begin_row(double* row, const double* before, const OldPlanes& old, int j, int k);
  /// The rest of the y lines and the elimination of the z lines, if that is not done.
  void end_plane(double* plane, const double* before, const OldPlanes& old, int k);
  /// Collective, after all planes.
  void couple() { z_.couple(); }
  /// z substitution of row j of plane k; `before` is the row of plane k - 1 as this left it.
  void finish_row(double* row, const double* before, int j, int k) { z_.substitute_row(k, j, row, before, row); }

  std::size_t bytes() const { return z_.bytes() + work_.size() * sizeof(double); }

 private:
  void add_x_changes(double* row, int j, int k) const;
  void add_y_changes(double* row, int j, int k) const;
  void add_z_changes(double* row, int j, int k) const;
  bool is_known_plane(int k) const;
  void eliminate_row(double* row, const double* before, const OldPlanes& old, int j, int k);

  Grid grid_;
  FieldRules rules_;
  int component_;
  Directions directions_;
  std::ptrdiff_t stride_;
  double a_ = -1;
  SideChanges changes_;
  RowHelmholtz x_;
  PlaneHelmholtz y_;
  SlabTridiagonal z_;
  std::vector<double> work_;
};

}  // namespace pliant
