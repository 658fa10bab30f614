#pragma once
#include <array>

#include "field/field.hpp"
#include "transfer/mls_shape.hpp"

namespace pliant {

/// The 3 x 3 x 3 nodes of a location that are nearest to a point, the same as those of MlsShape.
struct NodeSupport {
  int first[3] = {};              ///< the lowest node; local plane in z
  double offsets[3][3] = {};      ///< [direction][node]: node minus point
  std::array<double, 3> reach{};  ///< width of the Gaussian weights

  /// Is the middle plane this rank's?
  bool is_held(const Grid& grid) const { return first[2] + 1 >= 0 && first[2] + 1 < grid.nz(); }
};

/// `staggered`: the direction along which the nodes are faces, or 3 for centres. The point must be in the box.
NodeSupport find_support(const Grid& grid, Vec3 point, int staggered);

}  // namespace pliant
