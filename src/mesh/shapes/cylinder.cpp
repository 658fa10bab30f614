#include "mesh/shapes/cylinder.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "mesh/shapes/shape_parts.hpp"

namespace pliant {
namespace {
constexpr double pi = std::numbers::pi;

/// m vertices of a circle at height z, turned by `shift` steps; the first one is repeated at the end.
std::vector<int> add_circle(ShapeParts& parts, int m, double radius, double z, double shift) {
  std::vector<int> ring;
  for (int j = 0; j < m; ++j) ring.push_back(parts.add_vertex(circle_vertex(radius, m, j + shift, z)));
  ring.push_back(ring.front());
  return ring;
}

/// Fills the rim, which has 6 n vertices turned by `shift` steps, with rings about the axis; normals along +z.
std::vector<Face> fill_rim(ShapeParts& parts, const std::vector<int>& rim, int n, double radius, double z,
                           double shift) {
  std::vector<std::vector<int>> rings{{parts.add_vertex({0, 0, z})}};
  for (int k = 1; k < n; ++k) rings.push_back(add_circle(parts, 6 * k, radius * k / n, z, shift * k / n));
  rings.push_back(rim);
  std::vector<Face> faces;
  add_ring_faces(rings, 6, faces);
  return faces;
}
}  // namespace

Surface make_cylinder(double radius, double height, double edge, Ends ends) {
  ShapeChecks checks("cylinder");
  checks.positive("radius", radius);
  checks.positive("height", height);
  checks.edge(edge, std::min(radius, height), 2 * pi * radius * (height + radius));
  checks.finish();
  // A flat cylinder is cut finer, so that one row of its side has good faces.
  const double tall = std::sqrt(0.75);
  const int n = parts_of(radius, std::min(edge, height / tall)), m = 6 * n;
  const int rows = parts_of(height, tall * 2 * radius * std::sin(pi / m));

  ShapeParts parts;
  std::vector<std::vector<int>> circles;
  for (int row = 0; row <= rows; ++row)
    circles.push_back(
        add_circle(parts, m, radius, height * (static_cast<double>(row) / rows) - height / 2, row % 2 == 0 ? 0 : 0.5));
  if (ends == Ends::capped)
    for (const Face& face : fill_rim(parts, circles.front(), n, radius, -height / 2, 0))
      parts.faces.push_back({face[0], face[2], face[1]});
  for (int row = 0; row < rows; ++row) {
    const auto &a = circles[row], &b = circles[row + 1];
    for (int j = 0; j < m; ++j) {
      if (row % 2 == 0) {
        parts.faces.push_back({a[j], a[j + 1], b[j]});
        parts.faces.push_back({b[j], a[j + 1], b[j + 1]});
      } else {
        parts.faces.push_back({a[j], a[j + 1], b[j + 1]});
        parts.faces.push_back({a[j], b[j + 1], b[j]});
      }
    }
  }
  if (ends == Ends::capped) {
    const auto cap = fill_rim(parts, circles.back(), n, radius, height / 2, rows % 2 == 0 ? 0 : 0.5);
    parts.faces.insert(parts.faces.end(), cap.begin(), cap.end());
  }
  return finish_shape(parts);
}

}  // namespace pliant
