#pragma once
#include <array>
#include <span>
#include <vector>

#include "grid/grid.hpp"
#include "mesh/triangle_mesh.hpp"

namespace pliant {

/// Two cells that are neighbours along an axis, with a face of a surface between their centres.
struct WallLink {
  int axis = 0;
  std::array<int, 3> node{};  ///< of the velocity between them, by global index: the face of cells n and n + 1
  int sign = 1;               ///< of the face's normal along the axis
  Vec3 place;                 ///< where the line between the centres passes the face
};

/// All of them. What is between them is a surface made of faces of cells: if faces close a surface their links, with
/// their signs, are the gradient of the cells inside, exactly. Along bounded directions, without what lies on a side.
std::vector<WallLink> find_wall_links(const Grid& grid, std::span<const Face> faces, std::span<const Vec3> positions);

}  // namespace pliant
