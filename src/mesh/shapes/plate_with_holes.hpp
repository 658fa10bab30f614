#pragma once
#include <array>
#include <vector>

#include "mesh/surface.hpp"

namespace pliant {

struct RoundHole {
  double x = 0, y = 0, radius = 0.5;
};
struct PlateWithHolesSizes {
  std::array<double, 2> size{1, 1};  ///< along x and y
  std::vector<RoundHole> holes;
  double edge = 0.1;
  double hole_edge = 0;  ///< of the edges at the holes, which grow with the distance from them; 0: as everywhere
};

/// Open rectangle in the x-y plane about the origin with round holes, normals along +z. Opposite sides have the same
/// vertices, evenly spaced, so that it spans a periodic box without a gap; a hole has six times radius / hole edge
/// vertices. Selections: "border", the rectangle's; "holes", all of them; "hole-1", "hole-2", ... each.
/// Throws InputError for sizes that make no such mesh.
Surface make_plate_with_holes(const PlateWithHolesSizes& sizes);

}  // namespace pliant
