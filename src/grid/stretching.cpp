#include "grid/stretching.hpp"

#include <algorithm>
#include <cmath>

namespace pliant {
namespace {

// Equal cells of size h between two heights, linearly growing ones below and above. Cells are counted by the integral
// of 1 / size, so that the faces are heights at whole counts.
class Cluster {
 public:
  Cluster(const StretchingConfig& stretching, int cells, double origin, double length)
      : growth_(stretching.growth),
        begin_(std::clamp(stretching.center - 0.5 * stretching.width, origin, origin + length)),
        end_(std::clamp(stretching.center + 0.5 * stretching.width, origin, origin + length)) {
    const double below = begin_ - origin, above = origin + length - end_;
    // The count falls as h grows, and with cells of the mean size it is at most n.
    double high = length / cells, low = high;
    const auto count = [&](double h) { return outside(below, h) + (end_ - begin_) / h + outside(above, h); };
    while (low > 0 && count(low) < cells) low *= 0.5;
    for (int step = 0; step < 200 && low < high; ++step) {
      const double middle = 0.5 * (low + high);
      if (middle == low || middle == high) break;
      (count(middle) > cells ? low : high) = middle;
    }
    h_ = high;
    below_count_ = outside(below, h_);
  }

  /// The height up to which there are so many cells.
  double height(double count) const {
    const double inside = (count - below_count_) * h_;
    if (inside < 0) return begin_ - distance(below_count_ - count);
    if (inside > end_ - begin_) return end_ + distance((inside - (end_ - begin_)) / h_);
    return begin_ + inside;
  }

 private:
  double outside(double distance, double h) const { return std::log1p(growth_ * distance / h) / growth_; }
  double distance(double count) const { return h_ * std::expm1(growth_ * count) / growth_; }

  double growth_, begin_, end_;
  double h_ = 0, below_count_ = 0;
};

}  // namespace

std::vector<double> stretched_faces(const StretchingConfig& stretching, int cells, double origin, double length) {
  std::vector<double> faces(static_cast<std::size_t>(cells) + 1);
  if (stretching.law == StretchingLaw::cluster) {
    const Cluster cluster(stretching, cells, origin, length);
    for (int k = 0; k <= cells; ++k) faces[static_cast<std::size_t>(k)] = cluster.height(k);
  } else {
    const double s = stretching.strength;
    for (int k = 0; k <= cells; ++k) {
      const double fraction = static_cast<double>(k) / cells;
      const double mapped = stretching.law == StretchingLaw::tanh
                                ? 0.5 * (1.0 + std::tanh(s * (2.0 * fraction - 1.0)) / std::tanh(s))
                                : fraction;
      faces[static_cast<std::size_t>(k)] = origin + length * mapped;
    }
  }
  faces.front() = origin;
  faces.back() = origin + length;
  return faces;
}

}  // namespace pliant
