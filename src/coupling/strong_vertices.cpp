#include "coupling/strong_vertices.hpp"

namespace pliant {

StrongVertices::StrongVertices(const Body& body, double layer, double step)
    : step_(step),
      masses_(body.surface.masses),
      positions_(body.surface.positions),
      velocities_(body.surface.velocities),
      own_velocities_(body.mass_velocities.empty() ? body.surface.velocities : body.mass_velocities) {
  for (std::size_t v = 0; v < masses_.size(); ++v) masses_[v] += layer * body.surface.reference_areas[v];
}

void StrongVertices::write(const Body& body, std::span<double> values) const {
  for (std::size_t v = 0; v < masses_.size(); ++v)
    for (int c = 0; c < 3; ++c)
      values[3 * v + static_cast<std::size_t>(c)] = step_ / masses_[v] * body.flow_forces[v][c];
}

void StrongVertices::apply(Body& body, const BodyKind& kind, const NodalSurroundings& surroundings,
                           SurfaceContact* contact, std::span<const double> values) const {
  auto& surface = body.surface;
  for (std::size_t v = 0; v < masses_.size(); ++v)
    for (int c = 0; c < 3; ++c)
      body.flow_forces[v][c] = masses_[v] / step_ * values[3 * v + static_cast<std::size_t>(c)];
  surface.velocities = own_velocities_;
  advance_forced(body, kind, surroundings, contact, step_);
  body.mass_velocities = surface.velocities;
  for (std::size_t v = 0; v < masses_.size(); ++v) {
    surface.velocities[v] = (surface.positions[v] - positions_[v]) / step_;
    body.accelerations[v] = (surface.velocities[v] - velocities_[v]) / step_;
  }
}

void StrongVertices::rewind(Body& body) const {
  body.surface.positions = positions_;
  body.surface.velocities = velocities_;
}

}  // namespace pliant
