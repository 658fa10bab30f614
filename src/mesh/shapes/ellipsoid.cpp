#include "mesh/shapes/ellipsoid.hpp"

#include "mesh/shapes/icosphere.hpp"
#include "mesh/shapes/shape_parts.hpp"

namespace pliant {

Surface make_ellipsoid(int frequency, Vec3 semi_axes) {
  ShapeChecks checks("ellipsoid");
  checks.positive("semi-axis x", semi_axes.x);
  checks.positive("semi-axis y", semi_axes.y);
  checks.positive("semi-axis z", semi_axes.z);
  checks.finish();
  Surface surface = make_icosphere(frequency, 1.0);
  for (Vec3& x : surface.positions) x = {semi_axes.x * x.x, semi_axes.y * x.y, semi_axes.z * x.z};
  return surface;
}

}  // namespace pliant
