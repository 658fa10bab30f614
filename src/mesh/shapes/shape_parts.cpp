#include "mesh/shapes/shape_parts.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numbers>

#include "core/error.hpp"

namespace pliant {

void add_ring_faces(const std::vector<std::vector<int>>& rings, int sectors, std::vector<Face>& faces) {
  const int n = static_cast<int>(rings.size()) - 1;
  for (int k = 1; k <= n; ++k)
    for (int sector = 0; sector < sectors; ++sector)
      for (int part = 0; part < k; ++part) {
        const int outer = sector * k + part, inner = sector * (k - 1) + part;
        faces.push_back({rings[k][outer], rings[k][outer + 1], rings[k - 1][k == 1 ? 0 : inner]});
        if (part < k - 1) faces.push_back({rings[k - 1][inner], rings[k][outer + 1], rings[k - 1][inner + 1]});
      }
}

Surface finish_shape(const ShapeParts& parts) {
  std::vector<Vec3> positions;
  std::vector<Face> faces = parts.faces;
  std::vector<int> number(parts.positions.size(), -1);
  for (Face& face : faces)
    for (int& v : face) {
      if (number[v] < 0) {
        number[v] = static_cast<int>(positions.size());
        positions.push_back(parts.positions[v]);
      }
      v = number[v];
    }
  const int n_vertices = static_cast<int>(positions.size());
  auto selections = parts.selections;
  for (auto& selection : selections) {
    for (int& v : selection.vertices) v = number[v];
    std::sort(selection.vertices.begin(), selection.vertices.end());
  }
  return {TriangleMesh(n_vertices, std::move(faces)), std::move(positions), std::move(selections)};
}

Vec3 circle_vertex(double radius, int m, double j, double z) {
  const double angle = 2 * std::numbers::pi * j / m;
  return {radius * std::cos(angle), radius * std::sin(angle), z};
}

int parts_of_circle(double radius, double edge) { return 6 * parts_of(radius, edge); }

int parts_of(double length, double edge) { return std::max(1, static_cast<int>(std::lround(length / edge))); }

void ShapeChecks::positive(const char* name, double value) {
  if (!(value > 0) || !std::isfinite(value))
    problems_.push_back(fmt::format("{}: {} = {} must be a positive number", shape_, name, value));
}

void ShapeChecks::edge(double given, double thickness, double area) {
  constexpr double most_faces = 1e7;
  positive("edge", given);
  const double value = std::min(given, thickness);
  const double faces = area / (std::sqrt(0.1875) * value * value);
  if (problems_.empty() && !(faces <= most_faces))
    problems_.push_back(fmt::format(
        "{}: edge = {} makes about {:.2g} faces, more than {:.0e}; give a longer edge{}", shape_, given, faces,
        most_faces, thickness < given ? " or a thicker shape: faces are no longer than it is thick" : ""));
}

void ShapeChecks::finish() const {
  if (!problems_.empty()) throw InputError(problems_);
}

}  // namespace pliant
