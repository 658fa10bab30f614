#pragma once
#include <cmath>

#include "core/mat3.hpp"
#include "core/vec3.hpp"

namespace pliant {

/// A rotation when its norm is 1: w = cos(angle/2), (x, y, z) = sin(angle/2) axis. Turns the body's reference axes into
/// the world's; q and -q are the same rotation.
struct Quaternion {
  double w = 1, x = 0, y = 0, z = 0;

  /// First b, then a.
  friend constexpr Quaternion operator*(Quaternion a, Quaternion b) {
    return {a.w * b.w - a.x * b.x - a.y * b.y - a.z * b.z, a.w * b.x + a.x * b.w + a.y * b.z - a.z * b.y,
            a.w * b.y - a.x * b.z + a.y * b.w + a.z * b.x, a.w * b.z + a.x * b.y - a.y * b.x + a.z * b.w};
  }
  friend constexpr bool operator==(Quaternion a, Quaternion b) = default;
};

/// The inverse rotation, of a quaternion of norm 1.
constexpr Quaternion conjugate(Quaternion q) { return {q.w, -q.x, -q.y, -q.z}; }

inline double norm(Quaternion q) { return std::sqrt(q.w * q.w + q.x * q.x + q.y * q.y + q.z * q.z); }

inline Quaternion normalized(Quaternion q) {
  const double s = 1.0 / norm(q);
  return {s * q.w, s * q.x, s * q.y, s * q.z};
}

/// The turned vector, for a quaternion of norm 1.
constexpr Vec3 rotate(Quaternion q, Vec3 v) {
  const Vec3 u{q.x, q.y, q.z};
  const Vec3 t = 2.0 * cross(u, v);
  return v + q.w * t + cross(u, t);
}

/// Turn by `angle` radians about `axis`, of any length but 0, right-handed.
inline Quaternion from_axis_angle(Vec3 axis, double angle) {
  const Vec3 u = std::sin(0.5 * angle) * normalized(axis);
  return {std::cos(0.5 * angle), u.x, u.y, u.z};
}

/// Exponential map: turn about `rotation` by its length in radians; the identity for 0.
inline Quaternion from_rotation_vector(Vec3 rotation) {
  const double angle = norm(rotation);
  // sin(angle/2)/angle; below 1e-4 the next term of the series is under round-off.
  const double s = angle > 1e-4 ? std::sin(0.5 * angle) / angle : 0.5 - angle * angle / 48.0;
  return {std::cos(0.5 * angle), s * rotation.x, s * rotation.y, s * rotation.z};
}

/// Matrix R with R v = rotate(q, v); its columns are the turned axes.
constexpr Mat3 to_matrix(Quaternion q) {
  const Vec3 a = rotate(q, {1, 0, 0}), b = rotate(q, {0, 1, 0}), c = rotate(q, {0, 0, 1});
  return {{{a.x, b.x, c.x}, {a.y, b.y, c.y}, {a.z, b.z, c.z}}};
}

}  // namespace pliant
