#include "boundary/periodic_ghosts.hpp"

#include <utility>

namespace pliant {
namespace {

void move(double& to, double& from) { to += std::exchange(from, 0.0); }

}  // namespace

template <class Location>
void fill_periodic_ghosts(View<Location> f, const Grid& grid, int k) {
  const int nx = grid.nx(), ny = grid.ny();
  if (grid.is_periodic(0))
    for (int j = -1; j <= ny; ++j) f(-1, j, k) = f(nx - 1, j, k), f(nx, j, k) = f(0, j, k);
  if (grid.is_periodic(1))
    for (int i = -1; i <= nx; ++i) f(i, -1, k) = f(i, ny - 1, k), f(i, ny, k) = f(i, 0, k);
}

template <class Location>
void accumulate_periodic_ghosts(View<Location> f, const Grid& grid, int k, const PlaneRegion& region) {
  const int nx = grid.nx(), ny = grid.ny();
  const auto [i_begin, i_end, j_begin, j_end] = region;
  if (grid.is_periodic(0) && (i_begin < 0 || i_end > nx))
    for (int j = j_begin; j < j_end; ++j) {
      if (i_begin < 0) move(f(nx - 1, j, k), f(-1, j, k));
      if (i_end > nx) move(f(0, j, k), f(nx, j, k));
    }
  if (grid.is_periodic(1) && (j_begin < 0 || j_end > ny))
    for (int i = i_begin; i < i_end; ++i) {
      if (j_begin < 0) move(f(i, ny - 1, k), f(i, -1, k));
      if (j_end > ny) move(f(i, 0, k), f(i, ny, k));
    }
}

#define PLIANT_INSTANTIATE(L)                                       \
  template void fill_periodic_ghosts<L>(View<L>, const Grid&, int); \
  template void accumulate_periodic_ghosts<L>(View<L>, const Grid&, int, const PlaneRegion&);
PLIANT_INSTANTIATE(Center)
PLIANT_INSTANTIATE(FaceX)
PLIANT_INSTANTIATE(FaceY)
PLIANT_INSTANTIATE(FaceZ)
#undef PLIANT_INSTANTIATE

}  // namespace pliant
