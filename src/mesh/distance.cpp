#include "mesh/distance.hpp"

#include <cmath>
#include <numbers>

namespace pliant {

std::array<double, 3> nearest_weights(Vec3 x, const Triangle& triangle) {
  const auto [a, b, c] = triangle;
  const Vec3 ab = b - a, ac = c - a, ax = x - a, bx = x - b, cx = x - c;
  const double d1 = dot(ab, ax), d2 = dot(ac, ax), d3 = dot(ab, bx), d4 = dot(ac, bx), d5 = dot(ab, cx),
               d6 = dot(ac, cx);
  if (d1 <= 0 && d2 <= 0) return {1, 0, 0};
  if (d3 >= 0 && d4 <= d3) return {0, 1, 0};
  if (d6 >= 0 && d5 <= d6) return {0, 0, 1};
  // Areas of the triangles that x, seen along the normal, makes with the sides.
  const double vc = d1 * d4 - d3 * d2, vb = d5 * d2 - d1 * d6, va = d3 * d6 - d5 * d4;
  if (vc <= 0 && d1 >= 0 && d3 <= 0) return {1 - d1 / (d1 - d3), d1 / (d1 - d3), 0};
  if (vb <= 0 && d2 >= 0 && d6 <= 0) return {1 - d2 / (d2 - d6), 0, d2 / (d2 - d6)};
  if (va <= 0 && d4 >= d3 && d5 >= d6) {
    const double t = (d4 - d3) / ((d4 - d3) + (d5 - d6));
    return {0, 1 - t, t};
  }
  const double sum = va + vb + vc;
  return {1 - (vb + vc) / sum, vb / sum, vc / sum};
}

Vec3 nearest_point(Vec3 x, const Triangle& triangle) {
  const auto weights = nearest_weights(x, triangle);
  return triangle[0] + weights[1] * (triangle[1] - triangle[0]) + weights[2] * (triangle[2] - triangle[0]);
}

std::array<double, 2> nearest_along(Vec3 from_a, Vec3 to_a, Vec3 from_b, Vec3 to_b) {
  const Vec3 a = to_a - from_a, b = to_b - from_b, r = from_a - from_b;
  const double aa = dot(a, a), bb = dot(b, b), ab = dot(a, b), ar = dot(a, r), br = dot(b, r);
  const auto clamped = [](double t) { return t < 0 ? 0.0 : t > 1 ? 1.0 : t; };
  if (!(aa > 0)) return {0, bb > 0 ? clamped(br / bb) : 0.0};
  if (!(bb > 0)) return {clamped(-ar / aa), 0};
  const double det = aa * bb - ab * ab;
  double s = det > 1e-14 * aa * bb ? clamped((ab * br - ar * bb) / det) : 0.0;
  double t = (ab * s + br) / bb;
  if (t < 0) t = 0, s = clamped(-ar / aa);
  else if (t > 1) t = 1, s = clamped((ab - ar) / aa);
  return {s, t};
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
