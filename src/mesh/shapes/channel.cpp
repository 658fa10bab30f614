#include "mesh/shapes/channel.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "mesh/shapes/shape_parts.hpp"

namespace pliant {

Surface make_channel(double radius, double height, double edge) {
  constexpr double pi = std::numbers::pi;
  ShapeChecks checks("channel");
  checks.positive("radius", radius);
  checks.positive("height", height);
  checks.edge(edge, std::min(radius, height), 2 * pi * radius * height);
  checks.finish();
  const int m = parts_of_circle(radius, std::min(edge, radius));
  // Every second row is turned by half a step; an even number of rows lets the rims agree.
  const int rows = 2 * parts_of(height, 2 * std::sqrt(0.75) * 2 * radius * std::sin(pi / m));

  ShapeParts parts;
  for (int row = 0; row <= rows; ++row)
    for (int j = 0; j < m; ++j)
      parts.add_vertex(
          circle_vertex(radius, m, row % 2 == 0 ? j : j + 0.5, height * (static_cast<double>(row) / rows)));
  for (int row = 0; row < rows; ++row)
    for (int j = 0; j < m; ++j) {
      const int a = row * m + j, a_next = row * m + (j + 1) % m, b = a + m, b_next = a_next + m;
      if (row % 2 == 0) {
        parts.faces.push_back({a, a_next, b});
        parts.faces.push_back({b, a_next, b_next});
      } else {
        parts.faces.push_back({a, a_next, b_next});
        parts.faces.push_back({a, b_next, b});
      }
    }
  parts.selections = {{"lower-rim", {}}, {"upper-rim", {}}};
  for (int j = 0; j < m; ++j) {
    parts.selections[0].vertices.push_back(j);
    parts.selections[1].vertices.push_back(rows * m + j);
  }
  return finish_shape(parts);
}

}  // namespace pliant
