#pragma once
#include <optional>
#include <vector>

#include "coupling/contact.hpp"
#include "coupling/nodal_forces.hpp"
#include "coupling/vertex_transfer.hpp"
#include "flow/flow_solver.hpp"

namespace pliant {

/// What the schemes have in common that move the vertices of deformable bodies together with the flow around them,
/// substep by substep: force-spreading and local-mass.
class SoftBodies {
 public:
  SoftBodies(const Grid& grid, const CaseConfig& config, Bodies& bodies, Contact& contact, CouplingKind coupling);

  bool any() const { return any_; }
  /// Mass of the layer of fluid, a mean grid spacing thick, that moves with a unit of area.
  double layer() const { return density_ * spacing_; }

  /// At the beginning of a run: vertices take the velocity of the initial flow; a body with pinned ones is at rest.
  /// Collective.
  void adopt_flow(const FlowState& flow);
  /// Ends a step: volumes of closed bodies, means of the forces on the flow, finite places. Collective. Throws
  /// CollectiveError.
  void finish(double step);
  /// Sets the slip of the bodies: their vertices against the flow there. Collective.
  void measure_slip(const FlowState& flow);

 protected:
  void place() { transfer_.place(bodies_, coupling_); }
  /// What acts on the vertices of all parts but the flow.
  void find_forces(std::vector<Vec3>& forces);
  /// The body's shape at its present positions.
  const ShapeState& shape_of(const VertexTransfer::Part& part);
  /// Of a body that separates parts of the box: takes the even part of the pressure difference from the forces.
  void remove_mean_pressure(const VertexTransfer::Part& part, std::span<Vec3> forces) const;
  /// Adds to what the flow has been given in this step.
  void count_impulse(const VertexTransfer::Part& part, std::span<const Vec3> impulses);
  void begin_step();
  /// Of the body's vertices, the layer of fluid at its wall included.
  std::vector<double> layered_masses(const VertexTransfer::Part& part) const;
  /// Weighted by area; one vector a vertex of the body.
  Vec3 mean_of(const VertexTransfer::Part& part, std::span<const Vec3> of_body) const;

  Grid grid_;
  Bodies& bodies_;
  Contact& contact_;
  CouplingKind coupling_;
  VertexTransfer transfer_;
  Vec3 gravity_;
  double density_, spacing_;
  double elapsed_ = 0;  // of the step, before the present substep

 private:
  bool any_ = false;
  std::vector<std::optional<ShapeState>> shapes_;  // by kind
};

}  // namespace pliant
