#pragma once
#include <array>
#include <optional>
#include <vector>

namespace pliant {

/// The monotone piecewise cubic through given points: between two points it stays between their values, and its
/// derivative is continuous. Slopes are those of F. N. Fritsch and J. Butland, SIAM J. Sci. Stat. Comput. 5 (1984) 300.
class Pchip {
 public:
  /// `points` are [t, v], t growing, at least one. With a period, not less than last t - first t, the curve repeats;
  /// the first point comes again after the last. Without, it keeps the first and the last value outside.
  explicit Pchip(std::vector<std::array<double, 2>> points, std::optional<double> period = std::nullopt);

  double value(double t) const;

 private:
  std::vector<double> t_, v_, slope_;
  std::optional<double> period_;
};

/// t less a whole number of periods, in [0, period).
double wrap(double t, double period);

}  // namespace pliant
