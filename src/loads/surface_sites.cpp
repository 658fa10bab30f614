#include "loads/surface_sites.hpp"

#include "mesh/geometry.hpp"

namespace pliant {

void set_sites(const TriangleMesh& mesh, std::span<const Vec3> positions, std::span<const Vec3> velocities,
               std::span<const Vec3> accelerations, SurfaceSites& sites) {
  const auto faces = mesh.vertices_of_face();
  for (auto* vectors : {&sites.positions, &sites.velocities, &sites.accelerations, &sites.normals, &sites.normal_rates})
    vectors->resize(faces.size());
  sites.areas.resize(faces.size());
  sites.stretch_rates.resize(faces.size());

  for (std::size_t f = 0; f < faces.size(); ++f) {
    const Face& face = faces[f];
    const auto edge = [&](std::span<const Vec3> values, int k) {
      return values[static_cast<std::size_t>(face[static_cast<std::size_t>(k)])] -
             values[static_cast<std::size_t>(face[0])];
    };
    const Vec3 vector = face_vector(face, positions);
    const Vec3 rate = cross(edge(velocities, 1), edge(positions, 2)) + cross(edge(positions, 1), edge(velocities, 2));
    const double length = norm(vector);
    const Vec3 normal = vector / length, relative = rate / length;

    sites.positions[f] = face_centroid(face, positions);
    sites.velocities[f] = face_centroid(face, velocities);
    sites.accelerations[f] = face_centroid(face, accelerations);
    sites.normals[f] = normal;
    sites.areas[f] = 0.5 * length;
    sites.stretch_rates[f] = dot(normal, relative);
    sites.normal_rates[f] = relative - sites.stretch_rates[f] * normal;
  }
}

}  // namespace pliant
