#pragma once
#include <span>

#include "coupling/forced_vertices.hpp"

namespace pliant {

/// Strong coupling of a deformable body by fixed point: its unknowns are the forces of the flow on its vertices, as the
/// change of velocity that they make in the step, the layer of fluid at the wall included: y = F dt / (m + rho h a).
/// From them its motion follows as advance_forced makes it.
///
/// What the flow is told is the way over the step, V = (x' - x) / dt, not the velocity v' at its end, with which the
/// wall goes on (mass_velocities). A stiff and light wall vibrates in a step that the flow resolves; with the added
/// mass l of the flow, F = -l (V' - V) / dt, and V = v a mode of frequency w has solutions that grow wherever w dt is
/// a little above pi, and none at all once l / m > 4.6 (1 + l/m sin(w dt) / (w dt) = 0). With the mean no mode grows
/// for any l / m and w dt: what the force does to the way, (1 - cos(w dt)) / (w dt)^2, never changes its sign.
class StrongVertices {
 public:
  StrongVertices() = default;
  /// Takes down where the body is at the start of the step. `layer`: fluid mass a unit of area.
  StrongVertices(const Body& body, double layer, double step);

  const std::vector<Vec3>& start_velocities() const { return velocities_; }
  std::size_t size() const { return 3 * masses_.size(); }
  /// From the flow's forces of the step before, or of the present iteration, to unknowns.
  void write(const Body& body, std::span<double> values) const;
  /// Moves the body from its start under the forces that the values stand for.
  void apply(Body& body, const BodyKind& kind, const NodalSurroundings& surroundings, SurfaceContact* contact,
             std::span<const double> values) const;
  /// Puts the body back to the start.
  void rewind(Body& body) const;

 private:
  double step_ = 0;
  std::vector<double> masses_;  // with the layer
  std::vector<Vec3> positions_, velocities_;
  std::vector<Vec3> own_velocities_;  // of its mass at the start
};

}  // namespace pliant
