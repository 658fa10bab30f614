#include "structure/placement.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "core/angles.hpp"

namespace pliant {
namespace {
/// Cosine and sine of an angle in degrees.
std::array<double, 2> direction_of(double degrees) {
  const double turn = std::fmod(degrees, 360.0);
  const double quarters = turn / 90.0;
  if (quarters == std::round(quarters)) {
    constexpr std::array<double, 2> exact[] = {{1, 0}, {0, 1}, {-1, 0}, {0, -1}};
    return exact[(static_cast<int>(quarters) + 4) % 4];
  }
  const double angle = degree * turn;
  return {std::cos(angle), std::sin(angle)};
}
}  // namespace

Mat3 rotation_about(Vec3 axis, double degrees) {
  const auto [c, s] = direction_of(degrees);
  const Vec3 n = normalized(axis);
  Mat3 rotation;
  for (int i = 0; i < 3; ++i)
    for (int j = 0; j < 3; ++j) rotation[i][j] = (i == j ? c : 0.0) + (1 - c) * n[i] * n[j];
  for (int i = 0; i < 3; ++i) {
    const int j = (i + 1) % 3, k = (i + 2) % 3;
    rotation[j][i] += s * n[k];
    rotation[i][j] -= s * n[k];
  }
  return rotation;
}

Mat3 product(const Mat3& first, const Mat3& second) {
  Mat3 result;
  for (int i = 0; i < 3; ++i)
    for (int j = 0; j < 3; ++j) result[i] += first[i][j] * second[j];
  return result;
}

Placement given_placement(const BodyConfig& config) {
  return {config.center, rotation_about(config.rotation.axis, config.rotation.angle)};
}

std::vector<Vec3> place(std::span<const Vec3> shape, const Placement& placement) {
  std::vector<Vec3> positions;
  positions.reserve(shape.size());
  for (const Vec3 x : shape) positions.push_back(placement.center + placement.rotation * x);
  return positions;
}

bool has_copies(const BodyConfig& config) {
  return config.placement.count.has_value() || config.placement.positions.has_value();
}

std::string copy_name(const BodyConfig& config, std::size_t index, std::size_t count) {
  if (!has_copies(config)) return config.name;
  const auto width = std::max<std::size_t>(4, std::to_string(count).size());
  return fmt::format("{}-{:0{}}", config.name, index + 1, width);
}

BoundingSphere bounding_sphere(std::span<const Vec3> positions) {
  if (positions.empty()) return {};
  Vec3 lower = positions[0], upper = positions[0];
  for (const Vec3 x : positions)
    for (int d = 0; d < 3; ++d) {
      lower[d] = std::min(lower[d], x[d]);
      upper[d] = std::max(upper[d], x[d]);
    }
  const auto about = [&](Vec3 center) {
    double squared = 0;
    for (const Vec3 x : positions) squared = std::max(squared, dot(x - center, x - center));
    return BoundingSphere{center, std::sqrt(squared)};
  };
  const auto origin = about({}), middle = about(0.5 * (lower + upper));
  return middle.radius < origin.radius * (1 - 1e-12) ? middle : origin;
}

BoundingSphere place(const BoundingSphere& sphere, const Placement& placement) {
  return {placement.center + placement.rotation * sphere.center, sphere.radius};
}

}  // namespace pliant
