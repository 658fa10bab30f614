#include "boundary/fill_ghosts.hpp"

#include "core/loops.hpp"

namespace pliant {
namespace {

// One line of values across a direction: f(-1), f(0) .. f(n - 1), f(n), `step` apart; the values of the rules at it.
inline void fill_line(double* f, std::ptrdiff_t step, int n, const SideRule& low, double low_value,
                      const SideRule& high, double high_value) {
  switch (low.kind) {
    case SideRule::Kind::periodic:
      f[-step] = f[(n - 1) * step];
      f[n * step] = f[0];
      return;
    case SideRule::Kind::mirror:
      f[-step] = low.sign * f[0] + low_value;
      break;
    case SideRule::Kind::face:
      f[-step] = low_value;
      break;
  }
  if (high.kind == SideRule::Kind::mirror) {
    f[n * step] = high.sign * f[(n - 1) * step] + high_value;
  } else {
    f[(n - 1) * step] = high_value;
    f[n * step] = 2 * high_value - f[(n - 2) * step];
  }
}

}  // namespace

void fill_row_ghosts(double* row, const FieldRules& rules, int nx, int j, int k) {
  fill_line(row, 1, nx, rules[0], rules[0].value_at(j, k), rules[1], rules[1].value_at(j, k));
}

template <class Location>
void fill_ghost_rows(Plane<Location> f, const FieldRules& rules, int nx, int ny, int k) {
  double* row = f.at_row(0) - 1;
  const std::ptrdiff_t step = f.row;
  const SideRule low = rules[2], high = rules[3];
  if (low.values == nullptr && high.values == nullptr)
    for_each(nx + 2, [=](int i) { fill_line(row + i, step, ny, low, low.value, high, high.value); });
  else
    for_each(nx + 2,
             [=](int i) { fill_line(row + i, step, ny, low, low.value_at(i - 1, k), high, high.value_at(i - 1, k)); });
}

template <class Location>
void fill_plane_ghosts(Plane<Location> f, const FieldRules& rules, int nx, int ny, int k) {
  for_rows(ny, [&](int j) { fill_row_ghosts(f.at_row(j), rules, nx, j, k); });
  fill_ghost_rows(f, rules, nx, ny, k);
}

template <class Location>
void fill_end_plane(Plane<Location> ghost, ConstPlane<Location> interior, double sign, double factor,
                    const SideRule& rule, int nx, int ny) {
  for (int j = -1; j <= ny; ++j) {
    double* to = ghost.at_row(j);
    const double* from = interior.at_row(j);
    for (int i = -1; i <= nx; ++i) to[i] = sign * from[i] + factor * rule.value_at(i, j);
  }
}

template <class Location>
void fill_end_planes(View<Location> f, const FieldRules& rules, const Grid& grid) {
  const int nx = grid.nx(), ny = grid.ny(), nz = grid.nz();
  const auto fill = [&](int ghost, int interior, double sign, double factor, const SideRule& rule) {
    fill_end_plane(f.at_plane(ghost), ConstPlane<Location>(f.at_plane(interior)), sign, factor, rule, nx, ny);
  };
  const auto& low = rules[4];
  const auto& high = rules[5];
  if (grid.has_bottom()) fill(-1, 0, low.kind == SideRule::Kind::mirror ? low.sign : 0, 1, low);
  if (!grid.has_top()) return;
  if (high.kind == SideRule::Kind::mirror) {
    fill(nz, nz - 1, high.sign, 1, high);
  } else {
    fill(nz - 1, nz - 1, 0, 1, high);
    fill(nz, nz - 2, -1, 2, high);
  }
}

#define PLIANT_INSTANTIATE(L)                                                                          \
  template void fill_ghost_rows<L>(Plane<L>, const FieldRules&, int, int, int);                        \
  template void fill_plane_ghosts<L>(Plane<L>, const FieldRules&, int, int, int);                      \
  template void fill_end_plane<L>(Plane<L>, ConstPlane<L>, double, double, const SideRule&, int, int); \
  template void fill_end_planes<L>(View<L>, const FieldRules&, const Grid&);
PLIANT_INSTANTIATE(Center)
PLIANT_INSTANTIATE(FaceX)
PLIANT_INSTANTIATE(FaceY)
PLIANT_INSTANTIATE(FaceZ)
#undef PLIANT_INSTANTIATE

}  // namespace pliant
