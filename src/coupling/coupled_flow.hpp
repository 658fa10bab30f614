#pragma once
#include <optional>

#include "coupling/advance_body.hpp"
#include "coupling/contact.hpp"
#include "coupling/force_spreading.hpp"
#include "coupling/forced_vertices.hpp"
#include "coupling/immersed_boundary.hpp"
#include "coupling/local_mass.hpp"
#include "coupling/tight_walls.hpp"
#include "flow/flow_solver.hpp"
#include "transfer/mls_sampler.hpp"

namespace pliant {

enum class RunStart {
  anew,      ///< the fluid inside bodies takes part in the initial flow
  continued  ///< bodies know what the flow was told before
};

/// A fluid and the bodies in it: what every coupling scheme works on.
class CoupledFlow {
 public:
  /// Collective. Places the bodies in the flow as it is, which must have its initial state. `flow` and `bodies` must
  /// outlive it.
  CoupledFlow(const CaseConfig& config, FlowSolver& flow, Bodies& bodies, RunStart start);

  FlowSolver& flow() { return flow_; }
  Bodies& bodies() { return bodies_; }
  const CouplingConfig& settings() const { return config_.coupling; }
  const FluidConfig& fluid() const { return config_.fluid; }
  const FlowSampler& sampler() const { return sampler_; }

  /// A step begins, with its middle at this time: bodies come and go by their schedules. Collective. Throws
  /// CollectiveError.
  void follow_schedules(double time);
  /// Tells the flow where the bodies that move are now, and how fast. Collective.
  void place_markers();
  /// Moves the fluid through a step; it follows the markers. Collective.
  void advance_fluid(double step);
  /// Sets the loads of all bodies from the flow after that step: the reaction of the forcing, stresses where they move
  /// a body, contact. Collective.
  void find_loads(double step);
  /// The load that moves a rigid or hinged body.
  RigidLoad load_on(const Body& body) const;
  /// Bodies that move with the flow do so in advance_fluid(): where they are now, and the way back there, for those who
  /// take the flow back as well.
  void save_soft_bodies();
  void restore_soft_bodies();
  /// Ends the step of bodies that move with the flow. Collective. Throws CollectiveError.
  void finish_soft_bodies(double step);
  /// A step of deformable bodies that act on the flow begins and ends for contact (Contact). Collective.
  void begin_contact(double step);
  void end_contact(double step);
  SurfaceContact* contact_of(const Body& body) { return contact_.of(body); }
  /// What moves the vertices of deformable bodies besides the flow.
  NodalSurroundings nodal_surroundings() const { return {config_.forcing.gravity, config_.fluid.density}; }
  /// The step is done: what the flow was told becomes what it was told before.
  void accept();

  /// Slip, stresses and all loads, of bodies at rest too, for tables and files. Collective.
  void diagnose();

  /// Moves deformable bodies, which feel the flow and which it does not feel. Collective. Throws CollectiveError.
  void advance_one_way_bodies(double step);

  /// The largest step that soft bodies are stable with; infinite without them. The same on all ranks.
  double step_limit() const;

  /// Time by phase, the flow's own phases left out.
  const PhaseTimer& timer() const { return timer_; }

  /// True if a body moves by strong coupling, and if any acts on the flow; the same on all ranks.
  bool has_strong() const { return has_strong_; }
  bool is_two_way() const { return is_two_way_; }
  /// The flow is forced after the viscous solves, by markers or local-mass.
  bool forces_late() const { return boundary_ || local_mass_; }

 private:
  Vec3 driving() const;
  bool is_followed() const;
  void add_loads_of_tight_walls();
  void settle();
  FlowHooks hooks();

  CaseConfig config_;
  FlowSolver& flow_;
  Bodies& bodies_;
  std::optional<ImmersedBoundary> boundary_;  // if the flow has to follow a body
  std::optional<TightWalls> tight_walls_;
  std::optional<ForceSpreading> force_spreading_;
  std::optional<LocalMass> local_mass_;
  Contact contact_;
  VelocityCopies copies_;
  MlsSampler sampler_;
  bool has_strong_ = false, is_two_way_ = false, has_probe_driven_ = false, has_one_way_ = false,
       has_two_way_vertices_ = false;
  std::vector<Body> saved_soft_;
  PhaseTimer timer_;
  double last_step_ = 0;
};

}  // namespace pliant
