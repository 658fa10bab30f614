#include "flow/flow_parts.hpp"

namespace pliant {
namespace {

HelmholtzAdi::Directions directions_of(ViscousMode mode) {
  return mode == ViscousMode::implicit ? HelmholtzAdi::Directions::all : HelmholtzAdi::Directions::z;
}

SlabHalo::Ends halo_ends(const Grid& grid) {
  return grid.is_periodic(2) ? SlabHalo::Ends::periodic : SlabHalo::Ends::bounded;
}

template <class Location>
OldPlanes old_planes(const PlaneTriple<Location>& f) {
  return {f.below.at_row(0), f.here.at_row(0), f.above.at_row(0), f.here.row};
}

}  // namespace

FlowParts::FlowParts(const Grid& g, const FlowParameters& p)
    : grid(g),
      parameters(p),
      state(g),
      history_u(g),
      history_v(g),
      history_w(g),
      momentum_fluxes(g),
      phi(g, 1),
      rules{velocity_rules(p.boundary, 0), velocity_rules(p.boundary, 1), velocity_rules(p.boundary, 2)},
      rules_p(pressure_rules(p.boundary)),
      open(g, p.boundary, p.signals),
      halo(g.ranks(), halo_ends(g), g.nz()),
      poisson(g) {
  for (int c = 0; c < 3; ++c) open.lend_values(rules[static_cast<std::size_t>(c)], c);
  if (p.viscous == ViscousMode::explicit_rk3) return;
  // One set of factors for each substep and component, kept while the time step stays.
  for (int l = 0; l < 3; ++l)
    for (int c = 0; c < 3; ++c)
      adi.emplace_back(g, rules[static_cast<std::size_t>(c)], c, directions_of(p.viscous), phi.row());
}

CorrectionTerms FlowParts::correction_terms() const {
  return parameters.viscous == ViscousMode::explicit_rk3 ? CorrectionTerms::none
         : parameters.viscous == ViscousMode::implicit_z ? CorrectionTerms::z
                                                         : CorrectionTerms::all;
}

HelmholtzAdi* FlowParts::begin_viscous(const Substep& s, double dt) {
  HelmholtzAdi* solve = &adi[static_cast<std::size_t>(3 * s.index)];
  for (int c = 0; c < 3; ++c) {
    solve[c].set_coefficient(0.5 * s.alpha * dt * parameters.viscosity);
    if (open.any()) solve[c].set_side_changes(open.changes(c));
  }
  return solve;
}

void FlowParts::begin_viscous_row(HelmholtzAdi* solve, const VelocityFields& predicted, const MomentumInput& old, int j,
                                  int k) {
  const auto begin = [&](HelmholtzAdi& one, auto field, const auto& planes) {
    one.begin_row(field.at_row(j, k), field.at_row(j, k + 1), old_planes(planes), j, k);
  };
  begin(solve[0], predicted.u.view(), old.u);
  begin(solve[1], predicted.v.view(), old.v);
  begin(solve[2], predicted.w.view(), old.w);
}

void FlowParts::end_viscous_plane(HelmholtzAdi* solve, const VelocityFields& predicted, const MomentumInput& old,
                                  int k) const {
  const auto end = [&](HelmholtzAdi& one, auto field, const auto& planes) {
    one.end_plane(field.at_row(0, k), field.at_row(0, k + 1), old_planes(planes), k);
  };
  end(solve[0], predicted.u.view(), old.u);
  end(solve[1], predicted.v.view(), old.v);
  end(solve[2], predicted.w.view(), old.w);
}

void FlowParts::couple_viscous(HelmholtzAdi* solve) {
  const auto scope = timer.measure("viscous coupling of slabs");
  for (int c = 0; c < 3; ++c) solve[c].couple();
  unfinished = solve;
}

void FlowParts::finish_viscous(const VelocityFields& predicted) {
  if (unfinished == nullptr) return;
  const auto scope = timer.measure("viscous solves");
  for (int k = 0; k < grid.nz(); ++k) finish_viscous_plane(predicted, k, [](int) {});
  unfinished = nullptr;
}

// visit(j) comes when row j and the ones beside it are there: those at the sides after all others.
template <class Visit>
void FlowParts::finish_viscous_plane(const VelocityFields& predicted, int k, Visit visit) const {
  const auto u = predicted.u.view();
  const auto v = predicted.v.view();
  const auto w = predicted.w.view();
  const VelocityPlane<double> plane{u.at_plane(k), v.at_plane(k), w.at_plane(k)};
  const int last = grid.ny() - 1;
  for (int j = 0; j <= last; ++j) {
    unfinished[0].finish_row(u.at_row(j, k), u.at_row(j, k - 1), j, k);
    unfinished[1].finish_row(v.at_row(j, k), v.at_row(j, k - 1), j, k);
    unfinished[2].finish_row(w.at_row(j, k), w.at_row(j, k - 1), j, k);
    fill_row(plane, j, k);
    if (0 < j && j < last) visit(j);
  }
  fill_rows_beyond(plane, k);
  visit(0);
  if (last > 0) visit(last);
}

void FlowParts::fill_plane(const VelocityFields& velocity, int k) const {
  fill_plane_ghosts(velocity.u.view(), rules[0], grid.nx(), grid.ny(), k);
  fill_plane_ghosts(velocity.v.view(), rules[1], grid.nx(), grid.ny(), k);
  fill_plane_ghosts(velocity.w.view(), rules[2], grid.nx(), grid.ny(), k);
}

void FlowParts::fill_row(const VelocityPlane<double>& velocity, int j, int k) const {
  fill_row_ghosts(velocity.u.at_row(j), rules[0], grid.nx(), j, k);
  fill_row_ghosts(velocity.v.at_row(j), rules[1], grid.nx(), j, k);
  fill_row_ghosts(velocity.w.at_row(j), rules[2], grid.nx(), j, k);
}

void FlowParts::fill_rows_beyond(const VelocityPlane<double>& velocity, int k) const {
  fill_ghost_rows(velocity.u, rules[0], grid.nx(), grid.ny(), k);
  fill_ghost_rows(velocity.v, rules[1], grid.nx(), grid.ny(), k);
  fill_ghost_rows(velocity.w, rules[2], grid.nx(), grid.ny(), k);
}

void FlowParts::fill_predicted_ends(const VelocityFields& predicted, GhostPlanes which) {
  const auto scope = timer.measure("halo");
  // The face plane on the upper side is set before neighbours or the divergence see it.
  fill_end_planes(predicted.w.view(), rules[2], grid);
  if (which == GhostPlanes::both) {
    halo.fill({plane_stack(predicted.u), plane_stack(predicted.v), plane_stack(predicted.w)});
    fill_end_planes(predicted.u.view(), rules[0], grid);
    fill_end_planes(predicted.v.view(), rules[1], grid);
  } else {
    halo.fill({plane_stack(predicted.w)}, which);
  }
}

void FlowParts::fill_state_ends() {
  const auto scope = timer.measure("halo");
  // The normal face of the top must be in place before it travels as a periodic or neighbouring ghost; then the ends.
  fill_end_planes(state.w.view(), rules[2], grid);
  halo.fill({plane_stack(state.u), plane_stack(state.v), plane_stack(state.w), plane_stack(state.p)});
  fill_end_planes(state.u.view(), rules[0], grid);
  fill_end_planes(state.v.view(), rules[1], grid);
  fill_end_planes(state.w.view(), rules[2], grid);
  fill_end_planes(state.p.view(), rules_p, grid);
}

void FlowParts::fill_state_ghosts() {
  for (int k = 0; k < grid.nz(); ++k) {
    fill_plane(state_velocity(), k);
    fill_plane_ghosts(state.p.view(), rules_p, grid.nx(), grid.ny(), k);
  }
  fill_state_ends();
}

double FlowParts::begin_projection(const VelocityFields& predicted, double dt_alpha, bool wants_rate) {
  const auto scope = timer.measure("divergence and transform");
  const auto u = std::as_const(predicted.u).view();
  const auto v = std::as_const(predicted.v).view();
  const auto w = std::as_const(predicted.w).view();
  const double scale = poisson.rhs_scale() / dt_alpha;
  double rate = 0;
  for (int k = 0; k < grid.nz(); ++k) {
    const DivergenceRows divergence(grid, u, v, w, scale, phi.view().at_plane(k), k);
    if (unfinished != nullptr) finish_viscous_plane(predicted, k, divergence);
    else for_rows(grid.ny(), divergence);
    if (wants_rate) rate = convective_rate(grid, u, v, w, k, rate);
    poisson.begin_plane(phi.view(), k);
  }
  unfinished = nullptr;
  return rate;
}

std::size_t FlowParts::bytes() const {
  std::size_t bytes = 8 * phi.bytes() + poisson.bytes();
  for (const auto& solve : adi) bytes += solve.bytes();
  return bytes;
}

}  // namespace pliant
