#pragma once
#include "core/vec3.hpp"

namespace pliant {

/// A 3 x 3 matrix by rows. For a velocity gradient, rows[i][j] = d u_i / d x_j.
struct Mat3 {
  Vec3 rows[3];

  constexpr Vec3& operator[](int i) { return rows[i]; }
  constexpr Vec3 operator[](int i) const { return rows[i]; }
  friend constexpr Vec3 operator*(const Mat3& a, Vec3 b) {
    return {dot(a.rows[0], b), dot(a.rows[1], b), dot(a.rows[2], b)};
  }
};

}  // namespace pliant
