#pragma once
#include <span>

#include "potentials/shape_state.hpp"

namespace pliant {

/// Adds to a face's vertices the force of a tension T (force / length) that pulls the face together: -T dA/dx, where
/// dA/dx_i = n x (x_k - x_j) / 2 for the vertices i, j, k in order.
inline void add_face_tension(const Face& face, std::span<const Vec3> positions, Vec3 unit_normal, double tension,
                             std::span<Vec3> forces) {
  const auto [a, b, c] = face;
  const Vec3 half = (0.5 * tension) * unit_normal;
  const Vec3 on_a = cross(positions[c] - positions[b], half);
  const Vec3 on_b = cross(positions[a] - positions[c], half);
  forces[a] += on_a;
  forces[b] += on_b;
  forces[c] -= on_a + on_b;
}

}  // namespace pliant
