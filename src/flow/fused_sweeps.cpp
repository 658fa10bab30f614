#include "flow/fused_sweeps.hpp"

#include <algorithm>

namespace pliant {
namespace {

template <class Location>
void copy_row(ConstPlane<Location> from, Plane<Location> to, int j, int nx) {
  std::copy_n(from.at_row(j) - 1, nx + 2, to.at_row(j) - 1);
}

VelocityPlane<double> planes_of(FlowState& state, int k) {
  return {state.u.view().at_plane(k), state.v.view().at_plane(k), state.w.view().at_plane(k)};
}

}  // namespace

class FusedSweeps::OldRows {
 public:
  // Of a plane -1 <= k <= nz; at the ends of the box use the rules instead. `to` may be the state's own plane.
  OldRows(FusedSweeps& s, const VelocityPlane<double>& to, int k)
      : parts_(s.parts_), k_(k), to_(to), from_(planes_of(s.parts_.state, k)) {
    if (!s.pending_) return;
    const auto above = s.phi_.at(k + 1), here = s.phi_.at(k);
    velocity_.emplace(parts_.grid, s.pending_->dt_alpha, here, above,
                      VelocityPlane<const double>{from_.u, from_.v, from_.w}, to, k);
    if (k < 0) return;  // nobody reads the pressure there
    const auto terms = parts_.correction_terms();
    const auto below = terms == CorrectionTerms::none ? here : s.phi_.at(k - 1);
    p_ = parts_.state.p.view().at_plane(k);
    pressure_.emplace(parts_.grid, terms, s.pending_->lap_weight, PressureCorrection::Phi{below, here, above}, p_, k);
  }

  void row(int j) const {
    const int nx = parts_.grid.nx();
    if (!velocity_) {
      copy_row(ConstPlane<FaceX>(from_.u), to_.u, j, nx);
      copy_row(ConstPlane<FaceY>(from_.v), to_.v, j, nx);
      copy_row(ConstPlane<FaceZ>(from_.w), to_.w, j, nx);
      return;
    }
    (*velocity_)(j);
    parts_.fill_row(to_, j, k_);
    if (!pressure_) return;
    (*pressure_)(j);
    fill_row_ghosts(p_.at_row(j), parts_.rules_p, nx, j, k_);
  }

  // After all rows.
  void ghost_rows() const {
    const int nx = parts_.grid.nx(), ny = parts_.grid.ny();
    if (!velocity_) {
      for (const int j : {-1, ny}) row(j);
      return;
    }
    parts_.fill_rows_beyond(to_, k_);
    if (pressure_) fill_ghost_rows(p_, parts_.rules_p, nx, ny, k_);
  }

  void all() const {
    for (int j = 0; j < parts_.grid.ny(); ++j) row(j);
    ghost_rows();
  }

 private:
  FlowParts& parts_;
  int k_;
  VelocityPlane<double> to_, from_;
  Plane<Center> p_;
  std::optional<VelocityCorrection> velocity_;
  std::optional<PressureCorrection> pressure_;
};

FusedSweeps::FusedSweeps(FlowParts& parts)
    : parts_(parts),
      phi_(parts.grid, parts.poisson, parts.phi, parts.rules_p, parts.halo),
      u_(parts.grid, 3),
      v_(parts.grid, 3),
      w_(parts.grid, 3) {}

// A correction that is left to the next sweep needs the predicted velocity of the neighbours' end planes.
GhostPlanes FusedSweeps::wanted_ends() const {
  return parts_.poisson.is_coupled() && !parts_.open.any() ? GhostPlanes::both : GhostPlanes::lower;
}

std::size_t FusedSweeps::bytes() const { return phi_.bytes() + u_.bytes() + v_.bytes() + w_.bytes(); }

void FusedSweeps::find_increment() {
  {
    const auto scope = parts_.timer.measure("poisson coupling of slabs");
    parts_.poisson.couple();
  }
  const auto scope = parts_.timer.measure("substitution and transform");
  phi_.start();
}

MomentumInput FusedSweeps::input(int k) const {
  const auto p = std::as_const(parts_.state.p).view();
  return {{u_[k - 1], u_[k], u_[k + 1]},
          {v_[k - 1], v_[k], v_[k + 1]},
          {w_[k - 1], w_[k], w_[k + 1]},
          p.at_plane(k),
          p.at_plane(k + 1)};
}

void FusedSweeps::make_plane_above_top() {
  const auto& m = parts_;
  const int nz = m.grid.nz(), nx = m.grid.nx(), ny = m.grid.ny();
  if (!pending_ || !m.grid.has_top()) {
    OldRows(*this, ring(nz), nz).all();
    OldRows(*this, ring(nz - 1), nz - 1).all();
    return;
  }
  OldRows(*this, ring(nz - 1), nz - 1).all();
  const auto extend = [&](auto ghost, auto interior, const SideRule& rule) {
    fill_end_plane(ghost, {interior.origin, interior.row}, rule.sign, 1, rule, nx, ny);
  };
  extend(u_[nz], u_[nz - 1], m.rules[0][5]);
  extend(v_[nz], v_[nz - 1], m.rules[1][5]);
  // The top face is given; the w above it enters nothing but its own right-hand side, which is not used.
  fill_end_plane(w_[nz - 1], {w_[nz - 1].origin, w_[nz - 1].row}, 0, 1, m.rules[2][5], nx, ny);
  fill_end_plane(w_[nz], {w_[nz - 1].origin, w_[nz - 1].row}, 0, 1, m.rules[2][5], nx, ny);
  const auto p = parts_.state.p.view();
  extend(p.at_plane(nz), p.at_plane(nz - 1), m.rules_p[5]);
}

void FusedSweeps::make_plane_below_bottom() {
  const auto& m = parts_;
  const int nx = m.grid.nx(), ny = m.grid.ny();
  if (!pending_ || !m.grid.has_bottom()) return OldRows(*this, ring(-1), -1).all();
  const auto extend = [&](auto ghost, auto interior, const SideRule& rule) {
    const double sign = rule.kind == SideRule::Kind::mirror ? rule.sign : 0;
    fill_end_plane(ghost, {interior.origin, interior.row}, sign, 1, rule, nx, ny);
  };
  extend(u_[-1], u_[0], m.rules[0][4]);
  extend(v_[-1], v_[0], m.rules[1][4]);
  extend(w_[-1], w_[0], m.rules[2][4]);
}

// What row j + 1 of plane k will want, and the correction of row j + 2 below it.
RowsAhead FusedSweeps::ahead_of_row(int j, int k) const {
  auto& m = parts_;
  RowsAhead ahead;
  const auto add = [&](const VelocityPlane<double>& f, int row) {
    ahead.add(f.u.at_row(row)), ahead.add(f.v.at_row(row)), ahead.add(f.w.at_row(row));
  };
  const auto p = m.state.p.view();
  add(planes_of(m.state, k), j + 1);
  add({m.history_u.view().at_plane(k), m.history_v.view().at_plane(k), m.history_w.view().at_plane(k)}, j + 1);
  add(ring(k + 1), j + 1);
  ahead.add(p.at_row(j + 1, k + 1));
  const int next = std::min(j + 2, m.grid.ny()), below = std::max(k - 1, 0);
  add(ring(k), next);
  ahead.add(p.at_row(next, k));
  add(planes_of(m.state, below), next);
  ahead.add(p.at_row(next, below));
  return ahead;
}

void FusedSweeps::predict(const Substep& s, const MomentumFactors& factors, double dt, NodalForces* forces) {
  auto& m = parts_;
  const int nz = m.grid.nz(), ny = m.grid.ny();
  if (pending_) find_increment();
  HelmholtzAdi* solve = m.is_implicit() ? m.begin_viscous(s, dt) : nullptr;
  {
    const auto scope = m.timer.measure("correction and momentum");
    make_plane_above_top();
  }
  for (int k = nz - 1; k >= 0; --k) {
    if (pending_) {
      const auto scope = m.timer.measure("substitution and transform");
      phi_.at(std::max(m.correction_terms() == CorrectionTerms::none ? k - 1 : k - 2, -1));
    }
    const VelocityPlane<double> out = planes_of(m.state, k);
    const MomentumInput old = input(k);
    {
      const auto scope = m.timer.measure("correction and momentum");
      const MomentumRows momentum(m.grid, m.parameters.viscous, history_use(s), factors, old,
                                  {out.u, out.v, out.w, m.history_u.view().at_plane(k), m.history_v.view().at_plane(k),
                                   m.history_w.view().at_plane(k)},
                                  m.momentum_fluxes, k);
      std::optional<OldRows> below;
      if (k > 0) {
        below.emplace(*this, ring(k - 1), k - 1);
        below->row(0);
      } else {
        make_plane_below_bottom();
      }
      for (int j = 0; j < ny; ++j) {
        if (below && j + 1 < ny) below->row(j + 1);
        if (below && j + 1 == ny) below->ghost_rows();
        momentum(j, ahead_of_row(j, k));
        if (forces != nullptr) FlowParts::add_forces(*forces, factors, out, j, j + 1, k);
        if (solve != nullptr) FlowParts::begin_viscous_row(solve, predicted(), old, j, k);
        else m.fill_row(out, j, k);
      }
      if (solve == nullptr) {
        m.fill_rows_beyond(out, k);
        continue;
      }
    }
    const auto scope = m.timer.measure("viscous solves");
    m.end_viscous_plane(solve, predicted(), old, k);
  }
  pending_.reset();
  if (solve != nullptr) m.couple_viscous(solve);
}

double FusedSweeps::project(const CorrectionFactors& factors, bool wants_rate) {
  const double rate = parts_.begin_projection(predicted(), factors.dt_alpha, wants_rate);
  pending_ = factors;
  return rate;
}

void FusedSweeps::settle() {
  if (!pending_) return;
  find_increment();
  {
    const auto scope = parts_.timer.measure("settling");
    for (int k = parts_.grid.nz() - 1; k >= 0; --k) OldRows(*this, planes_of(parts_.state, k), k).all();
  }
  pending_.reset();
  parts_.fill_state_ends();
}

}  // namespace pliant
