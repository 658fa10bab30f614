#pragma once
#include <span>
#include <vector>

#include "core/vec3.hpp"
#include "mesh/triangle_mesh.hpp"

namespace pliant {

/// The state of a surface where its loads are evaluated: one entry a face, at the centroid.
struct SurfaceSites {
  std::vector<Vec3> positions, velocities, accelerations;
  std::vector<Vec3> normals;       ///< of unit length; outward for a closed surface
  std::vector<Vec3> normal_rates;  ///< d normal / dt; omega x n for a rigid body
  std::vector<double> areas;
  std::vector<double> stretch_rates;  ///< (dA/dt)/A, the surface divergence of the velocity; 0 for a rigid body

  std::size_t size() const { return positions.size(); }
};

/// Sets the sites from positions, velocities and accelerations of the vertices (n_vertices each): what is linear on a
/// face is exact.
void set_sites(const TriangleMesh& mesh, std::span<const Vec3> positions, std::span<const Vec3> velocities,
               std::span<const Vec3> accelerations, SurfaceSites& sites);

}  // namespace pliant
