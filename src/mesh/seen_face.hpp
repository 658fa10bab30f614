#pragma once
#include <algorithm>
#include <array>
#include <span>

#include "core/vec3.hpp"
#include "mesh/triangle_mesh.hpp"

namespace pliant {

/// A face seen along an axis of the box: where lines along that axis pass it. `a` and `b` are the coordinates of such a
/// line along the two axes that follow.
class SeenFace {
 public:
  SeenFace(const Face& face, std::span<const Vec3> positions, int axis)
      : face_(face), axis_(axis), a_((axis + 1) % 3), b_((axis + 2) % 3) {
    for (std::size_t c = 0; c < 3; ++c) corners_[c] = positions[static_cast<std::size_t>(face[c])];
    normal_ = cross(corners_[1] - corners_[0], corners_[2] - corners_[0]);
  }

  double lower(int d) const { return std::min({corners_[0][d], corners_[1][d], corners_[2][d]}); }
  double upper(int d) const { return std::max({corners_[0][d], corners_[1][d], corners_[2][d]}); }

  /// +1 if the line passes against the normal (into a closed surface), -1 if along it, 0 if it misses the face. Two
  /// faces ask the same question of the edge that they share, so that a line through it passes one of them.
  int passes(double a, double b) const {
    std::array<bool, 3> is_left{};
    for (std::size_t c = 0; c < 3; ++c) is_left[c] = left_of(c, (c + 1) % 3, a, b);
    if (is_left[0] != is_left[1] || is_left[1] != is_left[2]) return 0;
    return is_left[0] ? -1 : 1;
  }

  /// Where the line passes, along the axis.
  double height_at(double a, double b) const {
    const double low = lower(axis_), high = upper(axis_);
    const double height = corners_[0][axis_] -
                          (normal_[a_] * (a - corners_[0][a_]) + normal_[b_] * (b - corners_[0][b_])) / normal_[axis_];
    return height >= low ? std::min(height, high) : low;  // an upright face has no slope
  }

 private:
  bool left_of(std::size_t from, std::size_t to, double a, double b) const {
    const bool is_turned = face_[from] > face_[to];
    const Vec3 p = corners_[is_turned ? to : from], q = corners_[is_turned ? from : to];
    const bool is_left = (q[a_] - p[a_]) * (b - p[b_]) - (q[b_] - p[b_]) * (a - p[a_]) > 0;
    return is_left != is_turned;
  }

  Face face_;
  int axis_, a_, b_;
  std::array<Vec3, 3> corners_;
  Vec3 normal_;
};

}  // namespace pliant
