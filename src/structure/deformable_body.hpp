#pragma once
#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "config/case_config.hpp"
#include "mesh/triangle_mesh.hpp"
#include "potentials/potential_set.hpp"
#include "structure/attachments.hpp"
#include "structure/quaternion.hpp"

namespace pliant {

/// Vertices that the body's table follows.
struct Watch {
  std::string name;
  std::vector<int> vertices;

  /// Of the positions or the velocities.
  Vec3 mean_of(std::span<const Vec3> of_vertices) const {
    Vec3 sum;
    for (int v : vertices) sum += of_vertices[static_cast<std::size_t>(v)];
    return sum / static_cast<double>(vertices.size());
  }
};

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
  std::vector<double> reference_areas;  ///< a third of the area of the faces around the vertex, at the start
  double radius = 0;                    ///< of the sphere of the same volume at the start
  PotentialSet potentials;
  std::vector<std::uint8_t> pinned;  ///< 1: the vertex stays where it is; empty: none does
  std::vector<Watch> watches;
  Attachments attachments;  ///< tethers, cords and pulls, in the coordinates of the surface
  Vec3 origin;              ///< where the origin of these coordinates is, and how they are turned
  Quaternion orientation;
  bool is_interface = false;        ///< of two liquids: its vertices are no material (interface_mesh.hpp)
  double damping = 0;               ///< force = -damping * velocity, on every vertex
  double inner_damping = 0;         ///< force along an edge = -inner_damping * rate of its length
  TractionConfig traction;          ///< probe_length filled in
  std::optional<int> substeps;      ///< as given; else from the stability limit
  double largest_frequency = 0;     ///< of the internal forces at the start, radians / time; infinite without a mass
  double largest_damping_rate = 0;  ///< of inner damping and tethers, 1 / time; infinite without a mass

  bool is_pinned(std::size_t v) const { return !pinned.empty() && pinned[v] != 0; }
};

}  // namespace pliant
