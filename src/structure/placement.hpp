#pragma once
#include <span>
#include <string>
#include <vector>

#include "config/case_config.hpp"
#include "core/mat3.hpp"

namespace pliant {

/// Where a body is put: x = center + rotation * X for a point X of its shape.
struct Placement {
  Vec3 center;
  Mat3 rotation{{{1, 0, 0}, {0, 1, 0}, {0, 0, 1}}};
};

/// Rotation about an axis (not 0, of any length) by the right-hand rule; exact at multiples of 90 degrees about x, y,
/// z.
Mat3 rotation_about(Vec3 axis, double degrees);
/// First `second`, then `first`.
Mat3 product(const Mat3& first, const Mat3& second);

/// Where a body without copies is put: by its rotation and center.
Placement given_placement(const BodyConfig& config);

/// The points of a shape at their place.
std::vector<Vec3> place(std::span<const Vec3> shape, const Placement& placement);

/// Whether the body stands for numbered copies: by count or by positions.
bool has_copies(const BodyConfig& config);

/// Name of copy `index` (from 0) of `count`: "grain-0001", with as many digits as the last one needs, at least four;
/// the name alone for a body that has no copies.
std::string copy_name(const BodyConfig& config, std::size_t index, std::size_t count);

/// A ball that contains a shape.
struct BoundingSphere {
  Vec3 center;
  double radius = 0;
};
/// About the origin or the middle of the bounding box, whichever is smaller.
BoundingSphere bounding_sphere(std::span<const Vec3> positions);
BoundingSphere place(const BoundingSphere& sphere, const Placement& placement);

}  // namespace pliant
