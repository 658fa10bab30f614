#include "structure/mass_properties.hpp"

#include <fmt/format.h>

#include "core/error.hpp"
#include "mesh/geometry.hpp"

namespace pliant {
namespace {

/// trace(second) I - second.
Mat3 inertia_of(const Mat3& second) {
  const double trace = second[0].x + second[1].y + second[2].z;
  Mat3 inertia;
  for (int i = 0; i < 3; ++i)
    for (int j = 0; j < 3; ++j) inertia[i][j] = (i == j ? trace : 0.0) - second[i][j];
  return inertia;
}

void require_positive(std::vector<std::string>& problems, double value, const char* what) {
  if (!(value > 0)) problems.push_back(fmt::format("The {} of a moving body is {}; it must be positive.", what, value));
}

}  // namespace

MassProperties solid_mass_properties(const TriangleMesh& mesh, std::span<const Vec3> positions, double density) {
  std::vector<std::string> problems;
  require_positive(problems, density, "density");
  if (!mesh.is_closed())
    problems.emplace_back("The surface of a solid body is open; close it, or give a thickness to make it a shell.");
  else if (!(enclosed_volume(mesh, positions) > 0))
    problems.emplace_back(
        "The surface of a solid body encloses no volume; turn its faces so that their normals point "
        "outwards.");
  if (!problems.empty()) throw InputError(std::move(problems));

  const SolidMoments moments = enclosed_moments(mesh, positions);
  MassProperties body{density * moments.volume, moments.centroid, moments.inertia(), moments.volume};
  for (Vec3& row : body.inertia.rows) row *= density;
  return body;
}

MassProperties shell_mass_properties(const TriangleMesh& mesh, std::span<const Vec3> positions, double density,
                                     double thickness) {
  const double area = total_area(mesh, positions);
  std::vector<std::string> problems;
  require_positive(problems, density, "density");
  require_positive(problems, thickness, "thickness");
  require_positive(problems, area, "area");
  if (!problems.empty()) throw InputError(std::move(problems));

  Vec3 first;
  for (const Face& face : mesh.vertices_of_face())
    first += 0.5 * norm(face_vector(face, positions)) * (face_centroid(face, positions) - positions[0]);
  MassProperties body;
  body.volume = area * thickness;
  body.mass = density * body.volume;
  body.centroid = positions[0] + first / area;

  Mat3 second;
  for (const Face& face : mesh.vertices_of_face()) {
    const Vec3 a = positions[face[0]] - body.centroid, b = positions[face[1]] - body.centroid,
               c = positions[face[2]] - body.centroid, sum = a + b + c;
    const double mass = 0.5 * norm(face_vector(face, positions)) * thickness * density;
    // Triangle: integral of x_i x_j = A/12 (a_i a_j + b_i b_j + c_i c_j + s_i s_j), s = a + b + c.
    for (int i = 0; i < 3; ++i)
      for (int j = 0; j < 3; ++j)
        second[i][j] += mass / 12.0 * (a[i] * a[j] + b[i] * b[j] + c[i] * c[j] + sum[i] * sum[j]);
  }
  body.inertia = inertia_of(second);
  return body;
}

double inertia_about(const MassProperties& body, Vec3 point, Vec3 axis) {
  const Vec3 n = normalized(axis);
  const Vec3 lever = cross(n, body.centroid - point);
  return dot(n, body.inertia * n) + body.mass * dot(lever, lever);
}

}  // namespace pliant
