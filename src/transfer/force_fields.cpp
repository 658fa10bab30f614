#include "transfer/force_fields.hpp"

#include <algorithm>

#include "boundary/fill_ghosts.hpp"

namespace pliant {
namespace {

template <class Location>
void clear_plane(View<Location> f, const PlaneRegion& r, int k) {
  for (int j = r.j_begin; j < r.j_end; ++j) std::fill(f.at_row(j, k) + r.i_begin, f.at_row(j, k) + r.i_end, 0.0);
}

template <class Location>
void add_plane(View<Location> to, ConstView<Location> from, const PlaneRegion& r, double factor, int i_end, int j_end,
               int k) {
  const int i_begin = std::max(r.i_begin, 0), i_last = std::min(r.i_end, i_end);
  for (int j = std::max(r.j_begin, 0); j < std::min(r.j_end, j_end); ++j) {
    double* u = to.at_row(j, k);
    const double* f = from.at_row(j, k);
    for (int i = i_begin; i < i_last; ++i) u[i] += factor * f[i];
  }
}

PlaneRegion nothing(const Grid& grid) { return {grid.nx() + 1, -1, grid.ny() + 1, -1}; }

}  // namespace

ForceFields::ForceFields(const Grid& grid)
    : grid_(grid),
      x_(grid),
      y_(grid),
      z_(grid),
      halo_(grid.ranks(), grid.is_periodic(2) ? SlabHalo::Ends::periodic : SlabHalo::Ends::bounded, grid.nz()),
      regions_(static_cast<std::size_t>(grid.nz()) + 2),
      always_(static_cast<std::size_t>(grid.nz()) + 2, nothing(grid)) {}

void ForceFields::reach(const Markers& markers) {
  clear();
  regions_ = always_;
  include(markers);
  widen();
}

void ForceFields::reach_always(const Markers& markers) {
  clear();
  std::fill(regions_.begin(), regions_.end(), nothing(grid_));
  include(markers);
  // Until reach() is called nothing is left behind in the fields.
  always_.swap(regions_);
  regions_ = always_;
}

void ForceFields::include(const Markers& markers) {
  markers.for_each_block([&](const StencilBlock& block) {
    for (int b = 0; b < block.n_batches; ++b)
      for (int l = 0; l < markers.count(block.first_batch + b); ++l)
        include(block.stencils[static_cast<std::size_t>(b)].first, l);
  });
}

void ForceFields::include(const int (&first)[n_stencil_lines][mls_batch], int l) {
  const auto [i, i_last] = std::minmax(first[x_center][l], first[x_face][l]);
  const auto [j, j_last] = std::minmax(first[y_center][l], first[y_face][l]);
  for (const StencilLine line : {z_center, z_face})
    for (int k = first[line][l]; k < first[line][l] + 3; ++k) {
      auto& r = region(k);
      r.i_begin = std::min(r.i_begin, i), r.i_end = std::max(r.i_end, i_last + 3);
      r.j_begin = std::min(r.j_begin, j), r.j_end = std::max(r.j_end, j_last + 3);
    }
}

// What is in a periodic ghost goes to the other side of the box, and other ranks may send to any node of the planes at
// the ends.
void ForceFields::widen() {
  const int nx = grid_.nx(), ny = grid_.ny(), nz = grid_.nz();
  for (auto& r : regions_) {
    if (r.is_empty()) continue;
    if (grid_.is_periodic(0) && (r.i_begin < 0 || r.i_end > nx)) r.i_begin = -1, r.i_end = nx + 1;
    if (grid_.is_periodic(1) && (r.j_begin < 0 || r.j_end > ny)) r.j_begin = -1, r.j_end = ny + 1;
  }
  const PlaneRegion whole{-1, nx + 1, -1, ny + 1};
  if (!grid_.has_bottom()) region(-1) = region(0) = whole;
  if (!grid_.has_top()) region(nz - 1) = region(nz) = whole;
}

void ForceFields::clear() {
  for (int k = -1; k <= grid_.nz(); ++k) {
    const auto& r = region(k);
    if (r.is_empty()) continue;
    clear_plane(x_.view(), r, k);
    clear_plane(y_.view(), r, k);
    clear_plane(z_.view(), r, k);
  }
}

void ForceFields::gather() {
  for (int k = -1; k <= grid_.nz(); ++k) {
    const auto& r = region(k);
    if (r.is_empty()) continue;
    accumulate_periodic_ghosts(x_.view(), grid_, k, r);
    accumulate_periodic_ghosts(y_.view(), grid_, k, r);
    accumulate_periodic_ghosts(z_.view(), grid_, k, r);
  }
  halo_.accumulate({plane_stack(x_), plane_stack(y_), plane_stack(z_)});
}

void ForceFields::add_to(double factor, View<FaceX> u, View<FaceY> v, View<FaceZ> w) const {
  const int nx = grid_.nx(), ny = grid_.ny(), nz = grid_.nz();
  for (int k = 0; k < nz; ++k) {
    const auto& r = region(k);
    if (r.is_empty()) continue;
    add_plane(u, x_.view(), r, factor, grid_.is_periodic(0) ? nx : nx - 1, ny, k);
    add_plane(v, y_.view(), r, factor, nx, grid_.is_periodic(1) ? ny : ny - 1, k);
    if (k < nz - 1 || !grid_.has_top()) add_plane(w, z_.view(), r, factor, nx, ny, k);
  }
}

}  // namespace pliant
