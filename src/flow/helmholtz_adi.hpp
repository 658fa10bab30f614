#pragma once
#include <array>
#include <vector>

#include "boundary/open_sides.hpp"
#include "field/field.hpp"
#include "solvers/plane_helmholtz.hpp"
#include "solvers/row_helmholtz.hpp"
#include "solvers/slab_tridiagonal.hpp"

namespace pliant {

/// Inverts the factored implicit operator (1 - a Lx)(1 - a Ly)(1 - a Lz), or its z factor alone, on the increment of
/// one velocity component, with the homogeneous form of its boundary rules. Factors are kept for as long as `a` stays.
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

  /// x and y solves of the plane if asked for, then the z elimination; k ascending.
  void begin_plane(double* plane, const double* plane_below, int k);
  /// Collective, after all planes have begun.
  void couple() { z_.couple(); }
  /// z substitution; k descending.
  void finish_plane(double* plane, const double* plane_above, int k) { z_.substitute(k, plane, plane_above); }

  std::size_t bytes() const { return z_.bytes() + work_.size() * sizeof(double); }

 private:
  void add_x_changes(double* plane, int k) const;
  void add_y_changes(double* plane, int k) const;
  void add_z_changes(double* plane, int k) const;

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
