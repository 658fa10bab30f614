#pragma once
#include "mesh/surface.hpp"

namespace pliant {

/// A box of twelve faces with its lower corner at `corner`.
inline Surface make_box_at(Vec3 corner, Vec3 sides) {
  std::vector<Vec3> positions;
  for (int i = 0; i < 8; ++i)
    positions.push_back(corner + Vec3{i & 1 ? sides.x : 0, i & 2 ? sides.y : 0, i & 4 ? sides.z : 0});
  return {TriangleMesh(8, {{0, 2, 3},
                           {0, 3, 1},
                           {4, 5, 7},
                           {4, 7, 6},
                           {0, 1, 5},
                           {0, 5, 4},
                           {2, 6, 7},
                           {2, 7, 3},
                           {0, 4, 6},
                           {0, 6, 2},
                           {1, 3, 7},
                           {1, 7, 5}}),
          std::move(positions)};
}

}  // namespace pliant
