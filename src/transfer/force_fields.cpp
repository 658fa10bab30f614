#include "transfer/force_fields.hpp"

#include <algorithm>

#include "boundary/fill_ghosts.hpp"
#include "core/prefetch.hpp"

namespace pliant {
namespace {

// Nodes begin to end - 1 of a row: adds them to what is unknown there, nodes 0 to unknowns - 1, and empties them.
void move_row(double* __restrict f, double* __restrict u, double factor, int begin, int end, int unknowns) {
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
  const int ny = grid_.ny();
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
    const auto unknowns = unknowns_of(j, k);
    reached_.for_each_part(j, k, [&](int begin, int end) {
      move_row(x_.view().at_row(j, k), u.at_row(j, k), factor, begin, end, unknowns.u);
      move_row(y_.view().at_row(j, k), v.at_row(j, k), factor, begin, end, unknowns.v);
      move_row(z_.view().at_row(j, k), w.at_row(j, k), factor, begin, end, unknowns.w);
    });
  }
}

ForceFields::Unknowns ForceFields::unknowns_of(int j, int k) const {
  const int nx = grid_.nx(), ny = grid_.ny(), nz = grid_.nz();
  const bool inside = j >= 0 && j < ny && k >= 0 && k < nz;
  if (!inside) return {0, 0, 0};
  return {grid_.is_periodic(0) ? nx : nx - 1, grid_.is_periodic(1) || j < ny - 1 ? nx : 0,
          grid_.has_top() && k == nz - 1 ? 0 : nx};
}

void ForceFields::hand_over() {
  gather();
  const auto forget = [&](int j, int k) {
    reached_.for_each_part(j, k, [&](int begin, int end) {
      for (double* row : {x_.view().at_row(j, k), y_.view().at_row(j, k), z_.view().at_row(j, k)})
        std::fill(row + begin, row + end, 0.0);
    });
  };
  const int ny = grid_.ny(), nz = grid_.nz();
  for (int k = -1; k <= nz; ++k)
    for (int j = -1; j <= ny; ++j)
      if (j < 0 || j == ny || k < 0 || k == nz) forget(j, k);
}

void ForceFields::take_row(double factor, double* u, double* v, double* w, int j, int k) {
  if (reached_.is_empty(j, k)) return;
  const auto unknowns = unknowns_of(j, k);
  reached_.for_each_part(j, k, [&](int begin, int end) {
    move_row(x_.view().at_row(j, k), u, factor, begin, end, unknowns.u);
    move_row(y_.view().at_row(j, k), v, factor, begin, end, unknowns.v);
    move_row(z_.view().at_row(j, k), w, factor, begin, end, unknowns.w);
  });
}

}  // namespace pliant
