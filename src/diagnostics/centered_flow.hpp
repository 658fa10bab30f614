#pragma once
#include <array>
#include <vector>

#include "config/case_config.hpp"
#include "flow/flow_solver.hpp"

namespace pliant {

/// The flow at cell centres, at second order: velocities are the means of a cell's two faces, the vorticity consists of
/// their differences over three cells. Beside a side where the velocity along it is given, the difference takes the
/// side itself instead of a point beyond it.
class CenteredFlow {
 public:
  CenteredFlow(const Grid& grid, const BoundaryConfig& boundary);

  /// Ghosts must be filled, corners too. Indices of cells of this rank's slab.
  Vec3 velocity(const FlowState& state, int i, int j, int k) const;
  Vec3 vorticity(const FlowState& state, int i, int j, int k) const;

 private:
  /// Weights of the cell before, the cell itself and the cell behind.
  using Weights = std::array<double, 3>;

  std::array<std::array<std::vector<Weights>, 3>, 3> slopes_;  // of a component, along a direction, by cell
};

}  // namespace pliant
