#pragma once
#include "convergence/flow_fixture.hpp"

namespace pliant::test {

struct SlabDifference {
  double largest = 0;
  double scale = 0;  ///< the largest velocity: a flow at rest proves nothing
};

/// A flow on all ranks against the same on one: each rank has computed the whole box by itself as well (`own`) and
/// compares its slab. Collective.
inline SlabDifference against_one_rank(const FlowSolver& shared, const FlowSolver& own) {
  const Grid& grid = shared.grid();
  const int begin = grid.slab().begin;
  double difference = 0, scale = 0;
  const auto u = own.state().u.view();
  const auto v = own.state().v.view();
  const auto w = own.state().w.view();
  for_each_velocity(shared, [&](int c, int i, int j, int k, double value) {
    const double alone = c == 0 ? u(i, j, begin + k) : c == 1 ? v(i, j, begin + k) : w(i, j, begin + k);
    difference = std::max(difference, std::abs(value - alone));
    scale = std::max(scale, std::abs(alone));
  });
  return {grid.ranks().max(difference), grid.ranks().max(scale)};
}

}  // namespace pliant::test
