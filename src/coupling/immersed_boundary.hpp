#pragma once
#include <functional>
#include <string>
#include <vector>

#include "coupling/bodies.hpp"
#include "transfer/direct_forcing.hpp"
#include "transfer/point_router.hpp"

namespace pliant {

/// The bodies as the flow sees them: markers that it has to follow, and the forces that this takes.
class ImmersedBoundary {
 public:
  /// Throws InputError if the box is too small for markers.
  ImmersedBoundary(const Grid& grid, const CaseConfig& config);

  /// Places the markers of fixed bodies, once a run, or of all others that act on the flow, where they are now, and
  /// remembers what the flow is told. Collective. Throws CollectiveError that names a body outside the box.
  void place(Bodies& bodies, MarkerGroup group);
  /// Gives every body that acts on the flow the motion that the fluid inside it has now, as what the flow was told
  /// before: the start of a run. Vertices of deformable bodies take the flow's velocity. Collective.
  void adopt_inner_motion(Bodies& bodies, const FlowState& flow);
  /// Kinds of bodies have come or gone by their schedules: places markers anew, and gives those that have come the
  /// motion of the fluid that they now enclose. Collective. Throws CollectiveError.
  void follow_schedules(Bodies& bodies, const FlowState& flow, std::span<const std::size_t> changed);

  /// Fixed bodies begin a step with the forces that it took to hold the flow in the one before, and keep those that it
  /// took now. Collective.
  void begin_step(const Bodies& bodies);
  void end_step(Bodies& bodies);

  /// The forcing of one substep, to be called as FlowSolver's hook.
  void apply(const Substep& substep, double dt, View<FaceX> u, View<FaceY> v, View<FaceZ> w) {
    forcing_.apply(substep, dt, u, v, w);
  }

  /// Sets loads.reaction and loads.balance of the group's bodies from the forcing of the last step. `driving`: the
  /// uniform acceleration that acted on the fluid. Collective.
  void find_reactions(Bodies& bodies, MarkerGroup group, double step, Vec3 driving);
  /// Sets the slip of all bodies that act on the flow; of thin sheets, that across them. Collective.
  void measure_slip(Bodies& bodies, const FlowState& flow);

 private:
  struct Part {
    long body = 0;  // its id: bodies may change ranks until the next placement
    std::size_t begin = 0, end = 0;
  };
  struct Group {
    explicit Group(const Grid& grid) : router(grid) {}
    PointRouter router;
    std::vector<Part> parts;
    MarkerSet markers;  // of this rank's bodies, one after the other
    // Used again in every step.
    MarkerSet of_body;
    std::vector<Vec3> held_vectors, own_vectors;
    std::vector<double> held_areas;
    std::vector<Vec3> positions, velocities;
    long arrangement = 0;  // of the bodies when they were placed
  };
  Group& group_of(MarkerGroup group) { return groups_[static_cast<std::size_t>(group)]; }
  void place_sheets(const Bodies& bodies, Group& group, MarkerGroup which);
  void place_as_told(const Bodies& bodies, MarkerGroup which);
  void gather(const Bodies& bodies, MarkerGroup which, Group& group) const;
  void leave_out_along(const Bodies& bodies, Group& group);
  void adopt_inner_motion(Bodies& bodies, const FlowState& flow, const std::function<bool(const Body&)>& is_asked);
  std::string find_outside(const Bodies& bodies, MarkerGroup which) const;
  std::span<const Vec3> flow_at_markers(const FlowState& flow, MarkerGroup which);

  Grid grid_;
  double density_, viscosity_;  // kinematic
  bool carries_forces_;
  DirectForcing forcing_;
  std::array<Group, 2> groups_;
};

}  // namespace pliant
