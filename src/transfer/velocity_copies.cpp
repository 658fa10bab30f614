#include "transfer/velocity_copies.hpp"

#include "boundary/fill_ghosts.hpp"
#include "boundary/periodic_ghosts.hpp"

namespace pliant {

VelocityCopies::VelocityCopies(const Grid& grid)
    : grid_(grid),
      halo_(grid.ranks(), grid.is_periodic(2) ? SlabHalo::Ends::periodic : SlabHalo::Ends::bounded, grid.nz()) {}

void VelocityCopies::fill(View<FaceX> u, View<FaceY> v, View<FaceZ> w) {
  for (int k = 0; k < grid_.nz(); ++k) {
    fill_periodic_ghosts(u, grid_, k);
    fill_periodic_ghosts(v, grid_, k);
    fill_periodic_ghosts(w, grid_, k);
  }
  halo_.fill({plane_stack(u), plane_stack(v), plane_stack(w)});
}

}  // namespace pliant
