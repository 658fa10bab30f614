#pragma once
#include "flow/flow_parts.hpp"

namespace pliant {

/// One loop over the planes for each operator, and a state that is settled after every substep: slower, and easy to
/// follow; the reference for FusedSweeps.
class PlainSweeps : public FlowSweeps {
 public:
  explicit PlainSweeps(FlowParts& parts);

  void predict(const Substep& s, const MomentumFactors& factors, double dt, NodalForces* forces) override;
  VelocityFields predicted() override { return {u_, v_, w_}; }
  GhostPlanes wanted_ends() const override { return GhostPlanes::lower; }
  double project(const CorrectionFactors& factors, bool wants_rate) override;
  void settle() override {}
  void discard() override {}
  void adopt_state() override;
  std::size_t bytes() const override { return u_.bytes() + v_.bytes() + w_.bytes(); }

 private:
  void change_places();
  void solve_for_phi();
  void correct(const CorrectionFactors& factors);

  FlowParts& parts_;
  Field<FaceX> u_;  // the predicted velocity; changes places with the state when it is corrected
  Field<FaceY> v_;
  Field<FaceZ> w_;
};

}  // namespace pliant
