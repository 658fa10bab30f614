#pragma once
#include "coupling/soft_bodies.hpp"

namespace pliant {

/// Force-spreading: the vertices of a deformable body move with the flow, and its forces act on the flow. For
/// interfaces and membranes that are light, or whose own inertia does not matter: drops, capsules, cells.
///
/// In every substep, with U the flow's velocity at the vertices, found by the transpose of what spreads forces F(x):
///   x' = x + (alpha dt/2) U,  the flow under F(x') for alpha dt,  U' at x',  x'' = x' + (alpha dt/2) U'
/// (Stoermer-Verlet: second order, and without a gain of energy). Forces enter before the viscous solves, which smooth
/// what they do within the substep; else steps would be held down to h^2/nu at low Reynolds numbers.
///
/// Mass m a unit of area: V, the velocity of the membrane's momentum, and the layer of fluid around it, rho h a unit of
/// area, meet in each substep at V' = (m V + rho h U*)/(m + rho h), U* the predicted velocity; what this changes in the
/// layer is spread, so that momentum is conserved. Pinned vertices are infinitely heavy. A body that is held gives the
/// flow what keeps it at rest: a closed one its centroid, by a body force inside, an open one the mean of its vertices.
/// The pressure inside a closed body is shown without the even part of its jump at the surface, which is not spread.
///
/// The vertices of a liquid interface (surface tension alone, without mesh_control) move along its normals and are kept
/// even along the surface: what they do there, the flow does not feel. With mesh_control it does, and the interface
/// resists stretching along the surface as one with surfactants does.
///
/// Stable up to alpha dt omega = 2, omega the largest frequency of the vertices with the layer's mass (step_limit).
class ForceSpreading : public SoftBodies {
 public:
  ForceSpreading(const Grid& grid, const CaseConfig& config, Bodies& bodies, Contact& contact);

  /// The largest step that this rank's knowledge of the kinds allows; the same on all ranks, infinite without bodies.
  double step_limit() const { return step_limit_; }

  /// The hooks of the flow. Collective.
  void before(const Substep& substep, double dt);
  void predicted(const Substep& substep, double dt, View<FaceX> u, View<FaceY> v, View<FaceZ> w);
  void corrected(const Substep& substep, double dt, const FlowState& flow);
  NodalForces* forces() { return &transfer_.fields(); }
  bool wants_predicted() const { return has_inertia_; }

 private:
  void drift(double time);
  void keep_apart(const VertexTransfer::Part& part, double time);
  /// Of the enclosed volume's centroid, or the mean over an open surface.
  Vec3 common_velocity(const VertexTransfer::Part& part, std::span<const Vec3> velocities) const;
  /// The force that holds a closed body, from what it remembers, and what it is to remember.
  void add_hold(const VertexTransfer::Part& part, double time, std::span<Vec3> forces) const;
  void adjust_hold(const VertexTransfer::Part& part, double dt, Vec3 left) const;

  double step_limit_;
  bool has_inertia_ = false;
  std::vector<Vec3> forces_, velocities_;
};

}  // namespace pliant
