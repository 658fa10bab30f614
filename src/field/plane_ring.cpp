#include "field/plane_ring.hpp"

namespace pliant {

template <class Location>
PlaneRing<Location>::PlaneRing(const Grid& grid, int count) : count_(count) {
  const PlaneLayout layout(grid);
  row_ = layout.row;
  plane_ = layout.plane;
  const auto n = static_cast<std::size_t>(plane_) * static_cast<std::size_t>(count);
  bytes_ = n * sizeof(double);
  memory_ = allocate_aligned(n);
  origin_ = memory_.get() + layout.origin;
}

template class PlaneRing<Center>;
template class PlaneRing<FaceX>;
template class PlaneRing<FaceY>;
template class PlaneRing<FaceZ>;

}  // namespace pliant
