#include "solvers/poisson_solver.hpp"

namespace pliant {
namespace {

PlaneTransform::Kind kind_of(const Grid& grid, int direction) {
  return grid.is_periodic(direction) ? PlaneTransform::Kind::fourier : PlaneTransform::Kind::cosine;
}

SlabTridiagonal make_lines(const Grid& grid, const PlaneTransform& transform, std::ptrdiff_t stride) {
  const double sx = 1 / (grid.dx() * grid.dx()), sy = 1 / (grid.dy() * grid.dy());
  const auto ends = grid.is_periodic(2) ? SlabTridiagonal::Ends::periodic : SlabTridiagonal::Ends::bounded;
  const auto& ex = transform.eigenvalues_x();
  const auto& ey = transform.eigenvalues_y();
  return {
      grid.ranks(),
      ends,
      grid.nz(),
      LinePlane{transform.mode_width(), grid.ny(), stride},
      transform.fold(),
      [&](int row, int i) { return sx * ex[static_cast<std::size_t>(i)] + sy * ey[static_cast<std::size_t>(row)]; }};
}

}  // namespace

PoissonSolver::PoissonSolver(const Grid& grid, TransformPlanning planning)
    : planes_(grid.nz()),
      nx_(grid.nx()),
      ny_(grid.ny()),
      transform_(grid.nx(), grid.ny(), PlaneLayout(grid).row, kind_of(grid, 0), kind_of(grid, 1), planning),
      z_lines_(make_lines(grid, transform_, PlaneLayout(grid).row)) {
  SlabRows rows;
  const auto dz_c = grid.dz_c(), dz_f = grid.dz_f();
  for (int k = 0; k < planes_; ++k) {
    const bool at_bottom = grid.has_bottom() && k == 0, at_top = grid.has_top() && k == planes_ - 1;
    const double lower = at_bottom ? 0 : 1 / (dz_c[k] * dz_f[k - 1]);
    const double upper = at_top ? 0 : 1 / (dz_c[k] * dz_f[k]);
    rows.lower.push_back(lower);
    rows.upper.push_back(upper);
    rows.diagonal.push_back(-lower - upper);
  }
  // The mean mode is singular. Its equations are compatible, so a larger first diagonal only fixes the constant.
  const double pin = -1 / (dz_c[0] * dz_c[0]);
  // So is its imaginary part, where there is one: zero it is, but with a pivot that may be zero to the last bit too.
  const int parts = grid.is_periodic(0) ? 2 : 1;
  if (grid.slab().begin == 0) z_lines_.set_coefficients(rows, parts, pin);
  else z_lines_.set_coefficients(rows);
}

void PoissonSolver::solve(View<Center> phi) {
  const double scale = rhs_scale();
  for (int k = 0; k < planes_; ++k) {
    for (int j = 0; j < ny_; ++j)
      for (int i = 0; i < nx_; ++i) phi(i, j, k) *= scale;
    begin_plane(phi, k);
  }
  couple();
  for (int k = planes_ - 1; k >= 0; --k) z_lines_.substitute(k, phi.at_row(0, k), phi.at_row(0, k + 1));
  for (int k = 0; k < planes_; ++k) transform_.backward(phi.at_row(0, k));
}

}  // namespace pliant
