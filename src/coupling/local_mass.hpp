#pragma once
#include <string>

#include "coupling/soft_bodies.hpp"

namespace pliant {

/// Steps of a membrane, which without the scheme's damping would be stable up to 2/omega, within the part `alpha` of a
/// fluid step: all of a fluid step have the same length. What a symplectic step conserves is an energy that depends on
/// its length; lengths that alternate from substep to substep of the flow swing the fastest vibrations up, where the
/// mass of the wall outweighs its layer. Throws RunError if there would be too many.
int local_mass_substeps(double alpha, double step, double undamped_limit, const std::string& body);

/// Local-mass: in each substep a membrane moves together with the layer of fluid around it, rho h a unit of area, in
/// steps as small as its stiffness wants; the flow takes over what this changed. For light and stiff membranes, where
/// loose coupling fails by the mass ratio and force-spreading by the step: leaflets, stiff capsules, the wall of a
/// ventricle.
///
///   V_0 = (m V + rho h U)/(m + rho h), U the flow's velocity at the vertices as the substep begins;
///   (m + rho h) V' = F(x) + rho h (U* - U)/(alpha dt), x' = V over alpha dt, U* the predicted one;  V' - U* is spread.
///
/// First order in time. As m -> 0 it becomes force-spreading with substeps, where vertices move with the predicted
/// velocity. The pressure of the same substep does not act on the membrane's motion, so that it slips a little and a
/// closed body's volume drifts: `volume_correction` takes that back.
class LocalMass : public SoftBodies {
 public:
  LocalMass(const Grid& grid, const CaseConfig& config, Bodies& bodies, Contact& contact);

  /// Before the first substep.
  void begin() { place(), begin_step(); }
  /// A substep begins, with that flow. Collective. Throws CollectiveError.
  void before(const Substep& substep, const FlowState& flow);
  /// The flow's hook between prediction and projection. Collective. Throws CollectiveError.
  void predicted(const Substep& substep, double dt, View<FaceX> u, View<FaceY> v, View<FaceZ> w);

 private:
  void advance(const VertexTransfer::Part& part, double alpha, double dt);

  std::vector<Vec3> velocities_, forces_, pushes_;
  std::vector<Vec3> flow_before_, before_;
  std::vector<Vec3> by_flow_;  // what its acceleration does to the velocities in a substep
  std::vector<double> masses_;
};

}  // namespace pliant
