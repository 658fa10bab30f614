#pragma once
#include <vector>

#include "core/vec3.hpp"

namespace pliant {

/// What the flow does to each vertex: force + drag (flow_velocity - velocity). The drag part is apart because it is
/// treated implicitly, so that a stiff drag leaves the time step free.
struct VertexLoads {
  std::vector<Vec3> forces;
  std::vector<double> drag;  ///< force / velocity, not negative
  std::vector<Vec3> flow_velocities;

  void assign(std::size_t n_vertices) {
    forces.assign(n_vertices, {});
    drag.assign(n_vertices, 0.0);
    flow_velocities.assign(n_vertices, {});
  }
};

}  // namespace pliant
