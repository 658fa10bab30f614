#include "transfer/force_fields.hpp"

#include <algorithm>

#include "boundary/fill_ghosts.hpp"

namespace pliant {
namespace {

// To the unknowns of a row, which are those below i_end.
template <class Location>
void add_row(View<Location> to, ConstView<Location> from, double factor, int begin, int end, int j, int k) {
  double* u = to.at_row(j, k);
  const double* f = from.at_row(j, k);
  for (int i = std::max(begin, 0); i < end; ++i) u[i] += factor * f[i];
}

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
  clear();
  reached_ = always_;
  reached_.include(markers);
  reached_.include_origins_of_ghosts();
  const int nz = grid_.nz();
  if (!grid_.has_bottom()) reached_.include_plane(-1), reached_.include_plane(0);
  if (!grid_.has_top()) reached_.include_plane(nz - 1), reached_.include_plane(nz);
}

// Until reach() is called nothing is left behind in the fields.
void ForceFields::reach_always(const Markers& markers) {
  clear();
  always_.clear();
  always_.include(markers);
  reached_ = always_;
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

void ForceFields::gather() {
  for (int k = -1; k <= grid_.nz(); ++k) {
    const auto ghosts = reached_.ghosts(k);
    if (ghosts.is_empty()) continue;
    accumulate_periodic_ghosts(x_.view(), grid_, k, ghosts);
    accumulate_periodic_ghosts(y_.view(), grid_, k, ghosts);
    accumulate_periodic_ghosts(z_.view(), grid_, k, ghosts);
  }
  halo_.accumulate({plane_stack(x_), plane_stack(y_), plane_stack(z_)});
}

void ForceFields::add_to(double factor, View<FaceX> u, View<FaceY> v, View<FaceZ> w) const {
  const int nx = grid_.nx(), ny = grid_.ny(), nz = grid_.nz();
  const int u_end = grid_.is_periodic(0) ? nx : nx - 1, v_end = grid_.is_periodic(1) ? ny : ny - 1;
  const int w_end = grid_.has_top() ? nz - 1 : nz;
  for (int k = 0; k < nz; ++k)
    for (int j = 0; j < ny; ++j)
      reached_.for_each_part(j, k, [&](int begin, int end) {
        add_row<FaceX>(u, x_.view(), factor, begin, std::min(end, u_end), j, k);
        if (j < v_end) add_row<FaceY>(v, y_.view(), factor, begin, std::min(end, nx), j, k);
        if (k < w_end) add_row<FaceZ>(w, z_.view(), factor, begin, std::min(end, nx), j, k);
      });
}

}  // namespace pliant
