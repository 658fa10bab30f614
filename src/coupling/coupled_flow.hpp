#pragma once
#include "coupling/advance_body.hpp"
#include "coupling/contact.hpp"
#include "coupling/immersed_boundary.hpp"
#include "flow/flow_solver.hpp"
#include "transfer/mls_sampler.hpp"

namespace pliant {

/// A fluid and the bodies in it: what every coupling scheme works on.
class CoupledFlow {
 public:
  /// Collective. Places the bodies in the flow as it is, which must have its initial state. `flow` and `bodies` must
  /// outlive it.
  CoupledFlow(const CaseConfig& config, FlowSolver& flow, Bodies& bodies);

  FlowSolver& flow() { return flow_; }
  Bodies& bodies() { return bodies_; }
  const CouplingConfig& settings() const { return config_.coupling; }
  const FluidConfig& fluid() const { return config_.fluid; }
  const FlowSampler& sampler() const { return sampler_; }

  /// Tells the flow where the bodies that move are now, and how fast. Collective.
  void place_markers() { boundary_.place(bodies_, MarkerGroup::moving); }
  /// Moves the fluid through a step; it follows the markers. Collective.
  void advance_fluid(double step);
  /// Sets the loads of all bodies from the flow after that step: the reaction of the forcing, stresses where they move
  /// a body, contact. Collective.
  void find_loads(double step);
  /// The load that moves a rigid or hinged body.
  RigidLoad load_on(const Body& body) const;
  /// The step is done: what the flow was told becomes what it was told before.
  void accept();

  /// Slip, stresses and all loads, of bodies at rest too, for tables and files. Collective.
  void diagnose();

  /// Places the markers of all bodies anew: after a restart. Collective.
  void place_all();

  /// True if a body moves by strong coupling, and if any acts on the flow; the same on all ranks.
  bool has_strong() const { return has_strong_; }
  bool is_two_way() const { return is_two_way_; }
  bool has_free() const { return has_free_; }

 private:
  Vec3 driving() const;

  CaseConfig config_;
  FlowSolver& flow_;
  Bodies& bodies_;
  ImmersedBoundary boundary_;
  Contact contact_;
  MlsSampler sampler_;
  bool has_strong_ = false, is_two_way_ = false, has_free_ = false, has_probe_driven_ = false;
  double last_step_ = 0;
};

}  // namespace pliant
