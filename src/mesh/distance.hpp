#pragma once
#include <array>
#include <span>

#include "core/vec3.hpp"
#include "mesh/triangle_mesh.hpp"

namespace pliant {

/// Corners of a triangle.
using Triangle = std::array<Vec3, 3>;

/// The point of a triangle that is nearest to x (C. Ericson, Real-Time Collision Detection, 2005, section 5.1.5), and
/// the weights of the corners in it.
Vec3 nearest_point(Vec3 x, const Triangle& triangle);
std::array<double, 3> nearest_weights(Vec3 x, const Triangle& triangle);

/// Where along two segments, 0 at the beginning and 1 at the end, they are nearest to each other (the same, 5.1.9).
std::array<double, 2> nearest_along(Vec3 from_a, Vec3 to_a, Vec3 from_b, Vec3 to_b);

/// How often a closed surface winds around x: 1 inside, 0 outside, 1/2 on it; by the sum of the solid angles of its
/// faces (A. van Oosterom & J. Strackee, IEEE Trans. Biomed. Eng. 30, 125, 1983).
double winding_number(Vec3 x, const TriangleMesh& mesh, std::span<const Vec3> positions);

}  // namespace pliant
