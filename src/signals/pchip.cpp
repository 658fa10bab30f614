#include "signals/pchip.hpp"

#include <algorithm>
#include <cmath>

namespace pliant {
namespace {
/// Slope at a point between two intervals of the lengths h and the difference quotients d: a weighted harmonic mean.
double inner_slope(double h_left, double h_right, double d_left, double d_right) {
  if (d_left * d_right <= 0) return 0;
  const double w_left = 2 * h_right + h_left, w_right = h_right + 2 * h_left;
  return (w_left + w_right) / (w_left / d_left + w_right / d_right);
}

/// Slope at an end, next to the intervals 0 and 1: the parabola through three points, held to what is monotone.
double end_slope(double h0, double h1, double d0, double d1) {
  const double slope = ((2 * h0 + h1) * d0 - h0 * d1) / (h0 + h1);
  if (slope * d0 <= 0) return 0;
  if (d0 * d1 <= 0 && std::abs(slope) > 3 * std::abs(d0)) return 3 * d0;
  return slope;
}
}  // namespace

double wrap(double t, double period) {
  const double rest = t - period * std::floor(t / period);
  return rest >= 0 && rest < period ? rest : 0;
}

Pchip::Pchip(std::vector<std::array<double, 2>> points, std::optional<double> period) : period_(period) {
  // Rounding of the times must not leave a sliver between the last point and the first of the next period.
  if (period && points.size() > 1 && points.back()[0] - points.front()[0] > *period * (1 - 1e-9)) points.pop_back();
  if (period) points.push_back({points.front()[0] + *period, points.front()[1]});
  for (const auto& [t, v] : points) t_.push_back(t), v_.push_back(v);
  const std::size_t n = t_.size();
  slope_.assign(n, 0.0);
  if (n < 2) return;
  std::vector<double> h(n - 1), d(n - 1);
  for (std::size_t k = 0; k + 1 < n; ++k) {
    h[k] = t_[k + 1] - t_[k];
    d[k] = (v_[k + 1] - v_[k]) / h[k];
  }
  for (std::size_t k = 1; k + 1 < n; ++k) slope_[k] = inner_slope(h[k - 1], h[k], d[k - 1], d[k]);
  if (period) {
    slope_.front() = slope_.back() = inner_slope(h.back(), h.front(), d.back(), d.front());
  } else if (n == 2) {
    slope_.front() = slope_.back() = d.front();
  } else {
    slope_.front() = end_slope(h[0], h[1], d[0], d[1]);
    slope_.back() = end_slope(h[n - 2], h[n - 3], d[n - 2], d[n - 3]);
  }
}

double Pchip::value(double t) const {
  if (period_) t = t_.front() + wrap(t - t_.front(), *period_);
  if (t <= t_.front()) return v_.front();
  if (t >= t_.back()) return v_.back();
  const auto k = static_cast<std::size_t>(std::upper_bound(t_.begin(), t_.end(), t) - t_.begin()) - 1;
  const double h = t_[k + 1] - t_[k], s = (t - t_[k]) / h, r = 1 - s;
  // Hermite's cubic, as a mean of the two values plus what the slopes add.
  return r * r * (1 + 2 * s) * v_[k] + s * s * (1 + 2 * r) * v_[k + 1] +
         h * s * r * (r * slope_[k] - s * slope_[k + 1]);
}

}  // namespace pliant
