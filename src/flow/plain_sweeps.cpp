#include "flow/plain_sweeps.hpp"

namespace pliant {

PlainSweeps::PlainSweeps(FlowParts& parts) : parts_(parts), u_(parts.grid), v_(parts.grid), w_(parts.grid) {}

void PlainSweeps::predict(const Substep& s, const MomentumFactors& factors, double dt, NodalForces* forces) {
  auto& m = parts_;
  HelmholtzAdi* solve = m.is_implicit() ? m.begin_viscous(s, dt) : nullptr;
  for (int k = m.grid.nz() - 1; k >= 0; --k) {
    const auto p = std::as_const(m.state.p).view();
    const MomentumInput in{planes_around(m.state.u.view(), k), planes_around(m.state.v.view(), k),
                           planes_around(m.state.w.view(), k), p.at_plane(k), p.at_plane(k + 1)};
    const VelocityPlane<double> out{u_.view().at_plane(k), v_.view().at_plane(k), w_.view().at_plane(k)};
    {
      const auto scope = m.timer.measure("momentum");
      const MomentumRows momentum(m.grid, m.parameters.viscous, history_use(s), factors, in,
                                  {out.u, out.v, out.w, m.history_u.view().at_plane(k), m.history_v.view().at_plane(k),
                                   m.history_w.view().at_plane(k)},
                                  m.momentum_fluxes, k);
      for_rows(m.grid.ny(), momentum);
      if (forces != nullptr) FlowParts::add_forces(*forces, factors, out, 0, m.grid.ny(), k);
    }
    if (solve == nullptr) {
      m.fill_plane(predicted(), k);
    } else {
      const auto scope = m.timer.measure("viscous solves");
      for (int j = 0; j < m.grid.ny(); ++j) FlowParts::begin_viscous_row(solve, predicted(), in, j, k);
      m.end_viscous_plane(solve, predicted(), in, k);
    }
  }
  if (solve == nullptr) return;
  m.couple_viscous(solve);
  m.finish_viscous(predicted());
}

double PlainSweeps::project(const CorrectionFactors& factors, bool wants_rate) {
  const double rate = parts_.begin_projection(predicted(), factors.dt_alpha, wants_rate);
  solve_for_phi();
  correct(factors);
  return rate;
}

void PlainSweeps::solve_for_phi() {
  auto& m = parts_;
  const auto phi = m.phi.view();
  const int nz = m.grid.nz();
  {
    const auto scope = m.timer.measure("poisson coupling of slabs");
    m.poisson.couple();
  }
  {
    const auto scope = m.timer.measure("substitution and transform");
    for (int k = nz - 1; k >= 0; --k)
      m.poisson.substitute(k, phi.at_plane(k), phi.at_plane(k == nz - 1 ? k : k + 1), phi.at_plane(k));
    for (int k = 0; k < nz; ++k) {
      m.poisson.to_physical(phi.at_plane(k));
      fill_plane_ghosts(phi, m.rules_p, m.grid.nx(), m.grid.ny(), k);
    }
  }
  const auto scope = m.timer.measure("halo");
  m.halo.fill({plane_stack(m.phi)});
  fill_end_planes(phi, m.rules_p, m.grid);
}

void PlainSweeps::correct(const CorrectionFactors& factors) {
  auto& m = parts_;
  const auto phi = std::as_const(m.phi).view();
  {
    const auto scope = m.timer.measure("correction");
    for (int k = 0; k < m.grid.nz(); ++k) {
      const VelocityPlane<double> planes{u_.view().at_plane(k), v_.view().at_plane(k), w_.view().at_plane(k)};
      const VelocityCorrection velocity(m.grid, factors.dt_alpha, phi.at_plane(k), phi.at_plane(k + 1),
                                        {planes.u, planes.v, planes.w}, planes, k);
      for_rows(m.grid.ny(), velocity);
      const PressureCorrection pressure(m.grid, m.correction_terms(), factors.lap_weight,
                                        {phi.at_plane(k - 1), phi.at_plane(k), phi.at_plane(k + 1)},
                                        m.state.p.view().at_plane(k), k);
      for_rows(m.grid.ny(), pressure);
      m.fill_plane(predicted(), k);
      fill_plane_ghosts(m.state.p.view(), m.rules_p, m.grid.nx(), m.grid.ny(), k);
    }
  }
  change_places();
  m.fill_state_ends();
}

void PlainSweeps::change_places() {
  parts_.state.u.swap(u_);
  parts_.state.v.swap(v_);
  parts_.state.w.swap(w_);
}

void PlainSweeps::adopt_state() { change_places(); }

}  // namespace pliant
