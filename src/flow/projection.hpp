#pragma once
#include <type_traits>

#include "core/loops.hpp"
#include "field/field.hpp"

namespace pliant {

/// phi(i, j, k) = scale * div(u) on the cells of plane k.
void divergence_plane(const Grid& grid, ConstView<FaceX> u, ConstView<FaceY> v, ConstView<FaceZ> w, double scale,
                      View<Center> phi, int k);

/// Which directions of the Laplacian of phi enter the pressure: those that were treated implicitly.
enum class CorrectionTerms { none, z, all };

struct CorrectedFields {
  View<FaceX> u;
  View<FaceY> v;
  View<FaceZ> w;
  View<Center> p;
};

/// u -= dt_alpha grad(phi); p += phi - lap_weight L(phi) on plane k. Needs the ghosts of phi.
void correct_plane(const Grid& grid, CorrectionTerms terms, double dt_alpha, double lap_weight, ConstView<Center> phi,
                   const CorrectedFields& fields, int k);

/// a += b on the interior of plane k.
template <class Location>
void add_plane(View<Location> a, std::type_identity_t<ConstView<Location>> b, const Grid& grid, int k) {
  const int nx = grid.nx(), ny = grid.ny();
  for_rows(ny, [&](int j) {
    double* __restrict to = a.at_row(j, k);
    const double* __restrict from = b.at_row(j, k);
    for_each(nx, [=](int i) { to[i] += from[i]; });
  });
}

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

/// Over this rank's cells: max of |u|/dx + |v|/dy + |w|/dz.
double convective_rate(const Grid& grid, ConstView<FaceX> u, ConstView<FaceY> v, ConstView<FaceZ> w);
/// Over this rank's cells: max of |div(u)|; NaN if any is.
double largest_divergence(const Grid& grid, ConstView<FaceX> u, ConstView<FaceY> v, ConstView<FaceZ> w);

}  // namespace pliant
