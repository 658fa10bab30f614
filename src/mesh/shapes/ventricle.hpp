#pragma once
#include "mesh/surface.hpp"

namespace pliant {

struct VentricleSizes {
  double radius = 1, height = 2, edge = 0.1;
  double apex_edge = 0;  ///< edges at the apex; 0: as everywhere. In between they change with the height.
};

/// The lower half of a spheroid about the z axis, a sack that is open at its rim: the circle of `radius` in the plane
/// z = 0, with its apex at z = -height; normals outward. The rim has six times radius / edge vertices, evenly spaced
/// from the x axis on. Selections: "rim"; "apex", one vertex.
/// Throws InputError for sizes that make no such mesh.
Surface make_ventricle(const VentricleSizes& sizes);

}  // namespace pliant
