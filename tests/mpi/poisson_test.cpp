#include <gtest/gtest.h>

#include <cmath>

#include "boundary/fill_ghosts.hpp"
#include "solvers/poisson_solver.hpp"

// The seven-point Laplacian of the solution, written out here, must be the right-hand side to round-off: every
// topology, odd, prime and even sizes, anisotropic extents, stretched z, any number of ranks.
namespace pliant {
namespace {

struct Size {
  std::array<int, 3> cells;
  Vec3 extent;
};

BoundaryConfig sides(int topology) {
  BoundaryConfig boundary;
  for (std::size_t d = 0; d < 3; ++d)
    for (std::size_t s = 0; s < 2; ++s)
      if (topology >> d & 1) boundary[2 * d + s] = WallSide{};
      else boundary[2 * d + s] = PeriodicSide{};
  return boundary;
}

double relative_residual(const Size& size, int topology, StretchingLaw law) {
  const Communicator ranks;
  BoxConfig box;
  box.cells = size.cells;
  box.size = size.extent;
  box.stretching_z.law = law;
  const auto boundary = sides(topology);
  const Grid grid(box, boundary, ranks);
  Field<Center> phi(grid), rhs(grid);
  PoissonSolver solver(grid);

  const auto dz_c = grid.dz_c(), dz_f = grid.dz_f();
  const int nx = grid.nx(), ny = grid.ny(), nz = grid.nz();
  auto f = rhs.view();
  double sum = 0;
  for (int k = 0; k < nz; ++k)
    for (int j = 0; j < ny; ++j)
      for (int i = 0; i < nx; ++i) {
        const long global = i + 131L * j + 7919L * (k + grid.slab().begin);
        f(i, j, k) = std::sin(0.37 * static_cast<double>(global % 1009)) + 0.2 * (i == 0 && j == 0);
        sum += f(i, j, k) * dz_c[k];
      }
  const double mean = ranks.sum(sum) / (nx * ny * size.extent.z);
  for (int k = 0; k < nz; ++k)
    for (int j = 0; j < ny; ++j)
      for (int i = 0; i < nx; ++i) f(i, j, k) -= mean;
  auto x = phi.view();
  for (int k = 0; k < nz; ++k)
    for (int j = 0; j < ny; ++j)
      for (int i = 0; i < nx; ++i) x(i, j, k) = f(i, j, k);
  solver.solve(x);

  const auto rules = pressure_rules(boundary);
  for (int k = 0; k < nz; ++k) fill_plane_ghosts(x, rules, nx, ny, k);
  SlabHalo halo(ranks, grid.is_periodic(2) ? SlabHalo::Ends::periodic : SlabHalo::Ends::bounded, nz);
  halo.fill({plane_stack(phi)});
  fill_end_planes(x, rules, grid);
  double worst = 0, scale = 0;
  for (int k = 0; k < nz; ++k)
    for (int j = 0; j < ny; ++j)
      for (int i = 0; i < nx; ++i) {
        const double c = x(i, j, k), sx = 1 / (grid.dx() * grid.dx()), sy = 1 / (grid.dy() * grid.dy());
        const double laplacian = sx * (x(i + 1, j, k) - 2 * c + x(i - 1, j, k)) +
                                 sy * (x(i, j + 1, k) - 2 * c + x(i, j - 1, k)) +
                                 ((x(i, j, k + 1) - c) / dz_f[k] - (c - x(i, j, k - 1)) / dz_f[k - 1]) / dz_c[k];
        worst = std::max(worst, std::abs(laplacian - f(i, j, k)));
        scale = std::max(scale, std::abs(c) * (sx + sy + 1 / (dz_f[k] * dz_c[k])));
      }
  return ranks.max(worst) / ranks.max(scale);
}

TEST(PoissonSolver, SolvesEveryTopologyAndSize) {
  const Size sizes[] = {{{16, 256, 16}, {16, 256, 16}}, {{16, 12, 8}, {1, 1, 1}}, {{15, 9, 11}, {1, 1, 1}},
                        {{13, 7, 17}, {3, 0.5, 1}},     {{1, 8, 8}, {0.1, 1, 1}}, {{8, 1, 5}, {1, 0.2, 4}},
                        {{32, 24, 20}, {1, 10, 0.1}},   {{5, 4, 4}, {2, 3, 5}}};
  for (const auto& size : sizes) {
    if (size.cells[2] < Communicator().size()) continue;  // a rank needs a plane
    for (int topology = 0; topology < 8; ++topology) {
      EXPECT_LT(relative_residual(size, topology, StretchingLaw::uniform), 2e-15)
          << size.cells[0] << "x" << size.cells[1] << "x" << size.cells[2] << " topology " << topology;
      if (topology & 4) {
        EXPECT_LT(relative_residual(size, topology, StretchingLaw::tanh), 2e-15)
            << "stretched, " << size.cells[0] << "x" << size.cells[1] << "x" << size.cells[2] << " topology "
            << topology;
      }
    }
  }
}

}  // namespace
}  // namespace pliant
