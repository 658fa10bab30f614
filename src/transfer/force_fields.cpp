#include "transfer/force_fields.hpp"

#include <algorithm>

#include "boundary/fill_ghosts.hpp"
#include "core/prefetch.hpp"

namespace pliant {
namespace {

// Nodes begin to end - 1 of a row: adds them to what is unknown there, nodes 0 to unknowns - 1, and empties them.
template <class Location>
void move_row(View<Location> from, View<Location> to, double factor, int begin, int end, int unknowns, int j, int k) {
  double* __restrict u = to.at_row(j, k);
  double* __restrict f = from.at_row(j, k);
  const int first = std::clamp(0, begin, end), last = std::clamp(unknowns, first, end);
  std::fill(f + begin, f + first, 0.0);
  for (int i = first; i < last; ++i) {
    u[i] += factor * f[i];
    f[i] = 0;
  }
  std::fill(f + last, f + end, 0.0);
}

// Begins to load nodes begin to end - 1 of a row.
template <class Location>
void prefetch_row(ConstView<Location> f, int begin, int end, int j, int k) {
  for (int i = begin; i < end; i += 8) prefetch(f.at_row(j, k) + i);
}

constexpr int rows_ahead = 4;

}  // namespace

ForceFields::ForceFields(const Grid& grid)
    : grid_(grid),
      x_(grid),
      y_(grid),
      z_(grid),
      halo_(grid.ranks(), grid.is_periodic(2) ? SlabHalo::Ends::periodic : SlabHalo::Ends::bounded, grid.nz()),
      reached_(grid),
      always_(grid) {}

// Other ranks may send to any node of the planes at the ends.
void ForceFields::reach(const Markers& markers) {
  reached_ = always_;
  reached_.include(markers);
  reached_.include_origins_of_ghosts();
  const int nz = grid_.nz();
  if (!grid_.has_bottom()) reached_.include_plane(-1), reached_.include_plane(0);
  if (!grid_.has_top()) reached_.include_plane(nz - 1), reached_.include_plane(nz);
}

void ForceFields::reach_always(const Markers& markers) {
  always_.clear();
  always_.include(markers);
}

void ForceFields::clear() {
  for (int k = -1; k <= grid_.nz(); ++k)
    for (int j = -1; j <= grid_.ny(); ++j)
      reached_.for_each_part(j, k, [&](int begin, int end) {
        std::fill(x_.view().at_row(j, k) + begin, x_.view().at_row(j, k) + end, 0.0);
        std::fill(y_.view().at_row(j, k) + begin, y_.view().at_row(j, k) + end, 0.0);
        std::fill(z_.view().at_row(j, k) + begin, z_.view().at_row(j, k) + end, 0.0);
      });
}

void ForceFields::settle(int end, double factor, View<FaceX> u, View<FaceY> v, View<FaceZ> w) {
  for (end = std::min(end, grid_.nz() - 1); settled_ < end; ++settled_) {
    gather_plane(settled_);
    move_plane(settled_, factor, u, v, w);
  }
}

void ForceFields::gather() {
  for (int k = -1; k < 1; ++k) gather_plane(k);
  for (int k = settled_; k <= grid_.nz(); ++k) gather_plane(k);
  halo_.accumulate({plane_stack(x_), plane_stack(y_), plane_stack(z_)});
}

void ForceFields::move_to(double factor, View<FaceX> u, View<FaceY> v, View<FaceZ> w) {
  for (int k = -1; k < 1; ++k) move_plane(k, factor, u, v, w);
  for (int k = settled_; k <= grid_.nz(); ++k) move_plane(k, factor, u, v, w);
  settled_ = 1;
}

void ForceFields::gather_plane(int k) {
  const auto ghosts = reached_.ghosts(k);
  if (ghosts.is_empty()) return;
  accumulate_periodic_ghosts(x_.view(), grid_, k, ghosts);
  accumulate_periodic_ghosts(y_.view(), grid_, k, ghosts);
  accumulate_periodic_ghosts(z_.view(), grid_, k, ghosts);
}

void ForceFields::move_plane(int k, double factor, View<FaceX> u, View<FaceY> v, View<FaceZ> w) {
  const int nx = grid_.nx(), ny = grid_.ny(), nz = grid_.nz();
  const int u_end = grid_.is_periodic(0) ? nx : nx - 1, v_end = grid_.is_periodic(1) ? ny : ny - 1;
  const int w_end = grid_.has_top() ? nz - 1 : nz;
  for (int j = -1; j <= ny; ++j) {
    if (const int ahead = j + rows_ahead; ahead <= ny)
      reached_.for_each_part(ahead, k, [&](int begin, int end) {
        prefetch_row<FaceX>(x_.view(), begin, end, ahead, k);
        prefetch_row<FaceY>(y_.view(), begin, end, ahead, k);
        prefetch_row<FaceZ>(z_.view(), begin, end, ahead, k);
        prefetch_row<FaceX>(u, begin, end, ahead, k);
        prefetch_row<FaceY>(v, begin, end, ahead, k);
        prefetch_row<FaceZ>(w, begin, end, ahead, k);
      });
    const bool inside = j >= 0 && k >= 0 && k < nz;
    const int of_u = inside && j < ny ? u_end : 0, of_v = inside && j < v_end ? nx : 0;
    const int of_w = inside && j < ny && k < w_end ? nx : 0;
    reached_.for_each_part(j, k, [&](int begin, int end) {
      move_row(x_.view(), u, factor, begin, end, of_u, j, k);
      move_row(y_.view(), v, factor, begin, end, of_v, j, k);
      move_row(z_.view(), w, factor, begin, end, of_w, j, k);
    });
  }
}

}  // namespace pliant
