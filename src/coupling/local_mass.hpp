#pragma once
#include "coupling/soft_bodies.hpp"

namespace pliant {

/// Local-mass: in each substep a membrane moves together with the layer of fluid around it, rho h a unit of area, in
/// steps as small as its stiffness wants; the flow takes over what this changed. For light and stiff membranes, where
/// loose coupling fails by the mass ratio and force-spreading by the step: leaflets, stiff capsules, the wall of a
/// ventricle.
///
///   V_0 = (m V + rho h U*)/(m + rho h),  U* the predicted velocity at the vertices;
///   (m + rho h) V' = F(x), x' = V over alpha dt;  V' - U* is spread.
///
/// First order in time. As m -> 0 it becomes force-spreading with substeps, where vertices move with the predicted
/// velocity. The pressure of the same substep does not act on the membrane's motion, so that it slips a little and a
/// closed body's volume drifts: `volume_correction` takes that back.
class LocalMass : public SoftBodies {
 public:
  LocalMass(const Grid& grid, const CaseConfig& config, Bodies& bodies, Contact& contact);

  /// Before the first substep.
  void begin() { place(), begin_step(); }
  /// The flow's hook between prediction and projection. Collective. Throws CollectiveError.
  void predicted(const Substep& substep, double dt, View<FaceX> u, View<FaceY> v, View<FaceZ> w);

 private:
  void advance(const VertexTransfer::Part& part, double time);

  std::vector<Vec3> velocities_, forces_, pushes_;
  std::vector<double> masses_;
};

}  // namespace pliant
