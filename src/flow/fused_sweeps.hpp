#pragma once
#include <optional>

#include "field/plane_ring.hpp"
#include "flow/flow_parts.hpp"
#include "solvers/poisson_planes.hpp"

namespace pliant {

/// Few passes through memory. Sweep A, from the top down, finds the pressure increment of a plane, corrects the plane
/// with it, and makes the right-hand side of the plane above, which now has corrected neighbours on both sides; the
/// corrected velocity lives in three planes and is never written. Sweep B, from the bottom up, takes the divergence,
/// transforms and eliminates. Between them is the place of the immersed boundary. So after a step the state is pending:
/// its velocity is the predicted one, and its pressure lacks the increment, until settle() or the next sweep A.
///
/// ARCHITECTURE.md draws both sweeps.
class FusedSweeps : public FlowSweeps {
 public:
  /// sweeps_in_use() says where this is possible.
  explicit FusedSweeps(FlowParts& parts);

  void predict(const Substep& s, const MomentumFactors& factors, double dt, NodalForces* forces) override;
  VelocityFields predicted() override { return parts_.state_velocity(); }
  GhostPlanes wanted_ends() const override;
  double project(const CorrectionFactors& factors, bool wants_rate) override;
  void settle() override;
  void discard() override { pending_.reset(); }
  void adopt_state() override {}  // it stands where the predicted velocity does
  std::size_t bytes() const override;

 private:
  /// What makes plane k of the old velocity, row by row: the correction of the last substep, or a copy of the state.
  class OldRows;

  void find_increment();
  VelocityPlane<double> ring(int k) const { return {u_[k], v_[k], w_[k]}; }
  void make_plane_above_top();
  void make_plane_below_bottom();
  MomentumInput input(int k) const;
  RowsAhead ahead_of_row(int j, int k) const;

  FlowParts& parts_;
  PoissonPlanes phi_;
  PlaneRing<FaceX> u_;  // old velocity
  PlaneRing<FaceY> v_;
  PlaneRing<FaceZ> w_;
  std::optional<CorrectionFactors> pending_;
};

}  // namespace pliant
