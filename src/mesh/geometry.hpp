#pragma once
#include <span>
#include <vector>

#include "core/mat3.hpp"
#include "core/vec3.hpp"
#include "mesh/triangle_mesh.hpp"

/// Geometry of a triangle mesh at given positions (n_vertices of them). Sums run in the order of the faces.
namespace pliant {

/// (x1 - x0) x (x2 - x0): along the outward normal, its length twice the area.
inline Vec3 face_vector(const Face& face, std::span<const Vec3> positions) {
  const Vec3 origin = positions[face[0]];
  return cross(positions[face[1]] - origin, positions[face[2]] - origin);
}

inline Vec3 face_centroid(const Face& face, std::span<const Vec3> positions) {
  return (positions[face[0]] + positions[face[1]] + positions[face[2]]) / 3.0;
}

std::vector<double> face_areas(const TriangleMesh& mesh, std::span<const Vec3> positions);
/// Unit normals; outward for a closed surface of positive volume.
std::vector<Vec3> face_normals(const TriangleMesh& mesh, std::span<const Vec3> positions);
std::vector<Vec3> face_centroids(const TriangleMesh& mesh, std::span<const Vec3> positions);
/// A third of the area of the faces around each vertex; they add up to the total area.
std::vector<double> vertex_areas(const TriangleMesh& mesh, std::span<const Vec3> positions);
std::vector<double> edge_lengths(const TriangleMesh& mesh, std::span<const Vec3> positions);
/// The three inner angles of each face at its vertices, in radians.
std::vector<std::array<double, 3>> face_angles(const TriangleMesh& mesh, std::span<const Vec3> positions);
/// Angle between the normals of an edge's two faces, positive where the surface is convex, in radians; 0 at a border.
std::vector<double> hinge_angles(const TriangleMesh& mesh, std::span<const Vec3> positions);

double total_area(const TriangleMesh& mesh, std::span<const Vec3> positions);
/// Volume inside a closed surface; negative if its normals point inwards. Without meaning for an open one.
double enclosed_volume(const TriangleMesh& mesh, std::span<const Vec3> positions);

/// Derivative of the enclosed volume by each position: along the vertex's normal. The sum of x_v N_v^T over all
/// vertices is the volume times the unit matrix.
std::vector<Vec3> volume_gradient(const TriangleMesh& mesh, std::span<const Vec3> positions);

/// Moments of the solid inside a closed surface, exact for the polyhedron.
struct SolidMoments {
  double volume = 0;
  Vec3 centroid;
  Mat3 second;  ///< integral of (x - centroid)(x - centroid)^T over the volume

  /// Inertia tensor about the centroid at unit density: trace(second) I - second.
  Mat3 inertia() const;
};
SolidMoments enclosed_moments(const TriangleMesh& mesh, std::span<const Vec3> positions);

/// Mean of the positions.
Vec3 mean_position(std::span<const Vec3> positions);

}  // namespace pliant
