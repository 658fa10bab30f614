#pragma once
#include <type_traits>

#include "core/loops.hpp"
#include "field/field.hpp"

namespace pliant {

/// scale * div(u) on the cells of plane k, row by row.
class DivergenceRows {
 public:
  DivergenceRows(const Grid& grid, ConstView<FaceX> u, ConstView<FaceY> v, ConstView<FaceZ> w, double scale,
                 Plane<Center> out, int k);
  void operator()(int j) const;

 private:
  ConstPlane<FaceX> u_;
  ConstPlane<FaceY> v_;
  ConstPlane<FaceZ> w_, w_below_;
  Plane<Center> out_;
  double sx_, sy_, sz_;
  int nx_;
};

/// Which directions of the Laplacian of phi enter the pressure: those that were treated implicitly.
enum class CorrectionTerms { none, z, all };

/// The weights of a correction.
struct CorrectionFactors {
  double dt_alpha;    ///< of the gradient in the velocity
  double lap_weight;  ///< of the Laplacian in the pressure
};

/// The three velocity components on one plane.
template <class Value>
struct VelocityPlane {
  Plane<FaceX, Value> u;
  Plane<FaceY, Value> v;
  Plane<FaceZ, Value> w;
};

/// to = from - dt_alpha grad(phi) on plane k, row by row; `to` may be `from`. Reads the planes k and k + 1 of phi, with
/// their ghosts.
class VelocityCorrection {
 public:
  VelocityCorrection(const Grid& grid, double dt_alpha, ConstPlane<Center> phi, ConstPlane<Center> phi_above,
                     VelocityPlane<const double> from, VelocityPlane<double> to, int k);
  void operator()(int j) const;

 private:
  ConstPlane<Center> phi_, phi_above_;
  VelocityPlane<const double> from_;
  VelocityPlane<double> to_;
  double gx_, gy_, gz_;
  int nx_;
};

/// p += phi - lap_weight L(phi) on plane k, row by row, L made of the directions in `terms`. Reads the planes k - 1 to
/// k + 1 of phi if L has z.
class PressureCorrection {
 public:
  struct Phi {
    ConstPlane<Center> below, here, above;
  };
  PressureCorrection(const Grid& grid, CorrectionTerms terms, double lap_weight, const Phi& phi, Plane<Center> p,
                     int k);
  void operator()(int j) const;

 private:
  template <CorrectionTerms terms>
  void row(int j) const;

  CorrectionTerms terms_;
  Phi phi_;
  Plane<Center> p_;
  double lx_, ly_, up_, down_;
  int nx_;
};

/// Integral over this rank's part of the box.
template <class Location, class Value>
double integral(const Grid& grid, View<Location, Value> f) {
  double sum = 0;
  const auto dz_c = grid.dz_c(), dz_f = grid.dz_f();
  for (int k = 0; k < grid.nz(); ++k) {
    double plane = 0;
    for (int j = 0; j < grid.ny(); ++j)
      for (int i = 0; i < grid.nx(); ++i) plane += f(i, j, k);
    sum += plane * (std::is_same_v<Location, FaceZ> ? dz_f[k] : dz_c[k]);
  }
  return sum * grid.dx() * grid.dy();
}

/// max of |u|/dx + |v|/dy + |w|/dz over the cells of plane k, or `largest` if that is more; infinity if any is NaN.
double convective_rate(const Grid& grid, ConstView<FaceX> u, ConstView<FaceY> v, ConstView<FaceZ> w, int k,
                       double largest);
/// The same over this rank's cells.
double convective_rate(const Grid& grid, ConstView<FaceX> u, ConstView<FaceY> v, ConstView<FaceZ> w);
/// Over this rank's cells: max of |div(u)|; NaN if any is.
double largest_divergence(const Grid& grid, ConstView<FaceX> u, ConstView<FaceY> v, ConstView<FaceZ> w);

}  // namespace pliant
