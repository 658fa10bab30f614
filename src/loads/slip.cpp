#include "loads/slip.hpp"

#include <algorithm>
#include <cmath>

namespace pliant {

double Slip::rms() const { return area > 0 ? std::sqrt(squares / area) : 0; }

Slip measure_slip(std::span<const Vec3> flow_velocities, std::span<const Vec3> surface_velocities,
                  std::span<const Vec3> normals, std::span<const double> areas) {
  Slip slip;
  for (std::size_t m = 0; m < areas.size(); ++m) {
    const Vec3 difference = flow_velocities[m] - surface_velocities[m];
    slip.squares += dot(difference, difference) * areas[m];
    slip.area += areas[m];
    slip.largest = std::max(slip.largest, norm(difference));
    slip.flux += dot(difference, normals[m]) * areas[m];
  }
  return slip;
}

Slip operator+(const Slip& a, const Slip& b) {
  return {a.squares + b.squares, a.area + b.area, std::max(a.largest, b.largest), a.flux + b.flux};
}

}  // namespace pliant
