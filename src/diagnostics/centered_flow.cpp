#include "diagnostics/centered_flow.hpp"

#include "boundary/side_rules.hpp"

namespace pliant {
namespace {

/// A neighbour of a cell centre along a line, as the weights with which ghost and cell make its value.
struct Neighbour {
  double distance, of_ghost = 1, of_cell = 0;
};

/// What stands next to the outermost cell: the side, half a cell off, where the value on it is given; else the ghost.
Neighbour beyond(const SideRule& rule, double cell, double to_ghost) {
  const bool is_given = rule.kind == SideRule::Kind::mirror && rule.sign == -1;
  return is_given ? Neighbour{0.5 * cell, 0.5, 0.5} : Neighbour{to_ghost};
}

/// Slope of the parabola through three points, at the middle one.
std::array<double, 3> slope(const Neighbour& lower, const Neighbour& upper) {
  const double below = lower.distance, above = upper.distance, both = below + above;
  const double a = -above / (below * both), c = below / (above * both);
  return {a * lower.of_ghost, -(a + c) + a * lower.of_cell + c * upper.of_cell, c * upper.of_ghost};
}

double apply(const std::array<double, 3>& weights, double before, double here, double behind) {
  return weights[0] * before + weights[1] * here + weights[2] * behind;
}

}  // namespace

CenteredFlow::CenteredFlow(const Grid& grid, const BoundaryConfig& boundary) {
  const std::array<int, 3> cells{grid.nx(), grid.ny(), grid.nz()};
  const std::array<bool, 3> has_lower{!grid.is_periodic(0), !grid.is_periodic(1), grid.has_bottom()};
  const std::array<bool, 3> has_upper{!grid.is_periodic(0), !grid.is_periodic(1), grid.has_top()};
  // Thickness of cell n, and distance from its centre to the next.
  const auto thickness = [&](std::size_t d, int n) { return d == 0 ? grid.dx() : d == 1 ? grid.dy() : grid.dz_c()[n]; };
  const auto distance = [&](std::size_t d, int n) { return d == 0 ? grid.dx() : d == 1 ? grid.dy() : grid.dz_f()[n]; };
  for (std::size_t c = 0; c < 3; ++c) {
    const auto rules = velocity_rules(boundary, static_cast<int>(c));
    for (std::size_t d = 0; d < 3; ++d) {
      if (c == d) continue;
      for (int n = 0; n < cells[d]; ++n) {
        Neighbour lower{distance(d, n - 1)}, upper{distance(d, n)};
        if (n == 0 && has_lower[d]) lower = beyond(rules[2 * d], thickness(d, n), lower.distance);
        if (n == cells[d] - 1 && has_upper[d]) upper = beyond(rules[2 * d + 1], thickness(d, n), upper.distance);
        slopes_[c][d].push_back(slope(lower, upper));
      }
    }
  }
}

Vec3 CenteredFlow::velocity(const FlowState& state, int i, int j, int k) const {
  const auto u = state.u.view();
  const auto v = state.v.view();
  const auto w = state.w.view();
  return {0.5 * (u(i - 1, j, k) + u(i, j, k)), 0.5 * (v(i, j - 1, k) + v(i, j, k)),
          0.5 * (w(i, j, k - 1) + w(i, j, k))};
}

Vec3 CenteredFlow::vorticity(const FlowState& state, int i, int j, int k) const {
  const auto faces_u = state.u.view();
  const auto faces_v = state.v.view();
  const auto faces_w = state.w.view();
  const auto u = [&](int dj, int dk) { return 0.5 * (faces_u(i - 1, j + dj, k + dk) + faces_u(i, j + dj, k + dk)); };
  const auto v = [&](int di, int dk) { return 0.5 * (faces_v(i + di, j - 1, k + dk) + faces_v(i + di, j, k + dk)); };
  const auto w = [&](int di, int dj) { return 0.5 * (faces_w(i + di, j + dj, k - 1) + faces_w(i + di, j + dj, k)); };
  const auto along = [](auto& slopes, int n) { return slopes[static_cast<std::size_t>(n)]; };
  const double u_y = apply(along(slopes_[0][1], j), u(-1, 0), u(0, 0), u(1, 0));
  const double u_z = apply(along(slopes_[0][2], k), u(0, -1), u(0, 0), u(0, 1));
  const double v_x = apply(along(slopes_[1][0], i), v(-1, 0), v(0, 0), v(1, 0));
  const double v_z = apply(along(slopes_[1][2], k), v(0, -1), v(0, 0), v(0, 1));
  const double w_x = apply(along(slopes_[2][0], i), w(-1, 0), w(0, 0), w(1, 0));
  const double w_y = apply(along(slopes_[2][1], j), w(0, -1), w(0, 0), w(0, 1));
  return {w_y - v_z, u_z - w_x, v_x - u_y};
}

}  // namespace pliant
