#include "solvers/poisson_planes.hpp"

#include "boundary/fill_ghosts.hpp"

namespace pliant {

PoissonPlanes::PoissonPlanes(const Grid& grid, const PoissonSolver& solver, Field<Center>& phi, const FieldRules& rules,
                             const SlabHalo& halo)
    : grid_(grid),
      solver_(solver),
      phi_(phi),
      rules_(rules),
      halo_(halo),
      coupled_(solver.is_coupled()),
      planes_(grid.nz()),
      ring_(grid, 4) {}

void PoissonPlanes::finish(Plane<Center> plane, int k) {
  solver_.to_physical(plane);
  fill_plane_ghosts(plane, rules_, grid_.nx(), grid_.ny(), k);
}

void PoissonPlanes::start() {
  const auto phi = phi_.view();
  const auto plane = [&](int k) { return phi.at_plane(k); };
  const int top = planes_ - 1;
  next_ = top;
  if (!coupled_) {
    solver_.substitute(top, plane(top), plane(top), ring_[top]);
    return;
  }
  if (top > 1) solver_.substitute(top, plane(top), plane(top), plane(top));
  if (top > 2) solver_.substitute(top - 1, plane(top - 1), plane(top), ring_[top - 1]);
  solver_.find_second_plane(plane(1));
  solver_.substitute(0, plane(0), plane(1), plane(0));
  finish(plane(0), 0);
  finish(plane(1), 1);
  if (top > 1) finish(plane(top), top);
  next_ = top - 1;
  halo_.fill({plane_stack(phi)});
  auto from_second = plane_stack(phi);
  from_second.first += phi.plane;
  halo_.fill({from_second}, GhostPlanes::upper);
  // An end of the box, if there is one.
  fill_end_planes(phi, rules_, grid_);
}

ConstPlane<Center> PoissonPlanes::at(int k) {
  for (const int lowest = coupled_ ? 2 : 0; next_ >= std::max(k, lowest); --next_) {
    if (next_ > lowest) solver_.substitute(next_ - 1, phi_.view().at_plane(next_ - 1), ring_[next_], ring_[next_ - 1]);
    finish(ring_[next_], next_);
  }
  if (coupled_) return place(k);
  const auto end = [&](int interior, const SideRule& rule) {
    fill_end_plane(ring_[k], ConstPlane<Center>(ring_[interior]), rule.sign, 1, rule, grid_.nx(), grid_.ny());
  };
  if (k == planes_) at(planes_ - 1), end(planes_ - 1, rules_[5]);
  if (k == -1) end(0, rules_[4]);
  return ring_[k];
}

}  // namespace pliant
