#include "app/maffettone_minale.hpp"

#include <fmt/format.h>

#include <cmath>
#include <numbers>

#include "core/angles.hpp"
#include "core/error.hpp"

namespace pliant {
namespace {
constexpr double largest_capillary = 2.0;
}

DropShape maffettone_minale(double capillary, double viscosity_ratio) {
  const double l = viscosity_ratio;
  const double f1 = 40 * (l + 1) / ((2 * l + 3) * (19 * l + 16));
  const double f2 = 5 / (2 * l + 3);
  // S has the eigenvalues L^2, B^2, W^2; with s = f1^2 + Ca^2 and t = s - (f2 Ca)^2 they are
  // (s +- f2 Ca sqrt(s)) / (s^(1/3) t^(2/3)) and t / (s^(1/3) t^(2/3)).
  const double s = f1 * f1 + capillary * capillary;
  const double t = s - f2 * f2 * capillary * capillary;
  const double scale = std::cbrt(s * t * t);
  const double spread = f2 * capillary * std::sqrt(s);
  DropShape shape;
  shape.major = std::sqrt((s + spread) / scale);
  shape.minor = std::sqrt((s - spread) / scale);
  shape.vortical = std::sqrt(t / scale);
  shape.angle = 0.5 * std::atan2(f1, capillary) / degree;
  return shape;
}

CapillaryFit fit_capillary(double major, double minor, double viscosity_ratio) {
  const auto square_error = [&](double capillary) {
    const auto shape = maffettone_minale(capillary, viscosity_ratio);
    return std::pow(shape.major - major, 2) + std::pow(shape.minor - minor, 2);
  };
  // L grows and B falls with Ca, so the error has one minimum: golden section.
  constexpr double ratio = 1 / std::numbers::phi;
  double low = 0, high = largest_capillary;
  while (high - low > 1e-12) {
    const double span = high - low;
    const double left = high - ratio * span, right = low + ratio * span;
    if (square_error(left) < square_error(right)) high = right;
    else low = left;
  }
  const double capillary = 0.5 * (low + high);
  if (capillary > 0.999 * largest_capillary)
    throw RunError(
        fmt::format("the drop (L = {:.4g}, B = {:.4g}) is longer than the Maffettone-Minale model at "
                    "Ca = {}; stiffen it or lower the shear rate",
                    major, minor, largest_capillary));
  return {capillary, std::sqrt(0.5 * square_error(capillary))};
}

}  // namespace pliant
