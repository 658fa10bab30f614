#include "diagnostics/shape.hpp"

#include <Eigen/Eigenvalues>
#include <cmath>
#include <limits>

#include "core/angles.hpp"
#include "mesh/geometry.hpp"
#include "structure/advance_vertices.hpp"
#include "structure/body_forces.hpp"

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

namespace {

/// An open surface encloses nothing: its centroid is that of its area, and it has no ellipsoid.
EllipsoidFit centroid_of_sheet(const TriangleMesh& mesh, std::span<const Vec3> positions) {
  constexpr double none = std::numeric_limits<double>::quiet_NaN();
  EllipsoidFit fit;
  const auto areas = vertex_areas(mesh, positions);
  double area = 0;
  for (std::size_t v = 0; v < areas.size(); ++v) {
    fit.centroid += areas[v] * positions[v];
    area += areas[v];
  }
  fit.centroid = fit.centroid / area;
  fit.length = fit.breadth = fit.width = fit.angle = none;
  return fit;
}

}  // namespace

BodyShape measure_shape(const DeformableBody& body) {
  const bool is_closed = body.mesh.is_closed();
  BodyShape shape{is_closed ? fit_ellipsoid(body.mesh, body.positions) : centroid_of_sheet(body.mesh, body.positions),
                  total_area(body.mesh, body.positions), kinetic_energy(body),
                  body.potentials.energies(body.mesh, body.positions)};
  if (body.attachments.any()) shape.energies.emplace_back("attachments", attachment_energy(body, body.positions));
  return shape;
}

}  // namespace pliant
