#pragma once
#include <span>
#include <string>
#include <utility>
#include <vector>

#include "structure/deformable_body.hpp"

namespace pliant {

/// The ellipsoid that has the same moments of inertia as the solid inside a closed surface. The shear plane is x-z.
struct EllipsoidFit {
  double volume = 0;
  Vec3 centroid;
  double length = 0;   ///< L, longest semi-axis of the two nearest to the shear plane
  double breadth = 0;  ///< B, the other one
  double width = 0;    ///< W, semi-axis nearest to y, the direction of vorticity
  double angle = 0;    ///< of L to the x axis in the x-z plane, degrees, in (-90, 90]; without meaning where L = B
};
EllipsoidFit fit_ellipsoid(const TriangleMesh& mesh, std::span<const Vec3> positions);

/// One line of a body's record.
struct BodyShape {
  EllipsoidFit ellipsoid;  ///< of an open surface: the centroid of its area alone
  double area = 0;
  double kinetic_energy = 0;
  std::vector<std::pair<std::string, double>> energies;  ///< of each potential, and of attachments
};
BodyShape measure_shape(const DeformableBody& body);

}  // namespace pliant
