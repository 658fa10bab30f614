#include "grid/stretching.hpp"

#include <cmath>

namespace pliant {

std::vector<double> stretched_faces(const StretchingConfig& stretching, int cells, double origin, double length) {
  std::vector<double> faces(static_cast<std::size_t>(cells) + 1);
  const double s = stretching.strength;
  for (int k = 0; k <= cells; ++k) {
    const double fraction = static_cast<double>(k) / cells;
    const double mapped = stretching.law == StretchingLaw::tanh
                              ? 0.5 * (1.0 + std::tanh(s * (2.0 * fraction - 1.0)) / std::tanh(s))
                              : fraction;
    faces[static_cast<std::size_t>(k)] = origin + length * mapped;
  }
  faces.front() = origin;
  faces.back() = origin + length;
  return faces;
}

}  // namespace pliant
