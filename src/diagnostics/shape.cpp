#include "diagnostics/shape.hpp"

#include <Eigen/Eigenvalues>
#include <cmath>

#include "core/angles.hpp"
#include "mesh/geometry.hpp"
#include "structure/advance_vertices.hpp"

namespace pliant {

EllipsoidFit fit_ellipsoid(const TriangleMesh& mesh, std::span<const Vec3> positions) {
  const SolidMoments moments = enclosed_moments(mesh, positions);
  Eigen::Matrix3d second;
  for (int i = 0; i < 3; ++i)
    for (int j = 0; j < 3; ++j) second(i, j) = 0.5 * (moments.second[i][j] + moments.second[j][i]) / moments.volume;
  const Eigen::SelfAdjointEigenSolver<Eigen::Matrix3d> solver(second);
  // Eigenvalues ascend; along a semi-axis a of an ellipsoid the mean of x^2 is a^2 / 5.
  const Eigen::Vector3d axes = (5.0 * solver.eigenvalues().cwiseMax(0.0)).cwiseSqrt();
  int vorticity = 0;
  solver.eigenvectors().row(1).cwiseAbs().maxCoeff(&vorticity);
  const int major = vorticity == 2 ? 1 : 2, minor = vorticity == 0 ? 1 : 0;

  EllipsoidFit fit;
  fit.volume = moments.volume;
  fit.centroid = moments.centroid;
  fit.length = axes[major];
  fit.breadth = axes[minor];
  fit.width = axes[vorticity];
  const double x = solver.eigenvectors()(0, major), z = solver.eigenvectors()(2, major);
  fit.angle = std::atan(z / x) / degree;
  if (fit.angle <= -90.0 || x == 0) fit.angle = 90.0;
  return fit;
}

BodyShape measure_shape(const DeformableBody& body) {
  return {fit_ellipsoid(body.mesh, body.positions), total_area(body.mesh, body.positions), kinetic_energy(body),
          body.potentials.energies(body.mesh, body.positions)};
}

}  // namespace pliant
