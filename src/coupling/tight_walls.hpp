#pragma once
#include <Eigen/Core>
#include <vector>

#include "coupling/bodies.hpp"
#include "flow/flow_solver.hpp"

namespace pliant {

/// Parts of fixed open bodies that no net flow passes (`tight` in the case).
///
/// Markers force the predicted velocity, and the projection after it may press fluid through them again. Where a wall
/// parts the box that is cheap for the fluid and takes the forcing many substeps to stop: a valve that shuts lets the
/// plate around it leak and ring. So the flux through each part is made to vanish after the projection, exactly:
///
///   q_r(u) = sum of the flow along the normals of part r through the faces of cells that stand for it (WallLink)
///          = sum_f g_rf u_f dV_f over the nodes;
///   q_r(P u*) = q_r(u*) + sum_c phi_r div(u*) dV_c,  lap phi_r = div g_r, as the projection P is symmetric;
///   u* <- u* - sum_s a_s g_s,  sum_s q_r(P g_s) a_s = q_r(P u*).
///
/// g and phi are found once, so that a substep reads the predicted velocity once, and the phi of the parts.
class TightWalls {
 public:
  /// Collective. Bodies must be where they stay. Settles the flow.
  TightWalls(FlowSolver& flow, const Bodies& bodies);

  /// Of the parts that are there in the present step; the same on all ranks.
  bool any(const Bodies& bodies) const;
  /// Forgets what the parts have taken.
  void begin_step();
  /// In a substep, after all other forcing. Values on the sides of the box must be filled; no ghosts are read.
  /// Collective.
  void apply(const Bodies& bodies, View<FaceX> u, View<FaceY> v, View<FaceZ> w);
  /// The mean load on one of this rank's bodies by what its parts have taken in a step of that length.
  RigidLoad load_on(const Body& body, double step) const;

 private:
  struct Node {
    std::ptrdiff_t offset;  // from element (0, 0, 0)
    double g, weighted;     // g dV
  };
  struct Part {
    explicit Part(const Grid& grid) : potential(grid) {}
    std::size_t kind = 0;
    long body = 0;
    std::vector<Node> u, v, w;
    Field<Center> potential;  // beyond bounded sides 0
    RigidLoad of_unit_pressure;
    double taken = 0;  // sum of a_s over the step
  };
  struct Workspace;
  void add_part(FlowSolver& flow, const Body* body, std::span<const Face> faces, Part& part, Workspace& work);
  void follow(const Bodies& bodies);
  void find_fluxes(ConstView<FaceX> u, ConstView<FaceY> v, ConstView<FaceZ> w);

  Grid grid_;
  double density_;
  std::vector<Part> parts_;
  Eigen::MatrixXd response_;    // q_r(P g_s)
  Eigen::VectorXd free_;        // sum g_r^2 dV: the response without a projection
  std::vector<double> fluxes_;  // after the projection
  std::vector<bool> is_on_;     // by part, and for these:
  Eigen::MatrixXd correction_;  // a = correction q
};

}  // namespace pliant
