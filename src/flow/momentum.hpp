#pragma once
#include "config/case_config.hpp"
#include "core/prefetch.hpp"
#include "field/field.hpp"

namespace pliant {

/// Where a substep stands in a step: the first has no history to read, the last none to leave.
enum class HistoryUse { write, read_write, read };

/// The factors of one substep.
struct MomentumFactors {
  double dt_gamma;   ///< dt gamma, weight of the explicit terms H
  double dt_rho;     ///< dt rho, weight of the last substep's H
  double dt_alpha;   ///< dt alpha, weight of the pressure gradient, of the implicit terms and of the acceleration
  double viscosity;  ///< kinematic
  Vec3 acceleration;
};

/// A plane and its neighbours in z.
template <class Location>
struct PlaneTriple {
  ConstPlane<Location> below, here, above;
};
template <class Location, class Value>
PlaneTriple<Location> planes_around(View<Location, Value> f, int k) {
  return {f.at_plane(k - 1), f.at_plane(k), f.at_plane(k + 1)};
}

/// What the right-hand side of a plane reads.
struct MomentumInput {
  PlaneTriple<FaceX> u;
  PlaneTriple<FaceY> v;
  PlaneTriple<FaceZ> w;
  ConstPlane<Center> p, p_above;
};

/// What it writes, and the explicit terms H carried from substep to substep in place.
struct MomentumOutput {
  Plane<FaceX> u;
  Plane<FaceY> v;
  Plane<FaceZ> w;
  Plane<FaceX> history_u;
  Plane<FaceY> history_v;
  Plane<FaceZ> history_w;
};

/// What passes from a row of cells to the next row in y, for the three components: found once, used on both sides.
class FluxRows {
 public:
  struct Rows {
    double *u, *v, *w;
  };
  explicit FluxRows(const Grid& grid);
  Rows rows() { return {memory_.get(), memory_.get() + row_, memory_.get() + 2 * row_}; }

 private:
  std::ptrdiff_t row_;
  AlignedDoubles memory_;
};

/// Right-hand side of the predicted velocity, all three components, row by row of one plane.
///
/// explicit_rk3:  out = u + dt [gamma H + rho H_old] + dt alpha (g - grad p),       H = -div(u u) + nu L u
/// implicit_z:    out =     dt [gamma H + rho H_old] + dt alpha (g - grad p + nu Lz u),  H = -div(u u) + nu (Lx + Ly) u
/// implicit:      out =     dt [gamma H + rho H_old] + dt alpha (g - grad p + nu L u),   H = -div(u u)
///
/// The implicit forms give the increment before the factored solves. Central differences in flux form; fluxes through
/// the sides of a w cell are weighted by the thickness of the two cells it spans, so that kinetic energy is conserved
/// on stretched grids too.
class MomentumRows {
 public:
  /// The constants of a plane, by value for the row kernels.
  struct Constants {
    double dt_gamma, dt_rho, dt_alpha;
    double x, y;                     // 1/4 of the inverse spacings: fluxes are products of two sums
    double visc_x, visc_y;           // nu over the square of the spacing
    double weight_low, weight_high;  // of the two cells that a w cell spans; they sum to 1
    struct OfComponent {
      double z;                   // 1/4 over the thickness of the component's cells
      double visc_up, visc_down;  // nu over that thickness and the distance
      double gradient;            // dt alpha over the spacing
      double push;                // dt alpha times the acceleration
    } u, v, w;
  };

  MomentumRows(const Grid& grid, ViscousMode mode, HistoryUse history, const MomentumFactors& factors,
               const MomentumInput& in, const MomentumOutput& out, FluxRows& fluxes, int k);
  /// Ascending from j = 0. Reads rows j - 1, j and j + 1 of the input; of the planes below and above j, of w below also
  /// j + 1, of v above also j - 1.
  /// Begins to load the rows `ahead` on the way.
  void operator()(int j, const RowsAhead& ahead) const { row_(constants_, in_, out_, fluxes_, ahead, nx_, j); }
  void operator()(int j) const { operator()(j, RowsAhead(in_.p.at_row(j))); }

 private:
  using Row = void (*)(const Constants&, const MomentumInput&, const MomentumOutput&, const FluxRows::Rows&,
                       const RowsAhead&, int nx, int j);
  Constants constants_;
  MomentumInput in_;
  MomentumOutput out_;
  FluxRows::Rows fluxes_;
  int nx_;
  Row row_;
};

}  // namespace pliant
