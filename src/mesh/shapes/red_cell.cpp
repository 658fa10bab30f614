#include "mesh/shapes/red_cell.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <vector>

#include "mesh/shapes/icosphere.hpp"
#include "mesh/shapes/shape_parts.hpp"

namespace pliant {
namespace {

/// Half of a meridian of the cell of radius 1, from the upper pole (parameter 0) to the rim (pi / 2): r = sin t.
struct Meridian {
  static double height(double t) {
    const double q2 = std::sin(t) * std::sin(t);
    return 0.5 * std::cos(t) * (0.207 + q2 * (2.003 - 1.123 * q2));
  }

  Meridian() {
    constexpr int n = 20000;
    lengths.push_back(0);
    for (int i = 1; i <= n; ++i) {
      const double before = end * (i - 1) / n, after = end * i / n;
      lengths.push_back(lengths.back() +
                        std::hypot(std::sin(after) - std::sin(before), height(after) - height(before)));
    }
  }

  /// The parameter where `part` of the length, 0 to 1, is behind.
  double at(double part) const {
    const double wanted = part * lengths.back();
    const auto above =
        std::clamp<std::ptrdiff_t>(std::lower_bound(lengths.begin(), lengths.end(), wanted) - lengths.begin(), 1,
                                   static_cast<std::ptrdiff_t>(lengths.size()) - 1);
    const auto i = static_cast<std::size_t>(above);
    const double within = (wanted - lengths[i - 1]) / (lengths[i] - lengths[i - 1]);
    return end * (static_cast<double>(i - 1) + within) / static_cast<double>(lengths.size() - 1);
  }

  static constexpr double end = 0.5 * std::numbers::pi;
  std::vector<double> lengths;
};

}  // namespace

Surface make_red_cell(int frequency, double radius) {
  ShapeChecks checks("red cell");
  checks.positive("radius", radius);
  checks.finish();
  Surface surface = make_icosphere(frequency, 1.0);
  const Meridian meridian;
  for (Vec3& x : surface.positions) {
    const double from_axis = std::hypot(x.x, x.y);
    const double t = meridian.at(std::atan2(from_axis, std::abs(x.z)) / Meridian::end);
    const double stretch = from_axis > 0 ? std::sin(t) / from_axis : 0;
    x = radius * Vec3{stretch * x.x, stretch * x.y, std::copysign(Meridian::height(t), x.z)};
  }
  return surface;
}

}  // namespace pliant
