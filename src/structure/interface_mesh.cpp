#include "structure/interface_mesh.hpp"

#include <vector>

#include "mesh/geometry.hpp"

namespace pliant {
namespace {

// The integral of (x - centre) V.n over the surface is what moves the centroid. The sum of x N^T makes it
// exact for a translation.
Vec3 centroid_velocity(std::span<const Vec3> gradient, std::span<const Vec3> positions,
                       std::span<const Vec3> velocities) {
  const Vec3 centre = mean_position(positions);
  Vec3 sum;
  double volume = 0;
  for (std::size_t v = 0; v < positions.size(); ++v) {
    const Vec3 arm = positions[v] - centre;
    sum += dot(gradient[v], velocities[v]) * arm;
    volume += dot(gradient[v], arm) / 3;
  }
  return sum / volume;
}

}  // namespace

Vec3 centroid_velocity(const TriangleMesh& mesh, std::span<const Vec3> positions, std::span<const Vec3> velocities) {
  return centroid_velocity(volume_gradient(mesh, positions), positions, velocities);
}

void keep_normal_part(const TriangleMesh& mesh, std::span<const Vec3> positions, std::span<Vec3> velocities) {
  const auto gradient = volume_gradient(mesh, positions);
  const Vec3 common = centroid_velocity(gradient, positions, velocities);
  for (std::size_t v = 0; v < velocities.size(); ++v) {
    const Vec3 n = gradient[v];
    velocities[v] = common + (dot(velocities[v] - common, n) / dot(n, n)) * n;
  }
}

void even_out(const TriangleMesh& mesh, std::span<Vec3> positions, double fraction) {
  std::vector<Vec3> normals(positions.size()), moments(positions.size());
  std::vector<double> weights(positions.size());
  for (const Face& face : mesh.vertices_of_face()) {
    const Vec3 area = face_vector(face, positions), centroid = face_centroid(face, positions);
    const double size = norm(area);
    for (int corner : face) {
      const auto v = static_cast<std::size_t>(corner);
      normals[v] += area;
      moments[v] += size * (centroid - positions[v]);
      weights[v] += size;
    }
  }
  for (std::size_t v = 0; v < positions.size(); ++v) {
    const Vec3 way = moments[v] / weights[v], n = normals[v];
    positions[v] += fraction * (way - (dot(way, n) / dot(n, n)) * n);
  }
}

}  // namespace pliant
