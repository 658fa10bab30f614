#pragma once
#include <cstdint>
#include <string>
#include <vector>

#include "config/case_config.hpp"
#include "loads/momentum_balance.hpp"
#include "loads/probe_loads.hpp"
#include "loads/slip.hpp"
#include "structure/deformable_body.hpp"
#include "structure/hinge.hpp"
#include "structure/mass_properties.hpp"
#include "structure/prescribed_motion.hpp"
#include "structure/rigid_body.hpp"
#include "transfer/marker_refinement.hpp"

namespace pliant {

/// What all copies of one [[body]] share; does not change during a run.
struct BodyKind {
  BodyConfig config;
  CouplingKind coupling = CouplingKind::one_way;  ///< chosen, where the case says "auto"
  double added_mass_ratio = 0;                    ///< of the fluid moved along over the body's own mass; rigid, hinge
  DeformableBody prototype;                       ///< at rest with the surface's origin at 0
  Vec3 centroid;                                  ///< of mass, or of the shape where there is no mass; in the prototype
  std::vector<Vec3> reference;                    ///< vertices about the centroid
  SolidMoments displaced;                         ///< of the enclosed volume about the centroid; volume 0: open
  MarkerLayout layout;
  double retraction = 0;                       ///< of markers, inwards; length
  std::vector<std::vector<Face>> tight_parts;  ///< that no net flow passes (TightWalls)
  ProbeSettings probes;
  double mass = 0;                      ///< of a rigid or hinged body
  RigidModel rigid;                     ///< motion = "rigid"
  HingeModel hinge;                     ///< motion = "hinge"
  PrescribedMotion path;                ///< motion = "prescribed"
  bool meets_flow_at_vertices = false;  ///< of a soft body: else at the points of `layout`
  bool restores_volume = false;         ///< of a soft body
  double layered_limit = 0;             ///< of a soft body's substeps: 2/omega, the layer of fluid at its wall included

  double wall_mass_ratio = 0;  ///< of a deformable body; see added_mass.hpp
  double spacing = 0;          ///< mean, of the grid
  double convective_step = 0;  ///< what the speeds in the case let the flow take; infinite if they are 0

  bool is_closed() const { return displaced.volume > 0; }
  /// Parts the box in two, by itself or with other bodies.
  bool separates() const { return is_closed() || config.separates; }
  /// Fluid on both sides, and no thickness that the flow should feel.
  bool is_thin_sheet() const { return !is_closed() && config.thin_sheet && config.coupling != CouplingKind::one_way; }
  /// Moves together with the flow, substep by substep.
  bool is_soft() const { return coupling == CouplingKind::force_spreading || coupling == CouplingKind::local_mass; }
  /// The flow has to follow its markers.
  bool forces_flow() const { return acts_on_flow() && !is_soft(); }
  bool acts_on_flow() const { return coupling != CouplingKind::one_way; }
  /// Its vertices follow a pose; else Newton's law, one by one.
  bool has_pose() const { return config.motion != MotionKind::deformable; }
  /// Its pose follows from loads.
  bool is_free() const { return config.motion == MotionKind::rigid || config.motion == MotionKind::hinge; }
  /// Stress at probes moves it, not the momentum balance.
  bool is_driven_by_probes() const {
    return (is_free() || (!has_pose() && forces_flow())) && config.loads == LoadSource::probes;
  }
};

/// What the flow does to a body, torques about its centre, means or values of the last step.
struct BodyLoads {
  RigidLoad reaction;  ///< of the fluid on the markers, minus the forcing; with the diagnostics, on tight parts too
  RigidLoad balance;   ///< of the outer fluid, from the momentum balance
  RigidLoad probes;    ///< from the stress at the probes; not a number while a probe is outside the box
  RigidLoad contact;   ///< with other bodies and walls
  RigidLoad pressed;   ///< the part of it that deformable bodies had in the last step
};

/// Signs of an instability of loose coupling: accelerations that change sign from step to step, and grow.
struct SwingCount {
  Vec3 last;
  double largest = 0, largest_before = 0;  ///< size, in the present window of steps and in the one before
  int steps = 0, reversals = 0;            ///< in the present window
  int windows = 0;                         ///< in a row that swung and grew
  double largest_at_first = 0;             ///< in the window before these
};

/// One body of a run, held by the rank that computes it.
struct Body {
  long id = 0;           ///< of the whole run: the order of the case file, copies one after the other
  std::size_t kind = 0;  ///< its [[body]]
  DeformableBody surface;
  Vec3 origin;  ///< where the surface's origin was put
  Vec3 start;   ///< pose.center at angle 0 and no displacement
  Quaternion start_orientation;
  RigidState pose;
  RigidAcceleration acceleration;
  HingeState hinge;
  double hinge_acceleration = 0;
  RigidState told, told_before;  ///< pose and motion that the flow was last told, and in the step before
  RigidState met;                ///< pose when deformable bodies last ended a step
  BodyLoads loads;
  std::vector<Vec3> told_positions, told_velocities;  ///< of deformable bodies that the flow has to follow
  std::vector<Vec3> flow_forces, accelerations;       ///< of these, by vertex, in the last step
  std::vector<Vec3> carried_forces;                   ///< of a fixed body, by marker (DirectForcing::carry)
  std::vector<Vec3> mass_velocities;                  ///< of its own mass: force-spreading, strong
  std::vector<std::uint8_t>
      in_contact;                   ///< of a soft body's vertices: 1 if another surface held them in the last substep
  double volume_restored = 0;       ///< since the start, over the volume
  std::vector<double> scheme;       ///< what the strong scheme remembers from step to step
  SwingCount swing, turning_swing;  ///< of the linear and of the angular acceleration
  Slip slip;                        ///< found with the diagnostics
  ProbeLoads stresses;              ///< the same
  SurfaceSites sites;               ///< where the stresses are

  const std::string& name() const { return surface.name; }
};

/// Where a hinged or prescribed body is, from its angle or the time.
RigidState hinged_pose(const Body& body, const BodyKind& kind);
RigidState prescribed_pose(const Body& body, const BodyKind& kind, double time);
RigidAcceleration prescribed_acceleration(const Body& body, const BodyKind& kind, double time);

/// Largest distance of a vertex from the centre: turns rates of rotation into bounds on velocities.
double extent_of(const BodyKind& kind);

/// Puts vertices and their velocities where the pose says.
void follow_pose(Body& body, const BodyKind& kind);

}  // namespace pliant
