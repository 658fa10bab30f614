#include "mesh/geometry.hpp"

#include <cmath>

namespace pliant {

std::vector<double> face_areas(const TriangleMesh& mesh, std::span<const Vec3> positions) {
  std::vector<double> areas;
  areas.reserve(mesh.n_faces());
  for (const Face& face : mesh.vertices_of_face()) areas.push_back(0.5 * norm(face_vector(face, positions)));
  return areas;
}

std::vector<Vec3> face_normals(const TriangleMesh& mesh, std::span<const Vec3> positions) {
  std::vector<Vec3> normals;
  normals.reserve(mesh.n_faces());
  for (const Face& face : mesh.vertices_of_face()) normals.push_back(normalized(face_vector(face, positions)));
  return normals;
}

std::vector<Vec3> face_centroids(const TriangleMesh& mesh, std::span<const Vec3> positions) {
  std::vector<Vec3> centroids;
  centroids.reserve(mesh.n_faces());
  for (const Face& face : mesh.vertices_of_face()) centroids.push_back(face_centroid(face, positions));
  return centroids;
}

std::vector<double> vertex_areas(const TriangleMesh& mesh, std::span<const Vec3> positions) {
  std::vector<double> areas(mesh.n_vertices(), 0.0);
  for (const Face& face : mesh.vertices_of_face()) {
    const double third = norm(face_vector(face, positions)) / 6.0;
    for (int v : face) areas[v] += third;
  }
  return areas;
}

std::vector<double> edge_lengths(const TriangleMesh& mesh, std::span<const Vec3> positions) {
  std::vector<double> lengths;
  lengths.reserve(mesh.n_edges());
  for (const auto& [a, b] : mesh.vertices_of_edge()) lengths.push_back(norm(positions[b] - positions[a]));
  return lengths;
}

std::vector<std::array<double, 3>> face_angles(const TriangleMesh& mesh, std::span<const Vec3> positions) {
  std::vector<std::array<double, 3>> angles;
  angles.reserve(mesh.n_faces());
  for (const Face& face : mesh.vertices_of_face()) {
    auto& corner = angles.emplace_back();
    for (int k = 0; k < 3; ++k) {
      const Vec3 a = positions[face[(k + 1) % 3]] - positions[face[k]];
      const Vec3 b = positions[face[(k + 2) % 3]] - positions[face[k]];
      corner[k] = std::atan2(norm(cross(a, b)), dot(a, b));
    }
  }
  return angles;
}

std::vector<double> hinge_angles(const TriangleMesh& mesh, std::span<const Vec3> positions) {
  std::vector<double> angles;
  angles.reserve(mesh.n_edges());
  for (const auto& [a, b, c, d] : mesh.hinge_of_edge()) {
    if (d < 0) {
      angles.push_back(0);
      continue;
    }
    const Vec3 axis = positions[b] - positions[a];
    const Vec3 first = cross(axis, positions[c] - positions[a]);
    const Vec3 second = cross(positions[d] - positions[a], axis);
    angles.push_back(std::atan2(dot(cross(first, second), axis) / norm(axis), dot(first, second)));
  }
  return angles;
}

double total_area(const TriangleMesh& mesh, std::span<const Vec3> positions) {
  double twice = 0;
  for (const Face& face : mesh.vertices_of_face()) twice += norm(face_vector(face, positions));
  return 0.5 * twice;
}

double enclosed_volume(const TriangleMesh& mesh, std::span<const Vec3> positions) {
  if (positions.empty()) return 0;
  // From a point of the surface, not the origin: a body far away would lose digits.
  const Vec3 apex = positions[0];
  double six_volumes = 0;
  for (const Face& face : mesh.vertices_of_face())
    six_volumes += dot(positions[face[0]] - apex, face_vector(face, positions));
  return six_volumes / 6.0;
}

std::vector<Vec3> volume_gradient(const TriangleMesh& mesh, std::span<const Vec3> positions) {
  std::vector<Vec3> gradient(positions.size());
  for (const Face& face : mesh.vertices_of_face()) {
    const Vec3 third = face_vector(face, positions) / 6.0;
    for (int v : face) gradient[static_cast<std::size_t>(v)] += third;
  }
  return gradient;
}

Mat3 SolidMoments::inertia() const {
  const double trace = second[0].x + second[1].y + second[2].z;
  Mat3 result;
  for (int i = 0; i < 3; ++i)
    for (int j = 0; j < 3; ++j) result[i][j] = (i == j ? trace : 0.0) - second[i][j];
  return result;
}

SolidMoments enclosed_moments(const TriangleMesh& mesh, std::span<const Vec3> positions) {
  SolidMoments moments;
  if (positions.empty()) return moments;
  const Vec3 apex = positions[0];
  Vec3 first;
  Mat3 second;
  for (const Face& face : mesh.vertices_of_face()) {
    const Vec3 a = positions[face[0]] - apex, b = positions[face[1]] - apex, c = positions[face[2]] - apex;
    const double volume = dot(a, cross(b, c)) / 6.0;
    const Vec3 sum = a + b + c;
    moments.volume += volume;
    first += volume / 4.0 * sum;
    // Tetrahedron with a corner at 0: integral of x_i x_j = V/20 (a_i a_j + b_i b_j + c_i c_j + s_i s_j), s = a + b +
    // c.
    for (int i = 0; i < 3; ++i)
      for (int j = 0; j < 3; ++j)
        second[i][j] += volume / 20.0 * (a[i] * a[j] + b[i] * b[j] + c[i] * c[j] + sum[i] * sum[j]);
  }
  const Vec3 centre = first / moments.volume;
  for (int i = 0; i < 3; ++i)
    for (int j = 0; j < 3; ++j) moments.second[i][j] = second[i][j] - moments.volume * centre[i] * centre[j];
  moments.centroid = apex + centre;
  return moments;
}

Vec3 mean_position(std::span<const Vec3> positions) {
  Vec3 sum;
  for (const Vec3& x : positions) sum += x;
  return positions.empty() ? sum : sum / static_cast<double>(positions.size());
}

}  // namespace pliant
