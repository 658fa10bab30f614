#include "mesh/shapes/plate.hpp"

#include <algorithm>
#include <cmath>

#include "mesh/shapes/shape_parts.hpp"

namespace pliant {
namespace {
/// Places along a row of n faces, as fractions. The first and last face of a shifted row are widened from a half to
/// 0.6, which lifts the smallest angle from 30 degrees to 35.
std::vector<double> row_fractions(int n, int row) {
  constexpr double end_width = 0.6;
  std::vector<double> fractions;
  if (row % 2 == 0) {
    for (int i = 0; i <= n; ++i) fractions.push_back(static_cast<double>(i) / n);
    return fractions;
  }
  fractions.push_back(0);
  for (int i = 0; i < n; ++i) {
    double at = i + 0.5;
    if (n > 1 && i == 0) at = end_width;
    if (n > 1 && i == n - 1) at = n - end_width;
    fractions.push_back(at / n);
  }
  fractions.push_back(1);
  return fractions;
}
}  // namespace

Surface make_plate(double size_a, double size_b, double edge) {
  ShapeChecks checks("plate");
  checks.positive("size a", size_a);
  checks.positive("size b", size_b);
  checks.edge(edge, std::min(size_a, size_b), size_a * size_b);
  checks.finish();
  const double length = std::max(size_a, size_b), width = std::min(size_a, size_b);
  const double tall = std::sqrt(0.75);  // height of an equilateral face over its side
  const int rows = parts_of(width, tall * edge);
  const double height = width / rows;
  // Faces are never taller than long: the ends of the rows would become too sharp.
  const int n = std::max(1, std::min(parts_of(length, height / tall), static_cast<int>(length / height)));

  ShapeParts parts;
  std::vector<int> lower, upper;
  for (int row = 0; row <= rows; ++row) {
    upper.clear();
    const double v = width * (static_cast<double>(row) / rows) - width / 2;
    for (double fraction : row_fractions(n, row)) {
      const double u = length * fraction - length / 2;
      upper.push_back(parts.add_vertex(size_a >= size_b ? Vec3{u, v, 0} : Vec3{-v, u, 0}));
    }
    // A shifted row has one vertex more: its vertex i + 1 stands over the middle of face i of the other row.
    for (int i = 0; row > 0 && i <= n; ++i) {
      if (row % 2 == 1) {
        parts.faces.push_back({lower[i], upper[i + 1], upper[i]});
        if (i < n) parts.faces.push_back({lower[i], lower[i + 1], upper[i + 1]});
      } else {
        parts.faces.push_back({lower[i], lower[i + 1], upper[i]});
        if (i < n) parts.faces.push_back({lower[i + 1], upper[i + 1], upper[i]});
      }
    }
    lower = upper;
  }
  return finish_shape(parts);
}

}  // namespace pliant
