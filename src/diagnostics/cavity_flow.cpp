#include "diagnostics/cavity_flow.hpp"

#include <algorithm>
#include <array>

namespace pliant {

CavityFlow find_cavity_flow(const Grid& grid, std::span<const InsidePiece> pieces, const FlowState& state,
                            const CenteredFlow& centered, double density, const std::optional<JetConfig>& jet) {
  const Vec3 axis = jet ? normalized(jet->axis) : Vec3{};
  CavityFlow flow;
  for_cells_inside(grid, pieces, [&](int i, int j, int k, double share, Vec3 shift) {
    const double volume = share * grid.dx() * grid.dy() * grid.dz_c()[k];
    const Vec3 velocity = centered.velocity(state, i, j, k), vorticity = centered.vorticity(state, i, j, k);
    flow.volume += volume;
    flow.kinetic_energy += 0.5 * density * volume * dot(velocity, velocity);
    flow.enstrophy += 0.5 * volume * dot(vorticity, vorticity);
    constexpr double most = 0.5;  // of a cell
    if (!jet || share < most || !(dot(velocity, axis) > jet->threshold)) return;
    const Vec3 place = Vec3{grid.x_center(i), grid.y_center(j), grid.z_center()[k]} + shift;
    flow.jet_depth = std::max(flow.jet_depth, dot(place - jet->origin, axis));
  });
  std::array sums{flow.volume, flow.kinetic_energy, flow.enstrophy};
  grid.ranks().sum(sums);
  return {sums[0], sums[1], sums[2], grid.ranks().max(flow.jet_depth)};
}

}  // namespace pliant
