#include "mesh/shapes/ventricle.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "mesh/shapes/patch_mesher.hpp"
#include "mesh/shapes/shape_parts.hpp"

namespace pliant {
namespace {
constexpr double pi = std::numbers::pi;

/// The chart is the unit disc, seen from outside (mirrored in y): the distance from its middle is the eccentric anomaly
/// from the apex over a right angle.
Vec3 on_spheroid(const VentricleSizes& sizes, ChartPoint p) {
  const double rho = std::hypot(p[0], p[1]), anomaly = 0.5 * pi * rho;
  const double stretch = rho > 0 ? std::sin(anomaly) / rho : 0.5 * pi;
  return {sizes.radius * stretch * p[0], -sizes.radius * stretch * p[1], -sizes.height * std::cos(anomaly)};
}
}  // namespace

Surface make_ventricle(const VentricleSizes& sizes) {
  ShapeChecks checks("ventricle");
  checks.positive("radius", sizes.radius);
  checks.positive("height", sizes.height);
  const double apex_edge = sizes.apex_edge > 0 ? sizes.apex_edge : sizes.edge;
  checks.edge(std::min(sizes.edge, apex_edge), std::min(sizes.radius, sizes.height),
              2 * pi * sizes.radius * std::max(sizes.radius, sizes.height));
  checks.finish();
  const double thickness = std::min(sizes.radius, sizes.height), rim_edge = std::min(sizes.edge, thickness);
  const double low_edge = std::min(apex_edge, thickness);

  Patch patch;
  patch.surface = [&](ChartPoint p) { return on_spheroid(sizes, p); };
  patch.edge = [&](Vec3 x) { return rim_edge + (low_edge - rim_edge) * std::clamp(-x.z / sizes.height, 0.0, 1.0); };
  patch.keeps_middle = true;
  const int m = parts_of_circle(sizes.radius, rim_edge);
  for (int j = 0; j < m; ++j) {
    const Vec3 x = circle_vertex(sizes.radius, m, (m - j) % m), unit = circle_vertex(1, m, (m - j) % m);
    patch.outline.push_back({{unit.x, -unit.y}, x});
  }
  PatchMesh mesh = mesh_patch(patch);
  ShapeParts parts{std::move(mesh.positions), std::move(mesh.faces), {{"rim", {}}, {"apex", {m}}}};
  for (int j = 0; j < m; ++j) parts.selections[0].vertices.push_back(j);
  return finish_shape(parts);
}

}  // namespace pliant
