#pragma once
#include "coupling/aitken.hpp"
#include "coupling/coupled_flow.hpp"
#include "coupling/quasi_newton.hpp"

namespace pliant {

class StrongUnknowns;

/// How hard the last step of strong coupling was.
struct StrongReport {
  int iterations = 0;
  double residual = 0;  ///< largest change of a velocity in the last one, over the largest velocity
};

/// Strong coupling: the fluid step is done again from its start until the motion that the flow was told agrees with the
/// one that its loads make. Unknowns are the motions of all bodies with coupling "strong" at the end of the step; those
/// coupled loosely keep their place meanwhile.
///
/// One iteration maps the motion y that the flow is told to the image G(y):
/// - aitken: Newton's law over the step under the load that this motion causes (backward in the load);
/// - hamming: the corrector of Hamming's method with the accelerations that this motion causes, after the estimated
/// added
///   mass has been taken out of the load and put to the body (else it would ring from 7/9 of the body's own mass on).
/// - deformable bodies: StrongVertices.
/// All relax towards the fixed point y = G(y) with Aitken's factor, or by quasi-Newton. Fixed points hold bodies of any
/// mass ratio, Hamming's formula as long as the estimate, or the virtual mass or inertia if that is more, is not less
/// than half the true one.
class StrongCoupling {
 public:
  StrongCoupling(const Communicator& ranks, const CouplingConfig& settings);

  /// One step to `time`. Collective. Throws CollectiveError if the iterations do not converge, which
  /// names the body that still changes most.
  StrongReport advance(CoupledFlow& coupled, double time, double step);

  /// What a checkpoint needs beyond the bodies.
  std::vector<double> state() const { return relaxation_.state(); }
  void restore(std::span<const double> state) { relaxation_.restore(state); }

 private:
  [[noreturn]] void fail(const StrongUnknowns& unknowns, std::span<const double> image, double change,
                         const StrongReport& report) const;

  Communicator ranks_;
  CouplingConfig settings_;
  AitkenRelaxation relaxation_;
  QuasiNewton quasi_newton_;
  FlowSolver::Snapshot start_;
};

}  // namespace pliant
