#pragma once
#include <span>

#include "coupling/forced_vertices.hpp"

namespace pliant {

/// Strong coupling of a deformable body by fixed point: its unknowns are the forces of the flow on its vertices, as the
/// change of velocity that they make in the step, the layer of fluid at the wall included: y = F dt / (m + rho h a).
/// From them its motion follows as advance_forced makes it.
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
};

}  // namespace pliant
