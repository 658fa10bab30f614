#include "mesh/distance.hpp"

#include <cmath>
#include <numbers>

namespace pliant {

Vec3 nearest_point(Vec3 x, const Triangle& triangle) {
  const auto [a, b, c] = triangle;
  const Vec3 ab = b - a, ac = c - a, ax = x - a, bx = x - b, cx = x - c;
  const double d1 = dot(ab, ax), d2 = dot(ac, ax), d3 = dot(ab, bx), d4 = dot(ac, bx), d5 = dot(ab, cx),
               d6 = dot(ac, cx);
  if (d1 <= 0 && d2 <= 0) return a;
  if (d3 >= 0 && d4 <= d3) return b;
  if (d6 >= 0 && d5 <= d6) return c;
  // Areas of the triangles that x, seen along the normal, makes with the sides.
  const double vc = d1 * d4 - d3 * d2, vb = d5 * d2 - d1 * d6, va = d3 * d6 - d5 * d4;
  if (vc <= 0 && d1 >= 0 && d3 <= 0) return a + d1 / (d1 - d3) * ab;
  if (vb <= 0 && d2 >= 0 && d6 <= 0) return a + d2 / (d2 - d6) * ac;
  if (va <= 0 && d4 >= d3 && d5 >= d6) return b + (d4 - d3) / ((d4 - d3) + (d5 - d6)) * (c - b);
  const double sum = va + vb + vc;
  return a + vb / sum * ab + vc / sum * ac;
}

double winding_number(Vec3 x, const TriangleMesh& mesh, std::span<const Vec3> positions) {
  double halves = 0;
  for (const Face& face : mesh.vertices_of_face()) {
    const Vec3 a = positions[face[0]] - x, b = positions[face[1]] - x, c = positions[face[2]] - x;
    const double la = norm(a), lb = norm(b), lc = norm(c);
    halves += std::atan2(dot(a, cross(b, c)), la * lb * lc + dot(a, b) * lc + dot(b, c) * la + dot(c, a) * lb);
  }
  return halves / (2 * std::numbers::pi);
}

}  // namespace pliant
