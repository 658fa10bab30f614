#include "boundary/fill_ghosts.hpp"

#include "core/loops.hpp"

namespace pliant {
namespace {

// One line of values across a direction: f(-1), f(0) .. f(n - 1), f(n), `step` apart.
inline void fill_line(double* f, std::ptrdiff_t step, int n, const SideRule& low, const SideRule& high) {
  switch (low.kind) {
    case SideRule::Kind::periodic:
      f[-step] = f[(n - 1) * step];
      f[n * step] = f[0];
      return;
    case SideRule::Kind::mirror:
      f[-step] = low.sign * f[0] + low.value;
      break;
    case SideRule::Kind::face:
      f[-step] = low.value;
      break;
  }
  if (high.kind == SideRule::Kind::mirror) {
    f[n * step] = high.sign * f[(n - 1) * step] + high.value;
  } else {
    f[(n - 1) * step] = high.value;
    f[n * step] = 2 * high.value - f[(n - 2) * step];
  }
}

}  // namespace

template <class Location>
void fill_plane_ghosts(View<Location> f, const FieldRules& rules, int nx, int ny, int k) {
  for_rows(ny, [&](int j) { fill_line(f.at_row(j, k), 1, nx, rules[0], rules[1]); });
  double* row = f.at_row(0, k) - 1;
  const std::ptrdiff_t step = f.row;
  const SideRule low = rules[2], high = rules[3];
  for_each(nx + 2, [=](int i) { fill_line(row + i, step, ny, low, high); });
}

template <class Location>
void fill_end_planes(View<Location> f, const FieldRules& rules, const Grid& grid) {
  const int nx = grid.nx(), ny = grid.ny(), nz = grid.nz();
  const auto fill = [&](int ghost, int interior, double sign, double value) {
    for (int j = -1; j <= ny; ++j) {
      double* to = f.at_row(j, ghost);
      const double* from = f.at_row(j, interior);
      for (int i = -1; i <= nx; ++i) to[i] = sign * from[i] + value;
    }
  };
  const auto& low = rules[4];
  const auto& high = rules[5];
  if (grid.has_bottom()) fill(-1, 0, low.kind == SideRule::Kind::mirror ? low.sign : 0, low.value);
  if (!grid.has_top()) return;
  if (high.kind == SideRule::Kind::mirror) {
    fill(nz, nz - 1, high.sign, high.value);
  } else {
    fill(nz - 1, nz - 1, 0, high.value);
    fill(nz, nz - 2, -1, 2 * high.value);
  }
}

#define PLIANT_INSTANTIATE(L)                                                    \
  template void fill_plane_ghosts<L>(View<L>, const FieldRules&, int, int, int); \
  template void fill_end_planes<L>(View<L>, const FieldRules&, const Grid&);
PLIANT_INSTANTIATE(Center)
PLIANT_INSTANTIATE(FaceX)
PLIANT_INSTANTIATE(FaceY)
PLIANT_INSTANTIATE(FaceZ)
#undef PLIANT_INSTANTIATE

}  // namespace pliant
