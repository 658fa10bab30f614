#pragma once
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "config/case_config.hpp"
#include "mesh/triangle_mesh.hpp"
#include "potentials/potential_set.hpp"

namespace pliant {

/// A body whose vertices move by Newton's law under potentials and loads; the same on every rank.
/// Arrays hold one entry a vertex. A fixed body is one that is never advanced.
struct DeformableBody {
  std::string name;
  MotionKind motion = MotionKind::deformable;
  TriangleMesh mesh;
  std::vector<Vec3> positions, velocities;
  std::vector<Vec3> forces;     ///< internal and external at the last substep, drag and damping left out
  std::vector<Vec3> reference;  ///< positions at the start, which the potentials refer to
  std::vector<double> masses;
  std::vector<std::uint8_t> pinned;             ///< 1: does not move; empty: all move
  std::vector<double> reference_areas;  ///< a third of the area of the faces around the vertex, at the start
  double radius = 0;                    ///< of the sphere of the same volume at the start
  PotentialSet potentials;
  double damping = 0;            ///< force = -damping * velocity, on every vertex
  TractionConfig traction;       ///< probe_length filled in
  std::optional<int> substeps;   ///< as given; else from the stability limit
  double largest_frequency = 0;  ///< of the internal forces at the start, radians / time; see find_largest_frequency
};

inline bool is_pinned(const DeformableBody& body, std::size_t vertex) {
  return !body.pinned.empty() && body.pinned[vertex] != 0;
}

}  // namespace pliant
