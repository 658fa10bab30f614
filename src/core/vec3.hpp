#pragma once
#include <cmath>

namespace pliant {

/// A point or vector in space.
struct Vec3 {
  double x = 0, y = 0, z = 0;

  constexpr double& operator[](int d) { return d == 0 ? x : d == 1 ? y : z; }
  constexpr double operator[](int d) const { return d == 0 ? x : d == 1 ? y : z; }
  constexpr Vec3& operator+=(Vec3 b) { return *this = {x + b.x, y + b.y, z + b.z}; }
  constexpr Vec3& operator-=(Vec3 b) { return *this = {x - b.x, y - b.y, z - b.z}; }
  constexpr Vec3& operator*=(double s) { return *this = {s * x, s * y, s * z}; }
  friend constexpr Vec3 operator+(Vec3 a, Vec3 b) { return a += b; }
  friend constexpr Vec3 operator-(Vec3 a, Vec3 b) { return a -= b; }
  friend constexpr Vec3 operator-(Vec3 a) { return {-a.x, -a.y, -a.z}; }
  friend constexpr Vec3 operator*(double s, Vec3 a) { return a *= s; }
  friend constexpr Vec3 operator*(Vec3 a, double s) { return a *= s; }
  friend constexpr Vec3 operator/(Vec3 a, double s) { return a *= (1.0 / s); }
  friend constexpr bool operator==(Vec3 a, Vec3 b) = default;
};

constexpr double dot(Vec3 a, Vec3 b) { return a.x * b.x + a.y * b.y + a.z * b.z; }
constexpr Vec3 cross(Vec3 a, Vec3 b) { return {a.y * b.z - a.z * b.y, a.z * b.x - a.x * b.z, a.x * b.y - a.y * b.x}; }
inline double norm(Vec3 a) { return std::sqrt(dot(a, a)); }
inline Vec3 normalized(Vec3 a) { return a / norm(a); }

}  // namespace pliant
