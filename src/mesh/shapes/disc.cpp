#include "mesh/shapes/disc.hpp"

#include <cmath>
#include <numbers>

#include "mesh/shapes/shape_parts.hpp"

namespace pliant {
namespace {
constexpr double pi = std::numbers::pi;

void check(const char* shape, double radius, double edge) {
  ShapeChecks checks(shape);
  checks.positive("radius", radius);
  checks.edge(edge, radius, pi * radius * radius);
  checks.finish();
}
}  // namespace

Surface make_disc(double radius, double edge) {
  check("disc", radius, edge);
  const int n = parts_of(radius, edge);
  ShapeParts parts;
  std::vector<std::vector<int>> rings{{parts.add_vertex({})}};
  for (int k = 1; k <= n; ++k) {
    auto& ring = rings.emplace_back();
    const double r = radius * k / n;
    for (int j = 0; j < 6 * k; ++j) {
      const double angle = pi * j / (3 * k);
      ring.push_back(parts.add_vertex({r * std::cos(angle), r * std::sin(angle), 0}));
    }
    ring.push_back(ring.front());
  }
  add_ring_faces(rings, 6, parts.faces);
  return finish_shape(parts);
}

Surface make_half_disc(double radius, double edge) {
  check("half-disc", radius, edge);
  const int n = parts_of(radius, edge);
  ShapeParts parts;
  std::vector<std::vector<int>> rings{{parts.add_vertex({})}};
  for (int k = 1; k <= n; ++k) {
    auto& ring = rings.emplace_back();
    const double r = radius * k / n;
    ring.push_back(parts.add_vertex({0, -r, 0}));
    for (int j = 1; j < 3 * k; ++j) {
      const double angle = pi * j / (3 * k);  // from the negative y axis
      ring.push_back(parts.add_vertex({r * std::sin(angle), -r * std::cos(angle), 0}));
    }
    ring.push_back(parts.add_vertex({0, r, 0}));
  }
  add_ring_faces(rings, 3, parts.faces);
  return finish_shape(parts);
}

}  // namespace pliant
