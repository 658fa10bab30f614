#include "mesh/shapes/ventricle.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "mesh/shapes/patch_mesher.hpp"
#include "mesh/shapes/shape_parts.hpp"

namespace pliant {
namespace {
constexpr double pi = std::numbers::pi;

/// Half a spheroid over the unit disc, seen from outside (mirrored in y), by the map that keeps angles: however long
/// the sack is, what is a good face in the disc is one on it. With k = height / radius, m = k^2 - 1 and u = -z / height
/// the distance from the disc's middle is exp(-F), F = atanh(w) + sqrt(m) asin(sqrt(m) u / k), w = u / sqrt(k^2 - m
/// u^2) (integrate ds / r along a meridian; the isometric latitude of geodesy, here of prolate spheroids as well).
class SpheroidChart {
 public:
  explicit SpheroidChart(const VentricleSizes& sizes)
      : radius_(sizes.radius), height_(sizes.height), k_(height_ / radius_), m_(k_ * k_ - 1), bound_(bounded_part(1)) {}

  Vec3 operator()(ChartPoint p) const {
    const double rho = std::hypot(p[0], p[1]);
    // t = atanh(w): by Newton from the side of the root from which the steps never pass it.
    const double wanted = -std::log(std::max(rho, 1e-300));
    double t = m_ >= 0 ? std::max(0.0, wanted - bound_) : wanted - bound_;
    for (int i = 0; i < 100; ++i) {
      const double w = std::tanh(t), scale = 1 + m_ * w * w, u = k_ * w / std::sqrt(scale);
      const double slope = 1 + m_ / std::sqrt(k_ * k_ - m_ * u * u) * k_ / (scale * std::sqrt(scale)) * (1 - w * w);
      const double step = (wanted - t - bounded_part(u)) / slope;
      t += step;
      if (std::abs(step) < 1e-14 * (1 + std::abs(t))) break;
    }
    const double w = std::tanh(t), scale = std::sqrt(1 + m_ * w * w), u = k_ * w / scale;
    // The radius over rho: sech(t) exp(F), which is smooth at the apex.
    const double stretch = radius_ * 2 * std::exp(bounded_part(u)) / ((1 + std::exp(-2 * t)) * scale);
    return {stretch * p[0], -stretch * p[1], -height_ * u};
  }

 private:
  double bounded_part(double u) const {
    const double root = std::sqrt(std::abs(m_)), x = root * u / k_;
    return m_ >= 0 ? root * std::asin(std::min(x, 1.0)) : -root * std::asinh(x);
  }
  double radius_, height_, k_, m_, bound_;
};
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
  patch.surface = SpheroidChart(sizes);
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
